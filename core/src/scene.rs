//! The scene: settings of one deployment, as one small checked value.

use crate::acquire::{Depth, Plan};
use crate::condition::{ConditionConfig, Filter};
use crate::contact::ContactConfig;
use crate::fold::JOINTS;
use crate::format::{Invalid, InvalidRow, LEFT_OUT, Name, name};
use crate::garment::{Layout, Line, PANELS};
use crate::gesture::GestureConfig;
use crate::intent::{IntentConfig, Leading, MapInput, Source, tactile};
use crate::react::{Cause, REACTIONS, ReactionConfig};
use crate::reflex::Agree;
use crate::shape::ShapeConfig;
use crate::symbol::SymbolConfig;
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Friendliness of a touch of a region.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Friendliness {
    /// Region of the body.
    pub region: Name,
    /// Percent, -100 ..= 100.
    pub percent: i8,
}

/// Regions of the shipped scene. Any scene may name them, even if the garment does not cover them.
const USUAL_REGIONS: [(&str, i8); 4] = [("chest", 20), ("back", 60), ("left arm", 40), ("right arm", 40)];

/// Content of the stream, and its largest rates (0: never; 65535: with every scan).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct StreamConfig {
    /// Conditioned images per second.
    pub frames_hz: u16,
    /// Contact lists per second; onsets and releases are always sent.
    pub contacts_hz: u16,
    /// True if symbols are sent.
    pub symbols: bool,
    /// True if intentions are sent.
    pub intent: bool,
    /// Reports per second of what presses on the robot, from a board whose surface is known. With more than 16
    /// contacts, or more than 512 taxels under them, at most with every second scan.
    pub pressing_hz: u16,
    /// True if lists of contacts say how old their forms are.
    pub form_ages: bool,
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
            pressing_hz: 0,
            form_ages: false,
            key_ms: 1000,
        }
    }
}

impl StreamConfig {
    /// Checks the limits that hold on every board.
    pub(crate) fn check(&self) -> Result<(), Invalid> {
        if !cfg!(feature = "surface") && self.pressing_hz > 0 {
            return Err(Invalid { parameter: "stream.pressing_hz", must: LEFT_OUT });
        }
        match self.key_ms {
            1..=1000 => Ok(()),
            _ => Err(Invalid { parameter: "stream.key_ms", must: "must be 1 to 1000" }),
        }
    }
}

/// Settings of one deployment. Written as a file, sent as one message, returned in `Hello`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Scene {
    /// Name for people.
    pub name: Name,
    /// Panels and blocks to scan, and how.
    pub plan: Plan,
    /// Most scans per second; 0: as many as the board can do.
    pub rate_hz: u16,
    /// Baseline, calibration, filter.
    pub condition: ConditionConfig,
    /// Contacts and their tracking.
    pub contact: ContactConfig,
    /// Shapes; none: not recognised.
    pub shape: Option<ShapeConfig>,
    /// Touch over time; none: no gestures are recognised.
    pub gestures: Option<GestureConfig>,
    /// Thresholds of the words.
    pub symbol: SymbolConfig,
    /// Fuzzy cognitive map and its decision; none: no intention.
    pub intent: Option<IntentConfig>,
    /// Friendliness of touches by region; 0 for regions not listed.
    pub friendliness: Vec<Friendliness, PANELS>,
    /// Joints whose angles the host sends.
    pub joints: Vec<Name, JOINTS>,
    /// Reactions that the board runs by itself.
    pub react: Vec<ReactionConfig, REACTIONS>,
    /// Stream to the host.
    pub stream: StreamConfig,
}

impl Default for Scene {
    fn default() -> Self {
        Scene::shipped()
    }
}

impl Scene {
    /// A scene with the defaults of every stage and no optional stage.
    pub fn empty() -> Scene {
        Scene {
            name: Name::new(),
            plan: Plan::default(),
            rate_hz: 0,
            condition: ConditionConfig::default(),
            contact: ContactConfig::default(),
            shape: None,
            gestures: None,
            symbol: SymbolConfig::default(),
            intent: None,
            friendliness: Vec::new(),
            joints: Vec::new(),
            react: Vec::new(),
            stream: StreamConfig::default(),
        }
    }

    /// The shipped scene: every stage on that this build has, limits for 12 bits and 1000 counts per newton.
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
            // 4.5 standard deviations of a noise of 3 counts; a pat gives 110 counts per taxel.
            condition: ConditionConfig { floor: 14, filter: Filter::Persistent, track_baseline: true },
            contact: ContactConfig { low: 16, high: 40, ..ContactConfig::default() },
            shape: Some(ShapeConfig::default()),
            gestures: None,
            symbol: SymbolConfig::default(),
            intent: cfg!(feature = "intent").then(|| IntentConfig::new(tactile())),
            friendliness: USUAL_REGIONS
                .into_iter()
                .map(|(region, percent)| Friendliness { region: name(region), percent })
                .collect(),
            joints: [name("left_elbow"), name("right_elbow")].into_iter().collect(),
            react: [
                Some(reaction("over-pressure", Cause::Pressure, 3_600, 400, 18)),
                cfg!(feature = "intent")
                    .then(|| reaction("flinch", Cause::Leading(Leading::Attack), 1, 0, 19)),
            ]
            .into_iter()
            .flatten()
            .collect(),
            stream: StreamConfig::default(),
        }
    }

    /// Sets an interlaced scan, and makes every reaction to pressure a reflex.
    pub fn interlaced(mut self, agree: Agree) -> Scene {
        self.plan.depth = Depth::Interlaced;
        for row in self.react.iter_mut().filter(|row| row.cause == Cause::Pressure) {
            row.cause = Cause::Reflex(agree);
        }
        self
    }

    /// Checks the names of joints, and those of regions against the garment's layout.
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

    /// Adapts the scene to Gaussian noise of that many counts (standard deviation): noise alone starts no
    /// contact for hours, and a touch of 2x2 taxels is found from five standard deviations on, 990 times in
    /// 1,000 in its first frame.
    ///
    /// One taxel cannot distinguish that touch from noise, but the mean of 2x2 taxels has half the noise.
    /// [`Filter::Square`] passes 3.25 standard deviations of a taxel only if the mean of a square reaches 6.5
    /// of its own, which noise does in one of 12 million frames of 2,048 taxels. The touch is 3.5 of them
    /// above that.
    pub fn against_noise(mut self, deviation: u16) -> Scene {
        let times = |factor: u16| deviation.saturating_mul(factor).max(1);
        self.condition.filter = Filter::Square;
        self.condition.floor = self.condition.floor.max(times(2));
        // Two thirds of the high threshold, which small taxels then do not lower.
        self.contact.low = self.contact.low.max((u32::from(deviation) * 13).div_ceil(6).min(0xffff) as u16);
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
            let pressure = |input: &&mut MapInput| {
                use Source::{Blow, Force, Hardness, Load, Loading, Peak, Press, Pressure, Rise};
                let linear = matches!(input.source, Press | Rise | Hardness | Blow | Load | Peak);
                linear || matches!(input.source, Force | Pressure | Loading)
            };
            for input in intent.map.inputs.iter_mut().filter(pressure) {
                input.low = scale(input.low.unsigned_abs()).min(i32::MAX as u32) as i32;
                input.high = scale(input.high.unsigned_abs()).min(i32::MAX as u32) as i32;
            }
        }
        scene
    }
}
