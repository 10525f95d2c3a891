//! State of the stages.

use super::compose::Pipeline;
use crate::body::Placed;
use crate::condition::{ConditionState, Image};
use crate::contact::ContactState;
#[cfg(feature = "folds")]
use crate::fold::Doubt;
use crate::format::{Code, Micros};
use crate::garment::Layout;
#[cfg(feature = "gesture")]
use crate::gesture::GestureState;
use crate::health::FaultyTaxel;
use crate::intent::{Fed, IntentState};
use crate::react::{ReactState, Reaction, Reactions};
use crate::shape::Taught;
use crate::surface::{Pressing, Table, TaxelLimits};
use crate::symbol::SymbolState;
use crate::unsure::UnsureState;
#[cfg(feature = "folds")]
use heapless::Vec;

/// Most contacts tracked at a time.
pub const CONTACTS: usize = 32;

/// State of all stages.
#[derive(Debug, Clone)]
pub struct PipelineState<const TAXELS: usize, const RUNS: usize, const PARTS: usize = RUNS> {
    /// Baseline, gains, images.
    pub condition: ConditionState<TAXELS>,
    pub(super) contact: ContactState<CONTACTS, RUNS, PARTS, Placed>,
    pub(super) unsure: UnsureState<CONTACTS>,
    pub(super) symbol: SymbolState<CONTACTS>,
    #[cfg(feature = "gesture")]
    pub(super) gesture: GestureState,
    pub(super) intent: IntentState,
    pub(super) react: ReactState,
    /// Concept values that the host feeds.
    pub fed: Fed,
    /// Shapes that the host taught.
    pub taught: Taught<CONTACTS>,
}

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Default
    for PipelineState<TAXELS, RUNS, PARTS>
{
    #[inline(never)] // inlined, its caller would build it on the stack and move it
    fn default() -> Self {
        PipelineState {
            // Constants: written in place, without a copy on the stack.
            condition: const { ConditionState::new() },
            contact: const { ContactState::with_slots() },
            unsure: const { UnsureState::new() },
            symbol: SymbolState::default(),
            #[cfg(feature = "gesture")]
            gesture: const { GestureState::new() },
            intent: IntentState::default(),
            react: ReactState::default(),
            fed: Fed::default(),
            taught: const { Taught::new() },
        }
    }
}

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> PipelineState<TAXELS, RUNS, PARTS> {
    /// Resets for a garment, whose codes at rest are `full_scale` if `falling`, else 0.
    pub fn reset(&mut self, layout: &Layout, falling: bool, full_scale: u16) {
        self.condition.reset(layout, Code(if falling { full_scale } else { 0 }));
        self.contact.reset();
        self.unsure = const { UnsureState::new() };
        self.symbol.reset();
        self.forget();
    }

    /// Forgets results that belong to a scene; the baseline and the contacts stay.
    pub fn forget(&mut self) {
        self.symbol.forget_classes();
        self.recognise_anew();
        self.intent = IntentState::default();
        self.react = ReactState::default();
    }

    /// Records a reaction that began by reflex at that pressure (counts). Returns none if it lasts already.
    pub fn begin_reaction(
        &mut self,
        reactions: &Reactions,
        index: u8,
        value: u16,
        now: Micros,
    ) -> Option<Reaction> {
        reactions.begin(&mut self.react, index, value, now)
    }

    /// State of the reactions.
    pub(crate) fn react(&self) -> &ReactState {
        &self.react
    }

    /// Mutable state of the reactions.
    pub(crate) fn react_mut(&mut self) -> &mut ReactState {
        &mut self.react
    }

    /// Mask of the reactions that last, by row.
    pub fn reacting(&self) -> u8 {
        self.react.active()
    }

    /// True if there was a contact in the last frame.
    pub fn is_touched(&self) -> bool {
        !self.contact.present().is_empty()
    }

    /// Present contacts of the last frame.
    pub fn present(&self) -> &[Placed] {
        self.contact.present()
    }

    /// Contacts that ended with the last frame or, after it, with its garment.
    pub(crate) fn released(&self) -> &[Placed] {
        self.contact.released()
    }

    /// Words of those contacts, and the regions.
    pub(crate) fn symbols(&self) -> &SymbolState<CONTACTS> {
        &self.symbol
    }

    /// Age of their forms, frames.
    pub(crate) fn form_ages(&self) -> &[u8] {
        self.contact.form_ages()
    }

    /// Places and forces of the contacts of the last frame, whose image has these values.
    pub(crate) fn press(
        &self,
        pressing: &mut Pressing<CONTACTS>,
        table: &Table<'_>,
        layout: &Layout,
        values: &[u16],
    ) {
        pressing.sum(table, &self.contact, layout, [self.condition.calibrated(), values]);
    }

    /// Taxels under those contacts that do not say what they feel. `full` is the code at the end of the
    /// converter's range.
    pub(crate) fn doubt(
        &self,
        pressing: &mut Pressing<CONTACTS>,
        table: &Table<'_>,
        layout: &Layout,
        values: &[u16],
        (faulty, full, falling): (&[FaultyTaxel], Code, bool),
    ) {
        let limits = TaxelLimits { faulty, ceiling: |taxel| self.condition.felt(taxel, full, falling) };
        pressing.doubt(table, &self.contact, layout, [self.condition.calibrated(), values], &limits);
    }

    /// By how much the totals of the contacts of the last frame may be off for the folds beneath them.
    #[cfg(feature = "folds")]
    #[inline(never)]
    pub(crate) fn doubts(&self, layout: &Layout) -> Vec<Doubt, CONTACTS> {
        let folds = self.condition.folds();
        let mut sums = [0u32; CONTACTS];
        self.contact.each_pressed(layout, |pressed| {
            let Some(sum) = sums.get_mut(pressed.contact) else { return };
            for (first, run) in pressed.each() {
                *sum = sum.saturating_add(folds.doubt_within(&(first..first + usize::from(run.width()))));
            }
        });
        let mut doubts = Vec::new();
        for (placed, doubt) in self.present().iter().zip(sums).filter(|(_, doubt)| *doubt > 0) {
            // There are as many places as contacts.
            let _ = doubts.push(Doubt { id: placed.contact.id, doubt });
        }
        doubts
    }

    /// Which contacts of the last frame may be drift.
    pub fn unsure(&self) -> &UnsureState<CONTACTS> {
        &self.unsure
    }

    /// Conditioned image of the last frame.
    pub fn image(&self, pipeline: &Pipeline, layout: &Layout) -> Image<'_> {
        pipeline.condition.image(&self.condition, layout)
    }

    /// Forgets the present touch after a change of the gesture model; the next touch is recognised.
    pub fn recognise_anew(&mut self) {
        #[cfg(feature = "gesture")]
        self.gesture.forget();
    }

    /// Forgets all classes of shapes after a change of the base; recognition resumes with the next frame.
    pub fn recognise_shapes_anew(&mut self) {
        self.contact.slots().iter_mut().for_each(|placed| placed.shape.forget_class());
        self.symbol.forget_classes();
    }

    /// The announced intention, and its evidence.
    pub fn intent(&self) -> &IntentState {
        &self.intent
    }
}
