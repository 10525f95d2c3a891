//! The scene: what one deployment needs, as one small checked value.

use crate::acquire::{Depth, Plan};
use crate::condition::{ConditionConfig, Filter};
use crate::contact::ContactConfig;
use crate::fold::JOINTS;
use crate::format::{Invalid, InvalidRow, Name, name};
use crate::garment::{Layout, Line, PANELS};
use crate::intent::{Input, IntentConfig, Source, tactile};
use crate::react::{Cause, REACTIONS, ReactionConfig};
use crate::reflex::Agree;
use crate::shape::ShapeConfig;
use crate::symbol::SymbolConfig;
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// How friendly it is to touch a region.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Friendliness {
    /// The region of the body.
    pub region: Name,
    /// -100 ..= 100 percent.
    pub percent: i8,
}

/// Regions that the scene that ships speaks of: any scene may, whether or not the garment covers them.
const USUAL_REGIONS: [(&str, i8); 4] = [("chest", 20), ("back", 60), ("left arm", 40), ("right arm", 40)];

/// What is streamed, and at most how often (0: never; 65535: with every scan).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct StreamConfig {
    /// Conditioned images per second.
    pub frames_hz: u16,
    /// Contact updates per second; onsets and releases are told in any case.
    pub contacts_hz: u16,
    /// Symbols are told.
    pub symbols: bool,
    /// Intentions are told.
    pub intent: bool,
    /// Raw codes per second.
    pub raw_hz: u16,
    /// Longest time between two key frames, ms, 1 ..= 1000.
    pub key_ms: u16,
}

impl Default for StreamConfig {
    fn default() -> Self {
        StreamConfig {
            frames_hz: u16::MAX,
            contacts_hz: u16::MAX,
            symbols: true,
            intent: true,
            raw_hz: 0,
            key_ms: 1000,
        }
    }
}

impl StreamConfig {
    /// Checks what does not depend on a board.
    pub(crate) fn check(&self) -> Result<(), Invalid> {
        match self.key_ms {
            1..=1000 => Ok(()),
            _ => Err(Invalid { parameter: "stream.key_ms", must: "must be 1 to 1000" }),
        }
    }
}

/// What one deployment needs. Authored as a file, sent as one message, echoed in `Hello`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Scene {
    /// What people call it.
    pub name: Name,
    /// What is scanned.
    pub plan: Plan,
    /// Scans per second at most; 0: as many as the board can.
    pub rate_hz: u16,
    /// Baseline, calibration, filter.
    pub condition: ConditionConfig,
    /// Contacts and how they are followed.
    pub contact: ContactConfig,
    /// Shapes; none: not recognised.
    pub shape: Option<ShapeConfig>,
    /// Limits between words.
    pub symbol: SymbolConfig,
    /// The map and how it decides; none: no intention.
    pub intent: Option<IntentConfig>,
    /// How friendly it is to touch a region; 0 where none is given.
    pub friendliness: Vec<Friendliness, PANELS>,
    /// Joints whose angles the host tells.
    pub joints: Vec<Name, JOINTS>,
    /// What the garment does by itself.
    pub react: Vec<ReactionConfig, REACTIONS>,
    /// What is streamed.
    pub stream: StreamConfig,
}

impl Default for Scene {
    fn default() -> Self {
        Scene::shipped()
    }
}

impl Scene {
    /// Nothing but what every scene has, with the usual settings.
    pub fn empty() -> Scene {
        Scene {
            name: Name::new(),
            plan: Plan::default(),
            rate_hz: 0,
            condition: ConditionConfig::default(),
            contact: ContactConfig::default(),
            shape: None,
            symbol: SymbolConfig::default(),
            intent: None,
            friendliness: Vec::new(),
            joints: Vec::new(),
            react: Vec::new(),
            stream: StreamConfig::default(),
        }
    }

    /// The scene that ships: everything on, limits for 12 bit and 1000 counts per newton.
    pub fn shipped() -> Scene {
        let reaction = |text, cause, level, hysteresis, pin| ReactionConfig {
            name: name(text),
            cause,
            region: Name::new(),
            level,
            hysteresis,
            hold_ms: 100,
            output: Some(Line { pin, inverted: false }),
        };
        Scene {
            name: name("shipped"),
            plan: Plan::default(),
            rate_hz: 0,
            // Four and a half standard deviations of a noise of 3 counts; a pat gives 110 counts per taxel.
            condition: ConditionConfig { floor: 14, filter: Filter::Persistent, track_baseline: true },
            contact: ContactConfig { low: 16, high: 40, ..ContactConfig::default() },
            shape: Some(ShapeConfig::default()),
            symbol: SymbolConfig::default(),
            intent: Some(IntentConfig::new(tactile())),
            friendliness: USUAL_REGIONS
                .into_iter()
                .map(|(region, percent)| Friendliness { region: name(region), percent })
                .collect(),
            joints: [name("left_elbow"), name("right_elbow")].into_iter().collect(),
            react: [
                reaction("over-pressure", Cause::Pressure, 3_600, 400, 18),
                reaction("flinch", Cause::Leading(crate::intent::Leading::Attack), 1, 0, 19),
            ]
            .into_iter()
            .collect(),
            stream: StreamConfig::default(),
        }
    }

