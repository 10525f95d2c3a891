//! The data path, composed: codes of one scan in, everything that was perceived out.

use crate::body::Placed;
use crate::condition::{Condition, ConditionState, Image, Tare};
use crate::contact::{ContactState, Contacts};
use crate::fold::FoldState;
use crate::format::{Code, Invalid, Micros, Name};
use crate::garment::{Layout, PANELS};
use crate::gesture::{Gesture, GestureState, Gestures};
use crate::intent::{Fed, Intent, IntentState, MapError, Meaning, Touch};
use crate::react::{ReactState, Reactions};
use crate::scene::Scene;
use crate::shape::{BUILT_IN, Base, Shape, Shapes, Taught};
use crate::symbol::{SymbolState, Symbols};
use core::fmt;
use heapless::Vec;

/// Contacts that are followed at a time.
pub const CONTACTS: usize = 32;

/// Stages, in the order of the data path, for whoever measures them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Stage {
    /// outside the pipeline
    Idle = 0,
    /// baseline, calibration, filter
    Condition = 1,
    /// labels, moments, tracking
    Contact = 2,
    /// NMI, k-NN, place on the body
    Shape = 3,
    /// words, region states and touch over time
    Symbol = 4,
    /// the cognitive map
    Intent = 5,
    /// the table of reactions
    React = 6,
    /// encoding of messages
    Encode = 7,
    /// reading the garment
    Scan = 8,
}

/// Is told when a stage begins.
pub trait Probe {
    /// `stage` begins, so the one before has ended.
    fn begin(&mut self, stage: Stage);
}

/// Nobody measures.
impl Probe for () {
    fn begin(&mut self, _: Stage) {}
}

/// Why a scene does not fit a garment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SceneError {
    /// A parameter is out of its range.
    Invalid(Invalid),
    /// The map is wrong.
    Map(MapError),
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SceneError::Invalid(invalid) => invalid.fmt(f),
            SceneError::Map(map) => write!(f, "intent.map: {map}"),
        }
    }
}

impl core::error::Error for SceneError {}

impl From<Invalid> for SceneError {
    fn from(invalid: Invalid) -> Self {
        SceneError::Invalid(invalid)
    }
}

impl From<MapError> for SceneError {
    fn from(map: MapError) -> Self {
        SceneError::Map(map)
    }
}

/// All stages of a scene.
#[derive(Debug, Clone)]
pub struct Pipeline {
    panels: u8,
    condition: Condition,
    contact: Contacts,
    shape: Option<Shapes<BUILT_IN>>,
    symbol: Symbols,
    /// Touch over time; none: not recognised. It is no part of a scene, and stays where the scene or the garment changes.
    pub gestures: Option<Gestures>,
    friendliness: [i8; PANELS],
    intent: Option<Intent>,
    react: Reactions,
}

/// All that the stages remember.
#[derive(Debug, Clone)]
pub struct PipelineState<const TAXELS: usize, const RUNS: usize> {
    /// Baseline, gains, images.
    pub condition: ConditionState<TAXELS>,
    contact: ContactState<CONTACTS, RUNS>,
    present: Vec<Placed, CONTACTS>,
    released: Vec<Placed, CONTACTS>,
    symbol: SymbolState<CONTACTS>,
    gesture: GestureState,
    intent: IntentState,
    react: ReactState,
    /// How the joints stand.
    pub fold: FoldState,
    /// Concept values that the host feeds.
    pub fed: Fed,
    /// Shapes that the host taught.
    pub taught: Taught<CONTACTS>,
}

/// What was perceived in one frame.
#[derive(Debug, Clone)]
pub struct Percept<'a> {
    /// Conditioned image by taxel number, background zero.
    pub image: &'a [u16],
    /// Contacts that are there.
    pub present: &'a [Placed],
    /// Contacts that have gone.
    pub released: &'a [Placed],
    /// Contacts that did not fit, and runs that did not.
    pub dropped: u16,
    /// What was said of them.
    pub symbols: &'a SymbolState<CONTACTS>,
    /// What the touch means, if that is new.
    pub meaning: Option<Meaning>,
    /// What goes on and what that is called, if it is new.
    pub gesture: Option<(Gesture, Name)>,
    /// What the garment does by itself.
    pub reactions: &'a ReactState,
    /// How far a tare is.
    pub tare: Tare,
}

