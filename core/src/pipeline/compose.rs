//! The stages of a scene, checked against a garment.

use super::error::SceneError;
use crate::condition::Condition;
use crate::contact::Contacts;
use crate::format::{Invalid, InvalidRow, LEFT_OUT};
use crate::garment::{Layout, PANELS};
use crate::gesture::Gestures;
use crate::intent::Intent;
use crate::react::Reactions;
use crate::scene::Scene;
use crate::shape::{Base, Shapes};
use crate::symbol::Symbols;

/// All stages of a scene. The default belongs to no scene.
#[derive(Debug, Default, Clone)]
pub struct Pipeline {
    pub(super) panels: u8,
    pub(super) condition: Condition,
    pub(super) contact: Contacts,
    pub(super) shape: Option<Shapes>,
    pub(super) symbol: Symbols,
    pub(super) gestures: Option<Gestures>,
    pub(super) friendliness: [i8; PANELS],
    pub(super) intent: Option<Intent>,
    pub(super) react: Reactions,
}

impl Pipeline {
    /// Checks and builds a scene for a garment.
    pub fn build(scene: &Scene, layout: &Layout) -> Result<Pipeline, SceneError> {
        let mut pipeline = Pipeline::default();
        pipeline.fill(scene, layout)?;
        Ok(pipeline)
    }

    /// Builds a scene in place, because a microcontroller's stack has no room for a second pipeline. After an
    /// error some stages are those of the new scene and some are not: fill it again with the previous scene.
    pub fn fill(&mut self, scene: &Scene, layout: &Layout) -> Result<(), SceneError> {
        scene.stream.check()?;
        self.panels = scene.plan.panels;
        self.condition = scene.condition.build()?;
        self.adjust(scene)?;
        self.symbol = scene.symbol.build()?;
        self.build_shapes(scene)?;
        self.build_intent(scene)?;
        self.fit(scene, layout)
    }

    /// Adapts the pipeline of `scene` to another garment; an error changes nothing.
    #[inline(never)]
    pub fn fit(&mut self, scene: &Scene, layout: &Layout) -> Result<(), SceneError> {
        let friendliness = friendliness(scene, layout)?;
        self.react = Reactions::build(&scene.react, layout, self.intent().map(Intent::map))?;
        self.friendliness = friendliness;
        Ok(())
    }

    #[inline(never)]
    fn build_shapes(&mut self, scene: &Scene) -> Result<(), SceneError> {
        self.shape = scene.shape.map(|shape| shape.build(Base::BUILT_IN)).transpose()?;
        Ok(())
    }

    #[inline(never)]
    fn build_intent(&mut self, scene: &Scene) -> Result<(), SceneError> {
        match &scene.intent {
            Some(_) if !cfg!(feature = "intent") => {
                return Err(Invalid { parameter: "intent", must: LEFT_OUT }.into());
            }
            Some(intent) => self.intent.get_or_insert_default().fill(intent)?,
            None => self.intent = None,
        }
        Ok(())
    }

    /// Builds the stages anew whose settings may change while contacts and reactions last; an error changes
    /// nothing.
    #[inline(never)]
    pub fn adjust(&mut self, scene: &Scene) -> Result<(), SceneError> {
        if scene.gestures.is_some() && !cfg!(feature = "gesture") {
            return Err(Invalid { parameter: "gestures", must: LEFT_OUT }.into());
        }
        let gestures = scene.gestures.as_ref().map(Gestures::build).transpose()?;
        (self.contact, self.gestures) = (scene.contact.build()?, gestures);
        Ok(())
    }

    /// The stage that infers the intention.
    pub fn intent(&self) -> Option<&Intent> {
        self.intent.as_ref().filter(|_| cfg!(feature = "intent"))
    }

    /// The table of reactions.
    pub fn reactions(&self) -> &Reactions {
        &self.react
    }
}

/// Friendliness of touches by region of the garment, percent.
fn friendliness(scene: &Scene, layout: &Layout) -> Result<[i8; PANELS], InvalidRow> {
    let mut friendliness = [0; PANELS];
    for (index, entry) in scene.friendliness.iter().enumerate() {
        if !(-100..=100).contains(&entry.percent) {
            let invalid = Invalid { parameter: "percent", must: "must be -100 to 100" };
            return Err(InvalidRow { list: "friendliness", index, invalid });
        }
        // A scene may name regions that this garment does not cover.
        let region = layout.regions().iter().position(|region| *region == entry.region);
        if let Some(percent) = region.and_then(|region| friendliness.get_mut(region)) {
            *percent = entry.percent;
        }
    }
    Ok(friendliness)
}
