//! A script of touches as written by its author: one small TOML file (docs/guides/touches.md).
//!
//! Times are seconds since the board started, forces newtons; lengths end in `_mm`, or are in taxels of the
//! panel if they have no unit (`at`, `velocity`). A panel's point (0, 0) is the centre of its first taxel.

use super::touch::Touch;
use super::trace::Trace;
use libm::cos;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use taxel_core::selftest::PinFault;

/// A script of touches: place, time and force of touches on a simulated garment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Script {
    /// Short name; the file's stem if absent.
    #[serde(default)]
    pub name: String,
    /// Title.
    #[serde(default)]
    pub title: String,
    /// Description, in a sentence or two.
    #[serde(default)]
    pub description: String,
    /// Length, s. Afterwards the garment stays at rest.
    pub duration_s: f64,
    /// Folder of its file, to which paths in it are relative.
    #[serde(skip)]
    pub folder: PathBuf,
    /// Preset, or TOML file of a garment.
    #[serde(default = "reference")]
    pub garment: String,
    /// Seed of the taxels' spread, of noise and of random faults.
    #[serde(default = "one_u64")]
    pub seed: u64,
    /// Frames at the start averaged by a tare; nothing should touch the garment yet.
    #[serde(default = "tare_frames")]
    pub tare_frames: u32,
    /// Settings of the scene that differ from the defaults, passed on unchanged.
    #[serde(default)]
    pub scene: toml::Table,
    /// The garment at rest.
    #[serde(default)]
    pub idle: Idle,
    /// Broken taxels and wires.
    #[serde(default)]
    pub faults: Faults,
    /// Effects of the wiring on the signal; none by default.
    #[serde(default)]
    pub wiring: WiringEffects,
    /// Response of the taxels to force; equal and linear by default.
    #[serde(default)]
    pub sensor: Sensor,
    /// Effects of the converter on the signal; only rounding by default.
    #[serde(default)]
    pub converter: Converter,
    /// The touches.
    #[serde(default, rename = "touch")]
    pub touches: Vec<Touch>,
    /// Touches that follow a path.
    #[serde(default, rename = "trace")]
    pub traces: Vec<Trace>,
    /// Movements of the robot's joints.
    #[serde(default, rename = "joint")]
    pub joints: Vec<Joint>,
}

/// The garment at rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Idle {
    /// Mean code of an untouched taxel, counts.
    pub base_code: f64,
    /// Spread of this code among taxels, standard deviation, counts.
    pub spread_counts: f64,
    /// Noise of a sample, counts rms.
    pub noise_counts: f64,
    /// Mean drift of a taxel, counts per second; taxels differ by at most half of it.
    pub drift_counts_per_s: f64,
}

impl Default for Idle {
    fn default() -> Idle {
        Idle { base_code: 90.0, spread_counts: 10.0, noise_counts: 3.0, drift_counts_per_s: 0.0 }
    }
}

/// Broken taxels, by number, and broken wires.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Faults {
    /// Time at which they break, s.
    pub from_s: f64,
    /// Taxels that do not respond to pressure.
    pub dead: Vec<u16>,
    /// Number of further dead taxels, chosen by the seed.
    pub dead_count: u16,
    /// Taxels with a broken line: no signal.
    pub open: Vec<u16>,
    /// Taxels with a short circuit: full signal.
    pub shorted: Vec<u16>,
    /// Taxels with a constant code, without noise.
    pub stuck: Vec<Stuck>,
    /// Noisy taxels.
    pub noisy: Vec<Noisy>,
    /// Select lines and inputs that are stuck, bridged, open or shorted, by GPIO number.
    pub pins: Vec<PinFault>,
}

/// A taxel with extra noise.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Noisy {
    /// Number of the taxel.
    pub taxel: u16,
    /// Noise, counts rms.
    pub counts: f32,
}

/// A taxel with a constant code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stuck {
    /// Number of the taxel.
    pub taxel: u16,
    /// The code, counts.
    pub code: u16,
}

/// Effects of the wiring on the signal; all zero for ideal wiring.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct WiringEffects {
    /// Resistance that charges a converter input's line, kOhm.
    pub source_kohm: f64,
    /// Capacitance of that line, pF. The voltage settles with the product as time constant after a change of
    /// a select line.
    pub line_pf: f64,
    /// Coupling through common lines: share of the signal of every taxel on the same wired row or column of
    /// the block that is added to a taxel's own.
    pub crosstalk: f64,
    /// Passive matrices: three pressed corners of a rectangle also show at the fourth.
    pub passive: bool,
}