impl<const TAXELS: usize, const RUNS: usize> Default for PipelineState<TAXELS, RUNS> {
    #[inline(never)] // its caller would make it on the stack, and move it
    fn default() -> Self {
        PipelineState {
            // Constants: written where they belong, without a copy on the stack.
            condition: const { ConditionState::new() },
            contact: const { ContactState::new() },
            present: Vec::new(),
            released: Vec::new(),
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

impl<const TAXELS: usize, const RUNS: usize> PipelineState<TAXELS, RUNS> {
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

    /// Whether something touched the garment in the last frame.
    pub fn is_touched(&self) -> bool {
        !self.present.is_empty()
    }

    /// The conditioned image of the last frame.
    pub fn image(&self, pipeline: &Pipeline, layout: &Layout) -> Image<'_> {
        pipeline.condition.image(&self.condition, layout)
    }

    /// Touches are recognised from the next on, by another model or none.
    pub fn recognise_anew(&mut self) {
        self.gesture.forget();
    }

    /// The announced intention and what led to it.
    pub fn intent(&self) -> &IntentState {
        &self.intent
    }
}

impl Pipeline {
    /// Checks a scene against the garment it is for.
    pub fn build(scene: &Scene, layout: &Layout) -> Result<Pipeline, SceneError> {
        let friendliness = friendliness(scene, layout)?;
        if !(1..=1000).contains(&scene.stream.key_ms) {
            return Err(Invalid { parameter: "stream.key_ms", must: "must be 1 to 1000" }.into());
        }
        let mut pipeline = Pipeline {
            panels: scene.plan.panels,
            condition: scene.condition.build()?,
            contact: scene.contact.build()?,
            shape: None,
            symbol: scene.symbol.build()?,
            gestures: None,
            friendliness,
            intent: None,
            react: Reactions::default(),
        };
        // One after the other, in place: on a microcontroller the stack is short.
        pipeline.recognise(scene)?;
        pipeline.mean(scene)?;
        pipeline.react = Reactions::build(&scene.react, layout, pipeline.intent.as_ref().map(Intent::map))?;
        Ok(pipeline)
    }

    #[inline(never)]
    fn recognise(&mut self, scene: &Scene) -> Result<(), SceneError> {
        self.shape = scene.shape.map(|shape| shape.build(Base::built_in())).transpose()?;
        Ok(())
    }

    #[inline(never)]
    fn mean(&mut self, scene: &Scene) -> Result<(), SceneError> {
        if let Some(intent) = &scene.intent {
            self.intent = Some(Intent::build(intent)?);
        }
        Ok(())
    }

    /// The stage that infers the intention.
    pub fn intent(&self) -> Option<&Intent> {
        self.intent.as_ref()
    }

    /// The table of reactions.
    pub fn reactions(&self) -> &Reactions {
        &self.react
    }

    /// Takes one frame of codes, scanned at `now`.
    pub fn process<'s, const TAXELS: usize, const RUNS: usize>(
        &self,
        state: &'s mut PipelineState<TAXELS, RUNS>,
        layout: &Layout,
        codes: &[Code],
        falling: bool,
        now: Micros,
        probe: &mut impl Probe,
    ) -> Percept<'s> {
        let PipelineState {
            condition,
            contact,
            present,
            released,
            symbol,
            gesture,
            intent,
            react,
            fed,
            taught,
            ..
        } = state;
        probe.begin(Stage::Condition);
        self.condition.process(condition, layout, codes, falling, self.panels, contact.feedback());
        let condition = &*condition;
        let image = self.condition.image(condition, layout);
        probe.begin(Stage::Contact);
        let touches = self.contact.process(contact, layout, &image, now);
        probe.begin(Stage::Shape);
        let shape = |moments, contact| {
            self.shape.as_ref().map_or_else(Shape::default, |shapes| shapes.process(moments, contact))
        };
        let shapes = touches.present.iter().zip(touches.moments);
        let gone = |c: &crate::contact::Contact| {
            let last = present.iter().find(|p| p.contact.id == c.id);
            Placed::new(layout, c.clone(), last.map_or_else(Shape::default, |p| p.shape))
        };
        replace(released, touches.released.iter().map(gone));
        replace(present, shapes.map(|(c, m)| Placed::new(layout, c.clone(), shape(m, c))));
        let dropped = touches.dropped.saturating_add(touches.overflow);
        if taught.gallery().is_some() {
            look(taught, present, contact, layout, &image);
        }
        probe.begin(Stage::Symbol);
        self.symbol.process(symbol, present, released, now);
        let gesture = self.gestures.as_ref().and_then(|stage| {
            let totals = present.iter().map(|placed| (placed.contact.panel, placed.contact.total));
            let told = stage.process(gesture, layout, &image, totals, now)?;
            Some((told, stage.name(told.class)))
        });
        probe.begin(Stage::Intent);
        let meaning = self.intent.as_ref().and_then(|stage| {
            let mut felt: Vec<Touch, CONTACTS> = Vec::new();
            replace(&mut felt, present.iter().map(|placed| self.touch(layout, placed)));
            stage.process(intent, &felt, &fed.values(now), now)
        });
        probe.begin(Stage::React);
        self.react.process(react, symbol.regions(layout.regions().len()), meaning.as_ref(), now);
        probe.begin(Stage::Idle);
        Percept {
            image: image.values,
            present,
            released,
            dropped,
            symbols: symbol,
            meaning,
            gesture,
            reactions: react,
            tare: condition.tare_progress(),
        }
    }

