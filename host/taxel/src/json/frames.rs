//! Recorded frames, run through the board's pipeline: what it perceives, as JSON.

use super::contact::ContactLine;
use super::meaning::MeaningOfTouch;
use crate::client::growths::Growths;
use crate::error::Result;
use serde::Serialize;
use serde_json::Value;
use taxel_core::body::Placed;
use taxel_core::condition::Tare;
use taxel_core::format::{Code, Micros, Name, Q15};
use taxel_core::garment::{Garment, Layout};
use taxel_core::intent::Leading;
use taxel_core::pipeline::{Percept, Pipeline, PipelineState};
use taxel_core::scene::Scene;
use taxel_core::shape::Base;

/// Taxels of the largest recording; half as many runs always suffice.
const TAXELS: usize = 16_384;

/// State of the pipeline.
pub type ReplayState = PipelineState<TAXELS, { TAXELS / 2 }>;

/// A garment and a scene on the host: takes frames of values, returns JSON objects.
pub struct Replay {
    /// The garment.
    pub layout: Layout,
    falling: bool,
    /// The scene.
    pub pipeline: Pipeline,
    /// State of the pipeline.
    pub state: Box<ReplayState>,
    names: Vec<Name>,
    leading: Leading,
    concepts: Vec<Q15>,
    growths: Growths,
}

impl Replay {
    /// A replay on a garment with values up to `full_scale`.
    pub fn new(garment: &Garment, scene: &Scene, full_scale: u16) -> Result<Replay> {
        let layout = Layout::build(garment, TAXELS, full_scale)?;
        let pipeline = Pipeline::build(scene, &layout)?;
        let mut state = Box::new(ReplayState::default());
        let falling = garment.wiring.falling;
        state.reset(&layout, falling, full_scale);
        let names = pipeline.intent().map_or_else(Vec::new, |intent| intent.map().concepts().to_vec());
        let concepts = vec![Q15(0); names.len()];
        Ok(Replay {
            layout,
            falling,
            pipeline,
            state,
            names,
            leading: Leading::None,
            concepts,
            growths: Growths::default(),
        })
    }

    /// Processes one frame. Returns an object with time, contacts and intent.
    pub fn frame(&mut self, values: &[u16], time: Micros) -> Value {
        let codes: Vec<Code> = values.iter().map(|value| Code(*value)).collect();
        let Replay { layout, falling, pipeline, state, names, leading, concepts, growths } = self;
        let percept = pipeline.process(state, layout, &codes, *falling, time, &mut ());
        if let Some(meaning) = &percept.meaning {
            *leading = meaning.leading;
            *concepts = meaning.activations.to_vec();
        }
        growths.feel(percept.present, percept.released);
        let frame = ReplayedFrame {
            contacts: contacts(&percept, layout, growths),
            released: percept.released.iter().map(|placed| placed.contact.id).collect(),
            dropped: Some(percept.dropped).filter(|dropped| *dropped > 0),
            tare: matches!(percept.tare, Tare::Running { .. }).then_some(true),
            time_us: time.0,
            intent: MeaningOfTouch::of(*leading, names, concepts),
        };
        // Numbers, texts and keys that are texts: this cannot fail.
        serde_json::to_value(frame).unwrap_or_default()
    }
}

/// A frame processed by the host.
#[derive(Debug, Serialize)]
struct ReplayedFrame<'a> {
    contacts: Vec<ReplayedContact<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    released: Vec<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    dropped: Option<u16>,
    /// Absent unless a tare is running.
    #[serde(skip_serializing_if = "Option::is_none")]
    tare: Option<bool>,
    /// us.
    time_us: u64,
    intent: MeaningOfTouch,
}

/// A contact of such a frame.
#[derive(Debug, Serialize)]
struct ReplayedContact<'a> {
    #[serde(flatten)]
    contact: ContactLine<'a>,
    /// Frames; null while it has no form.
    form_age: Option<u8>,
    /// Counts per cm2; null while unknown.
    hardness: Option<u32>,
}

/// Contacts of a frame.
fn contacts<'a>(percept: &Percept<'_>, layout: &'a Layout, growths: &Growths) -> Vec<ReplayedContact<'a>> {
    let contact = |(index, placed): (usize, &Placed)| {
        let shape = Base::BUILT_IN.name(placed.shape.class).into();
        ReplayedContact {
            contact: ContactLine::of(placed, layout, shape, percept.unsure.is_unsure(index)),
            form_age: percept.form_ages.get(index).copied(),
            hardness: growths.hardness(placed.contact.id, layout),
        }
    };
    percept.present.iter().enumerate().map(contact).collect()
}