impl WiringEffects {
    /// Time constant of the line, ns.
    pub fn settling_ns(&self) -> f64 {
        self.source_kohm * self.line_pf
    }

    /// True if the wiring has no effect.
    pub fn is_ideal(&self) -> bool {
        self.settling_ns() == 0.0 && self.crosstalk == 0.0 && !self.passive
    }
}

/// Response of the taxels to force.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Sensor {
    /// Spread of the gain among taxels, standard deviation, share of 1.
    pub gain_spread: f64,
    /// Difference of the signal between decreasing and increasing force, as a share of the signal: half of it
    /// above and half below the truth far below the peak, none at the peak.
    pub hysteresis: f64,
    /// Noise proportional to the signal, rms share of it, besides that of the garment at rest: the position
    /// of the fabric changes every 20 ms.
    pub noise: f64,
    /// Force on a taxel at which the signal is half of a linear one, N: a divider with a fixed resistor; 0
    /// for linear.
    pub half_n: f64,
}

/// Effects of the converter on the signal.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Converter {
    /// The RP2040's differential nonlinearity: codes 512, 1536, 2560 and 3584 are nine codes wide.
    pub dnl: bool,
    /// Noise of the converter itself, counts rms.
    pub noise_counts: f64,
}

/// A joint of the robot that bends and straightens with the time profile of a touch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Joint {
    /// Name of the joint.
    pub name: String,
    /// Angle at rest, degrees.
    #[serde(default)]
    pub from_deg: f64,
    /// Angle reached, degrees.
    pub to_deg: f64,
    /// Begin of the movement, s.
    pub start_s: f64,
    /// Duration of the movement, s.
    pub rise_s: f64,
    /// Time at the reached angle, s.
    #[serde(default)]
    pub hold_s: f64,
    /// Duration of the return, s; without it the joint stays.
    pub fall_s: Option<f64>,
}

impl Joint {
    /// Angle at a time (s), degrees.
    pub fn angle_deg(&self, t_s: f64) -> f64 {
        let bend = |part: f64| 0.5 - 0.5 * cos(std::f64::consts::PI * part.clamp(0.0, 1.0));
        let up = if self.rise_s > 0.0 {
            (t_s - self.start_s) / self.rise_s
        } else {
            f64::from(t_s >= self.start_s)
        };
        let back = self.fall_s.map_or(0.0, |fall| {
            let since = t_s - self.start_s - self.rise_s - self.hold_s;
            if fall > 0.0 { since / fall } else { f64::from(since >= 0.0) }
        });
        self.from_deg + (self.to_deg - self.from_deg) * (bend(up) - bend(back))
    }
}

impl Script {
    /// The angles of the robot's joints at a time (s), degrees: see [`posture`].
    pub fn posture(&self, t_s: f64) -> impl Iterator<Item = (&str, f64)> {
        posture(&self.joints, t_s)
    }

    /// Returns the same garment, which nothing touches and no joint bends.
    pub fn untouched(&self) -> Script {
        let (touches, traces, joints) = (Vec::new(), Vec::new(), Vec::new());
        Script { touches, traces, joints, ..self.clone() }
    }

    /// True if nothing happens.
    pub fn is_empty(&self) -> bool {
        self.touches.is_empty() && self.traces.is_empty() && self.joints.is_empty()
    }
}

/// The angles of joints at a time (s), degrees. Of a joint's movements the one that began last counts; before all
/// of them, the first.
pub fn posture(movements: &[Joint], t_s: f64) -> impl Iterator<Item = (&str, f64)> {
    let rank = move |joint: &Joint| if joint.start_s <= t_s { joint.start_s } else { -1.0 - joint.start_s };
    let counts = move |joint: &&Joint| {
        movements.iter().all(|other| other.name != joint.name || rank(other) <= rank(joint))
    };
    movements.iter().filter(counts).map(move |joint| (joint.name.as_str(), joint.angle_deg(t_s)))
}

fn reference() -> String {
    "reference".into()
}

fn tare_frames() -> u32 {
    16
}

fn one_u64() -> u64 {
    1
}