    /// The same with an interlaced scan, in which the reactions to pressure begin by reflex.
    pub fn interlaced(mut self, agree: Agree) -> Scene {
        self.plan.depth = Depth::Interlaced;
        for row in self.react.iter_mut().filter(|row| row.cause == Cause::Pressure) {
            row.cause = Cause::Reflex(agree);
        }
        self
    }

    /// Checks the names of joints, and of regions of the garment that the scene is for.
    pub fn check_names(&self, layout: &Layout) -> Result<(), InvalidRow> {
        let refuse = |list, index, parameter, must| {
            Err(InvalidRow { list, index, invalid: Invalid { parameter, must } })
        };
        for (index, Friendliness { region, .. }) in self.friendliness.iter().enumerate() {
            let usual = USUAL_REGIONS.iter().any(|(usual, _)| *usual == region.as_str());
            if !usual && !layout.regions().contains(region) {
                return refuse("friendliness", index, "region", "must be a region of the garment");
            }
            if self.friendliness.iter().take(index).any(|other| other.region == *region) {
                return refuse("friendliness", index, "region", "must not be given twice");
            }
        }
        for (index, joint) in self.joints.iter().enumerate() {
            if joint.is_empty() {
                return refuse("joints", index, "", "must not be empty");
            }
            if self.joints.iter().take(index).any(|other| other == joint) {
                return refuse("joints", index, "", "must not be given twice");
            }
        }
        Ok(())
    }

    /// The same for codes with a Gaussian noise of that many counts (standard deviation): noise alone begins
    /// no contact for hours, and a touch of 2x2 taxels is found from five standard deviations on, 990 times
    /// in 1,000 in its first frame.
    ///
    /// No taxel alone tells that touch from noise, but the mean of 2x2 has half the noise: where
    /// [`Filter::Square`] leaves 3.25 standard deviations of a taxel, 6.5 of the mean were reached, which in
    /// 2,048 taxels noise does in one of 12 million frames; and the touch is 3.5 of them above that.
    pub fn against_noise(mut self, deviation: u16) -> Scene {
        let times = |factor: u16| deviation.saturating_mul(factor).max(1);
        self.condition.filter = Filter::Square;
        self.condition.floor = self.condition.floor.max(times(2));
        self.contact.low = self.contact.low.max(times(2));
        self.contact.high = self.contact.high.max((u32::from(deviation) * 13 / 4).min(0xffff) as u16);
        self
    }

    /// The shipped scene with every limit of pressure scaled from 4095 to another full scale.
    pub fn scaled(full_scale: u16) -> Scene {
        let mut scene = Scene::shipped();
        let scale = |counts: u32| (counts * u32::from(full_scale)).div_ceil(4095).max(1);
        let scale16 = |counts: u16| scale(counts.into()).min(u16::MAX.into()) as u16;
        scene.condition.floor = scale16(scene.condition.floor);
        scene.contact.low = scale16(scene.contact.low);
        scene.contact.high = scale16(scene.contact.high);
        scene.symbol.strength = scene.symbol.strength.map(scale);
        for row in scene
            .react
            .iter_mut()
            .filter(|row| matches!(row.cause, Cause::Pressure | Cause::Force | Cause::Reflex(_)))
        {
            row.level = scale(row.level.unsigned_abs()) as i32;
            row.hysteresis = scale(row.hysteresis.unsigned_abs()) as i32;
        }
        if let Some(intent) = &mut scene.intent {
            let pressure = |input: &&mut Input| {
                use Source::{Blow, Hardness, Load, Peak, Press, Rise};
                matches!(input.source, Press | Rise | Hardness | Blow | Load | Peak)
            };
            for input in intent.map.inputs.iter_mut().filter(pressure) {
                input.low = scale(input.low.unsigned_abs()).min(i32::MAX as u32) as i32;
                input.high = scale(input.high.unsigned_abs()).min(i32::MAX as u32) as i32;
            }
        }
        scene
    }
}
