//! Behaviour as its author writes it.

use crate::mind::Mover;
use serde::Deserialize;
use std::collections::BTreeMap;
use taxel_core::intent::Leading;

/// Behaviour of a robot when it is touched: `behaviour.toml`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BehaviourConfig {
    /// Name of the behaviour.
    pub name: String,
    /// Limits of all joints.
    #[serde(default)]
    pub joints: JointLimitConfig,
    /// Limits of joints by name, in place of those of all.
    #[serde(default)]
    pub joint: BTreeMap<String, JointConfig>,
    /// Motion away from what presses.
    #[serde(default)]
    pub retreat: RetreatConfig,
    /// Motion led by hand.
    #[serde(default, rename = "yield")]
    pub yields: YieldConfig,
    /// Two touches that oppose each other.
    #[serde(default)]
    pub clamp: ClampConfig,
    /// Return to the robot's own motion.
    #[serde(default)]
    pub resume: ResumeConfig,
    /// Energy that commands may give to what touches, J: the tank is full at the start, and never fuller.
    #[serde(default = "tank_j")]
    pub tank_j: f64,
    /// Ages from which nothing is commanded.
    #[serde(default)]
    pub faults: FaultConfig,
    /// Pairs of links that commands keep apart.
    #[serde(default)]
    pub apart: Vec<ApartConfig>,
    /// Greatest forces by part of the body.
    #[serde(default)]
    pub limits: Vec<ForceLimitConfig>,
    /// Rows: of each touch, the first that fits counts.
    #[serde(default)]
    pub when: Vec<WhenConfig>,
}

fn tank_j() -> f64 {
    1.0
}

/// Limits of all joints.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct JointLimitConfig {
    /// Greatest velocity, rad/s or m/s; less where the URDF says less.
    pub velocity: f64,
    /// Greatest acceleration, rad/s^2 or m/s^2.
    pub acceleration: f64,
    /// Distance kept from the limits of the URDF, rad or m.
    pub margin: f64,
}

impl Default for JointLimitConfig {
    fn default() -> JointLimitConfig {
        JointLimitConfig { velocity: 1.5, acceleration: 15.0, margin: 0.05 }
    }
}

/// Limits of a joint.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct JointConfig {
    /// False: the joint is never moved.
    pub moves: Option<bool>,
    /// As [`JointLimitConfig::velocity`].
    pub velocity: Option<f64>,
    /// As [`JointLimitConfig::acceleration`].
    pub acceleration: Option<f64>,
    /// As [`JointLimitConfig::margin`].
    pub margin: Option<f64>,
}

/// Motion away from what presses.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RetreatConfig {
    /// Speed of the touched point, m/s.
    pub speed: f64,
    /// Time for which it goes on once its cause is over, s.
    pub seconds: f64,
    /// Share of a limit of force from which on the robot retreats, 0 to 1.
    pub begin: f64,
}

impl Default for RetreatConfig {
    fn default() -> RetreatConfig {
        RetreatConfig { speed: 0.25, seconds: 0.3, begin: 0.5 }
    }
}

/// Motion led by hand: a mass in a viscous medium, without a spring.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct YieldConfig {
    /// Mass that the hand feels, kg.
    pub mass: f64,
    /// Damping that the hand feels, N s/m.
    pub damping: f64,
    /// Time of touch before it leads, s; at least 0.3.
    pub after_s: f64,
    /// Greatest speed, m/s.
    pub speed: f64,
    /// Time constant with which a link comes to rest that is let go, s.
    pub rest_s: f64,
}

impl Default for YieldConfig {
    fn default() -> YieldConfig {
        YieldConfig { mass: 5.0, damping: 16.0, after_s: 0.3, speed: 0.4, rest_s: 0.04 }
    }
}

/// Two touches that oppose each other.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ClampConfig {
    /// Force from which on a touch counts, N.
    pub newtons: f64,
    /// Greatest cosine of the angle of their normals.
    pub cosine: f64,
    /// Time for which the robot stays stopped after it, s.
    pub seconds: f64,
}

impl Default for ClampConfig {
    fn default() -> ClampConfig {
        ClampConfig { newtons: 2.0, cosine: -0.7, seconds: 0.3 }
    }
}

/// Return to the robot's own motion.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ResumeConfig {
    /// Time without a cause before it, s.
    pub after_s: f64,
    /// Time from standstill to full speed, s.
    pub over_s: f64,
}

impl Default for ResumeConfig {
    fn default() -> ResumeConfig {
        ResumeConfig { after_s: 1.0, over_s: 1.0 }
    }
}

/// Ages from which nothing is commanded.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FaultConfig {
    /// Age of the posture, ms.
    pub posture_ms: f64,
    /// Age of a board's last frame, ms; three of its periods if these are longer.
    pub frame_ms: f64,
    /// Time between two cycles, ms.
    pub cycle_ms: f64,
}

impl Default for FaultConfig {
    fn default() -> FaultConfig {
        FaultConfig { posture_ms: 50.0, frame_ms: 20.0, cycle_ms: 50.0 }
    }
}

/// Two links that commands keep apart: each is the line from its origin to that of the farthest link that hangs on it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ApartConfig {
    /// Names of the links.
    pub links: [String; 2],
    /// Least distance of their lines, m.
    pub metres: f64,
}

/// A greatest force on a part of the body.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ForceLimitConfig {
    /// Words of regions and links; none stand for the whole robot.
    #[serde(default)]
    pub part: Vec<String>,
    /// Greatest force, N.
    pub newtons: f64,
    /// Its source: `doi:` and a number, or the name of a document.
    pub source: String,
}

/// A row: of which touches it is, and what the robot does then.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WhenConfig {
    /// Words of regions and links; none stand for the whole robot.
    #[serde(default)]
    pub part: Vec<String>,
    /// Leading intention; any if left out.
    pub meaning: Option<Leading>,
    /// Whose motion has caused the touch; anyone's if left out.
    pub mover: Option<Mover>,
    /// Force from which on it counts, N.
    #[serde(default)]
    pub newtons: f64,
    /// The action.
    #[serde(rename = "do")]
    pub action: TouchAction,
    /// Factor on the speed of the robot's own motion, 0 to 1: of `slow` alone.
    pub factor: Option<f64>,
}

/// Action of a robot about a touch, in the order of priority.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TouchAction {
    /// Stands still.
    Stop,
    /// Moves away.
    Retreat,
    /// Is led by the hand.
    Yield,
    /// Moves on more slowly.
    Slow,
    /// Moves on.
    Ignore,
}

impl TouchAction {
    /// Its name in files.
    pub fn as_str(self) -> &'static str {
        match self {
            TouchAction::Stop => "stop",
            TouchAction::Retreat => "retreat",
            TouchAction::Yield => "yield",
            TouchAction::Slow => "slow",
            TouchAction::Ignore => "ignore",
        }
    }
}
