//! Recorded frames, run through the board's pipeline: what it perceives, as JSON.

use super::{contact, intent};
use crate::client::growths::Growths;
use crate::error::Result;
use serde_json::{Value, json};
use taxel_core::body::Placed;
use taxel_core::condition::Tare;
use taxel_core::format::{Code, Micros, Name, Q15};
use taxel_core::garment::{Garment, Layout};
use taxel_core::intent::Leading;
use taxel_core::pipeline::{Percept, Pipeline, PipelineState};
use taxel_core::scene::Scene;

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
    /// What it remembers.
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
        let mut object = perceived(&percept, layout, growths);
        object["time"] = json!(time.0 as f64 / 1e6);
        object["intent"] = intent(*leading, names, concepts);
        object
    }
}

/// Encodes what was perceived in a frame, except for the intention.
fn perceived(percept: &Percept<'_>, layout: &Layout, growths: &Growths) -> Value {
    let contact = |(index, placed): (usize, &Placed)| {
        let mut object = contact(placed, layout, percept.unsure.is_unsure(index));
        object["form_age"] = json!(percept.form_ages.get(index));
        object["hardness"] = json!(growths.hardness(placed.contact.id, layout));
        object
    };
    let mut object =
        json!({ "contacts": percept.present.iter().enumerate().map(contact).collect::<Vec<_>>() });
    if !percept.released.is_empty() {
        object["released"] = json!(percept.released.iter().map(|p| p.contact.id).collect::<Vec<_>>());
    }
    if percept.dropped > 0 {
        object["dropped"] = json!(percept.dropped);
    }
    if let Tare::Running { .. } = percept.tare {
        object["tare"] = json!(true);
    }
    object
}
