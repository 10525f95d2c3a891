//! Garment, scene, and the stages built from them; changed as a whole or not at all.

use super::info::BoardInfo;
use crate::acquire::{
    Depth, Fields, FrameTooLong, Unfit, check_duration, longest_frame_us, longest_self_test_us,
};
use crate::contact::ContactConfig;
use crate::format::{Invalid, InvalidRow};
use crate::garment::{Circuit, Garment, GarmentError, Layout};
use crate::pipeline::{Pipeline, SceneError};
use crate::react::{Cause, ReactionConfig};
use crate::scene::Scene;
use core::fmt;

/// A checked garment and scene. [`Setup::empty`] has neither.
#[derive(Debug, Clone)]
pub struct Setup {
    /// The garment as it was sent.
    pub garment: Garment,
    /// The scene as it was sent.
    pub scene: Scene,
    /// The garment's geometry.
    pub layout: Layout,
    /// The garment's wiring.
    pub circuit: Circuit,
    /// The scene's stages.
    pub pipeline: Pipeline,
}

/// Error of a garment or scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SetupError {
    /// The garment is invalid.
    Garment(GarmentError),
    /// The scene is invalid.
    Scene(SceneError),
    /// The garment with this scene takes longer than the watchdog allows.
    Slow(FrameTooLong),
    /// The scene asks for an interlaced scan, which the garment does not allow.
    Interlaced(Unfit),
}

impl fmt::Display for SetupError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SetupError::Garment(error) => write!(f, "garment: {error}"),
            SetupError::Scene(error) => write!(f, "scene: {error}"),
            SetupError::Slow(error) => error.fmt(f),
            SetupError::Interlaced(why) => write!(f, "plan.depth cannot be interlaced: {why}"),
        }
    }
}

impl core::error::Error for SetupError {}

impl From<GarmentError> for SetupError {
    fn from(error: GarmentError) -> Self {
        SetupError::Garment(error)
    }
}

impl From<FrameTooLong> for SetupError {
    fn from(error: FrameTooLong) -> Self {
        SetupError::Slow(error)
    }
}

impl From<Unfit> for SetupError {
    fn from(why: Unfit) -> Self {
        SetupError::Interlaced(why)
    }
}

impl From<SceneError> for SetupError {
    fn from(error: SceneError) -> Self {
        SetupError::Scene(error)
    }
}

/// Most bytes of one contact in a `Contacts` message.
const CONTACT_BYTES: u32 = 90;
/// Contacts of a typical scene, for which the rate of updates is checked against the link.
const TYPICAL_CONTACTS: u32 = 5;

impl Setup {
    /// No garment, and a scene without a map.
    pub fn empty() -> Setup {
        Setup {
            garment: Garment::default(),
            scene: Scene::empty(),
            layout: Layout::default(),
            circuit: Circuit::default(),
            pipeline: Pipeline::default(),
        }
    }

    /// Checks and builds a setup for a board that holds `capacity` taxels.
    pub fn build(
        info: &BoardInfo,
        mut garment: Garment,
        mut scene: Scene,
        capacity: usize,
    ) -> Result<Setup, SetupError> {
        let mut setup = Setup::empty();
        setup.change_garment(info, &mut garment, capacity)?;
        setup.change_scene(info, &mut scene)?;
        Ok(setup)
    }

    /// Replaces the garment and leaves the previous one in `garment`; an error changes nothing. The new parts
    /// are built beside the old ones, one after the other: a microcontroller's stack has no room for two
    /// setups.
    #[inline(never)]
    pub fn change_garment(
        &mut self,
        info: &BoardInfo,
        garment: &mut Garment,
        capacity: usize,
    ) -> Result<(), SetupError> {
        // A gain may raise a conditioned value above the converter's range.
        let layout = Layout::build(garment, capacity, u16::MAX)?;
        let circuit = Circuit::build(garment, &layout, info.pins)?;
        check(info, &self.scene, &circuit)?;
        check_duration(&circuit, &self.scene.plan)?;
        Fields::check(&circuit, &self.scene.plan)?;
        self.pipeline.fit(&self.scene, &layout)?;
        core::mem::swap(&mut self.garment, garment);
        (self.layout, self.circuit) = (layout, circuit);
        Ok(())
    }