    /// What the map is told of a contact.
    fn touch(&self, layout: &Layout, placed: &Placed) -> Touch {
        Touch {
            press: placed.contact.peak_total,
            breadth: placed.contact.peak_breadth,
            friendliness: self.friendliness.get(usize::from(placed.region)).copied().unwrap_or(0),
            duration_ms: placed.contact.duration_ms,
            speed: placed.speed(layout),
            rise: 0,
        }
    }
}

/// Looks at one of the contacts with the base that was taught, and tells of each what it was found to be.
fn look<const RUNS: usize>(
    taught: &mut Taught<CONTACTS>,
    present: &mut [Placed],
    contact: &ContactState<CONTACTS, RUNS>,
    layout: &Layout,
    image: &Image<'_>,
) {
    let chosen = taught.choose(present.iter().map(|placed| placed.contact.id));
    if let Some((index, placed)) = chosen.and_then(|index| Some((index, present.get(index)?))) {
        taught.look(contact, layout, image, (index, &placed.contact));
    }
    present.iter_mut().for_each(|placed| taught.tell(&placed.contact, &mut placed.shape));
}

/// How friendly it is to touch each region of a garment, percent.
fn friendliness(scene: &Scene, layout: &Layout) -> Result<[i8; PANELS], Invalid> {
    let mut friendliness = [0; PANELS];
    for entry in &scene.friendliness {
        if !(-100..=100).contains(&entry.percent) {
            return Err(Invalid { parameter: "friendliness.percent", must: "must be -100 to 100" });
        }
        // A scene may speak of regions that this garment does not cover.
        let region = layout.regions().iter().position(|region| *region == entry.region);
        if let Some(percent) = region.and_then(|region| friendliness.get_mut(region)) {
            *percent = entry.percent;
        }
    }
    Ok(friendliness)
}

/// Fills a list anew; what does not fit is left out.
fn replace<T, const N: usize>(list: &mut Vec<T, N>, items: impl Iterator<Item = T>) {
    list.clear();
    for item in items {
        if list.push(item).is_err() {
            break;
        }
    }
}
