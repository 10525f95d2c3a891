//! The stages of a scene, checked against a garment.

use super::error::SceneError;
use crate::condition::Condition;
use crate::contact::Contacts;
use crate::format::Invalid;
use crate::garment::{Layout, PANELS};
use crate::gesture::Gestures;
use crate::intent::Intent;
use crate::react::Reactions;
use crate::scene::Scene;
use crate::shape::{BUILT_IN, Base, Shapes};
use crate::symbol::Symbols;

/// All stages of a scene.
#[derive(Debug, Clone)]
pub struct Pipeline {
    pub(super) panels: u8,
    pub(super) condition: Condition,
    pub(super) contact: Contacts,
    pub(super) shape: Option<Shapes<BUILT_IN>>,
    pub(super) symbol: Symbols,
    /// Touch over time; none: not recognised. It is no part of a scene, and stays where the scene or the garment changes.
    pub gestures: Option<Gestures>,
    pub(super) friendliness: [i8; PANELS],
    pub(super) intent: Option<Intent>,
    pub(super) react: Reactions,
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