    /// Replaces the scene and leaves the previous one in `scene`, because the stack has no room for a third;
    /// an error changes nothing. Settings outside the scene stay.
    #[inline(never)]
    pub fn change_scene(&mut self, info: &BoardInfo, scene: &mut Scene) -> Result<(), SetupError> {
        check(info, scene, &self.circuit)?;
        check_duration(&self.circuit, &scene.plan)?;
        Fields::check(&self.circuit, &scene.plan)?;
        scene.check_names(&self.layout).map_err(SceneError::Row)?;
        let done = self.pipeline.fill(scene, &self.layout);
        if done.is_err() {
            // The previous scene was valid.
            let _ = self.pipeline.fill(&self.scene, &self.layout);
        } else {
            core::mem::swap(&mut self.scene, scene);
        }
        done.map_err(SetupError::Scene)
    }

    /// Replaces the scene if it differs only in what may change while contacts and reactions last: the stream,
    /// gestures, and the number of forms. Returns none if it differs in more.
    #[inline(never)]
    pub fn adjust_scene(&mut self, info: &BoardInfo, scene: &mut Scene) -> Option<Result<(), SetupError>> {
        let Scene { stream, gestures, contact: ContactConfig { forms_in_frame, .. }, .. } = *scene;
        let old = &self.scene;
        (scene.stream, scene.gestures) = (old.stream, old.gestures);
        scene.contact.forms_in_frame = old.contact.forms_in_frame;
        let is_all = *scene == *old;
        (scene.stream, scene.gestures, scene.contact.forms_in_frame) = (stream, gestures, forms_in_frame);
        is_all.then(|| {
            check(info, scene, &self.circuit)?;
            stream.check().map_err(SceneError::from)?;
            self.pipeline.adjust(scene).map_err(SetupError::Scene)?;
            core::mem::swap(&mut self.scene, scene);
            Ok(())
        })
    }
}

/// Checks the scene against the board's link and pins and the garment's wiring.
#[inline(never)]
fn check(info: &BoardInfo, scene: &Scene, circuit: &Circuit) -> Result<(), SceneError> {
    let rate = u32::from(scene.stream.contacts_hz);
    let asked = rate.saturating_mul(CONTACT_BYTES).saturating_mul(TYPICAL_CONTACTS);
    if scene.stream.contacts_hz != u16::MAX && asked > info.link_bytes_per_s {
        let must = "must be lower: five contacts at this rate exceed the link";
        return Err(Invalid { parameter: "stream.contacts_hz", must }.into());
    }
    let (sites, plan) = (circuit.sites(), &scene.plan);
    if !sites.is_empty() && !sites.iter().any(|site| plan.reads(site.panel, site.block)) {
        let panels = sites.iter().any(|site| plan.reads_panel(site.panel));
        let parameter = if panels { "plan.blocks" } else { "plan.panels" };
        return Err(Invalid { parameter, must: "must leave a block of the garment to be read" }.into());
    }
    for (index, row) in scene.react.iter().enumerate() {
        let refuse = |parameter, must| {
            Err(InvalidRow { list: "react", index, invalid: Invalid { parameter, must } }.into())
        };
        if matches!(row.cause, Cause::Reflex(_)) && scene.plan.depth != Depth::Interlaced {
            return refuse("cause.reflex", "needs plan.depth = \"12 interlaced\"");
        }
        if row.cause == Cause::Blind && i64::from(row.level) * 1000 <= longest_pause_us(circuit, scene) as i64
        {
            return refuse("level", "must be longer than two frames and a self-test may take, ms");
        }
        let Some(line) = row.output else { continue };
        let refuse = |must| refuse("output.pin", must);
        if !info.pins.is_output(line.pin) {
            return refuse("must be a free output of this board");
        }
        if circuit.lines().contains(&line.pin) {
            return refuse("must not be a select line of the garment");
        }
        let is_shared = |other: &ReactionConfig| {
            let alone = [&other.cause, &row.cause].contains(&&Cause::Watching);
            other.output.is_some_and(|other| other.pin == line.pin && (alone || other != line))
        };
        if scene.react.iter().take(index).any(is_shared) {
            return refuse("must not be used twice, but by reactions that assert it at the same level");
        }
    }
    Ok(())
}

/// Longest time between two perceived frames in normal operation, us.
fn longest_pause_us(circuit: &Circuit, scene: &Scene) -> u64 {
    let period = 1_000_000u64.checked_div(scene.rate_hz.into()).unwrap_or(0);
    2 * longest_frame_us(circuit, &scene.plan).max(period) + longest_self_test_us(circuit)
}
