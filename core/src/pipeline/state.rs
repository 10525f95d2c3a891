//! What the stages remember.

use super::compose::Pipeline;
use crate::body::Placed;
use crate::condition::{ConditionState, Image};
use crate::contact::ContactState;
use crate::fold::FoldState;
use crate::format::{Code, Micros};
use crate::garment::Layout;
use crate::gesture::GestureState;
use crate::intent::{Fed, IntentState};
use crate::react::{ReactState, Reaction, Reactions};
use crate::shape::Taught;
use crate::symbol::SymbolState;
use crate::unsure::UnsureState;
use heapless::Vec;

/// Contacts that are followed at a time.
pub const CONTACTS: usize = 32;

/// All that the stages remember.
#[derive(Debug, Clone)]
pub struct PipelineState<const TAXELS: usize, const RUNS: usize, const PARTS: usize = RUNS> {
    /// Baseline, gains, images.
    pub condition: ConditionState<TAXELS>,
    pub(super) contact: ContactState<CONTACTS, RUNS, PARTS>,
    pub(super) present: Vec<Placed, CONTACTS>,
    pub(super) released: Vec<Placed, CONTACTS>,
    pub(super) unsure: UnsureState<CONTACTS>,
    pub(super) symbol: SymbolState<CONTACTS>,
    pub(super) gesture: GestureState,
    pub(super) intent: IntentState,
    pub(super) react: ReactState,
    /// How the joints stand.
    pub fold: FoldState,
    /// Concept values that the host feeds.
    pub fed: Fed,
    /// Shapes that the host taught.
    pub taught: Taught<CONTACTS>,
}

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Default
    for PipelineState<TAXELS, RUNS, PARTS>
{
    #[inline(never)] // its caller would make it on the stack, and move it
    fn default() -> Self {
        PipelineState {
            // Constants: written where they belong, without a copy on the stack.
            condition: const { ConditionState::new() },
            contact: const { ContactState::new() },
            present: Vec::new(),
            released: Vec::new(),
            unsure: const { UnsureState::new() },
            symbol: SymbolState::default(),
            gesture: const { GestureState::new() },
            intent: IntentState::default(),
            react: ReactState::default(),
            fold: FoldState::default(),
            fed: Fed::default(),
            taught: const { Taught::new() },
        }
    }
}

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> PipelineState<TAXELS, RUNS, PARTS> {
    /// Starts afresh on a garment; pressure lowers its codes from `full_scale` if `falling`.
    pub fn reset(&mut self, layout: &Layout, falling: bool, full_scale: u16) {
        self.condition.reset(layout, Code(if falling { full_scale } else { 0 }));
        self.contact.reset();
        self.forget();
    }

    /// Forgets what a scene's stages found, for another scene; the baseline stays.
    pub fn forget(&mut self) {
        self.symbol = SymbolState::default();
        self.gesture.forget();
        self.intent = IntentState::default();
        self.react = ReactState::default();
    }

    /// A reaction has begun by reflex, at that pressure (counts); none if it lasts already.
    pub fn begin_reaction(
        &mut self,
        reactions: &Reactions,
        index: u8,
        value: u16,
        now: Micros,
    ) -> Option<Reaction> {
        reactions.begin(&mut self.react, index, value, now)
    }

    /// What is remembered of the reactions.
    pub(crate) fn react(&self) -> &ReactState {
        &self.react
    }

    /// As [`PipelineState::react`], to be changed.
    pub(crate) fn react_mut(&mut self) -> &mut ReactState {
        &mut self.react
    }

    /// Reactions that last, a bit for each row.
    pub fn reacting(&self) -> u8 {
        self.react.active()
    }

    /// Whether something touched the garment in the last frame.
    pub fn is_touched(&self) -> bool {
        !self.present.is_empty()
    }

    /// Which contacts of the last frame may be drift.
    pub fn unsure(&self) -> &UnsureState<CONTACTS> {
        &self.unsure
    }

    /// The conditioned image of the last frame.
    pub fn image(&self, pipeline: &Pipeline, layout: &Layout) -> Image<'_> {
        pipeline.condition.image(&self.condition, layout)
    }

    /// Touches are recognised from the next on, by another model or none.
    pub fn recognise_anew(&mut self) {
        self.gesture.forget();
    }

    /// Shapes are recognised from the next frame on, by another base.
    pub fn recognise_shapes_anew(&mut self) {
        self.present.iter_mut().for_each(|placed| placed.shape.forget_class());
        self.symbol.forget_classes();
    }

    /// The announced intention and what led to it.
    pub fn intent(&self) -> &IntentState {
        &self.intent
    }
}
