//! A script of touches as its author writes it: one small TOML file (docs/touches.md).
//!
//! Times are seconds since the board started, forces newtons; lengths end in `_mm`, or are in taxels of the
//! panel where they carry no unit (`at`, `velocity`). A panel's point (0, 0) is the centre of its first
//! taxel.

use super::touch::Touch;
use serde::{Deserialize, Serialize};
use taxel_core::selftest::PinFault;

/// A script of touches: who touches a simulated garment where, when and how hard.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Script {
    /// Short name; a file's stem where the file does not say.
    #[serde(default)]
    pub name: String,
    /// What it shows, in a few words.
    #[serde(default)]
    pub title: String,
    /// What it shows, in a sentence or two.
    #[serde(default)]
    pub description: String,
    /// Length, s. The garment goes on at rest after it.
    pub duration_s: f64,
    /// A garment that comes with the program, or a garment's TOML file.
    #[serde(default = "reference")]
    pub garment: String,
    /// Seed of the taxels' spread, of noise and of random faults.
    #[serde(default = "one_u64")]
    pub seed: u64,
    /// Frames at the start over which the board is tared; nothing should touch the garment yet.
    #[serde(default = "tare_frames")]
    pub tare_frames: u32,
    /// Settings of the deployment that differ from the defaults, handed on as they are.
    #[serde(default)]
    pub scene: toml::Table,
    /// The garment at rest.
    #[serde(default)]
    pub idle: Idle,
    /// Broken taxels and wires.
    #[serde(default)]
    pub faults: Faults,
    /// What the wiring does to the signal; nothing by default.
    #[serde(default)]
    pub wiring: WiringEffects,
    /// How the taxels answer to force; all alike and straight by default.
    #[serde(default)]
    pub sensor: Sensor,
    /// What the converter does to the signal; nothing but rounding by default.
    #[serde(default)]
    pub converter: Converter,
    /// The touches.
    #[serde(default, rename = "touch")]
    pub touches: Vec<Touch>,
    /// How the robot's joints move meanwhile.
    #[serde(default, rename = "joint")]
    pub joints: Vec<Joint>,
}

/// The garment at rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Idle {
    /// Mean code of a taxel that nothing touches, counts.
    pub base_code: f64,
    /// Standard deviation of that code from taxel to taxel, counts.
    pub spread_counts: f64,
    /// Noise of a sample, counts rms.
    pub noise_counts: f64,
    /// Mean drift of a taxel, counts per second; taxels differ by half of it at most.
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
    /// When they break, s.
    pub from_s: f64,
    /// Taxels that no longer answer to pressure.
    pub dead: Vec<u16>,
    /// That many more dead taxels, chosen by the seed.
    pub dead_count: u16,
    /// Taxels whose line is broken: no signal.
    pub open: Vec<u16>,
    /// Taxels with a short circuit: full signal.
    pub shorted: Vec<u16>,
    /// Taxels that give one code, without noise.
    pub stuck: Vec<Stuck>,
    /// Taxels that are noisy.
    pub noisy: Vec<Noisy>,
    /// Select lines and inputs that are stuck, bridged, open or shorted, by GPIO number.
    pub pins: Vec<PinFault>,
}

/// A taxel with a noise of its own.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Noisy {
    /// Number of the taxel.
    pub taxel: u16,
    /// Its noise, counts rms.
    pub counts: f32,
}

/// A taxel that always gives the same code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stuck {
    /// Number of the taxel.
    pub taxel: u16,
    /// The code, counts.
    pub code: u16,
}

/// What the wiring does to the signal; all zero is an ideal wiring.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct WiringEffects {
    /// Resistance that charges a converter input's line, kOhm.
    pub source_kohm: f64,
    /// Capacitance of that line, pF. The voltage settles with the product since the last change of a select
    /// line.
    pub line_pf: f64,
    /// Part of the signal of every taxel on the same wired row or column of the block that is added to a
    /// taxel's own: what their common lines couple.
    pub crosstalk: f64,
    /// The blocks are passive matrices: three pressed corners of a rectangle show at the fourth as well.
    pub passive: bool,
}

impl WiringEffects {
    /// Time constant of the line, ns.
    pub fn settling_ns(&self) -> f64 {
        self.source_kohm * self.line_pf
    }

    /// Whether the wiring changes nothing.
    pub fn is_ideal(&self) -> bool {
        self.settling_ns() == 0.0 && self.crosstalk == 0.0 && !self.passive
    }
}

/// How the taxels answer to force.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Sensor {
    /// Standard deviation of the gain from taxel to taxel, part of 1.
    pub gain_spread: f64,
    /// How much more a taxel signals of a force that goes than of the same while it comes, part of it; half
    /// of that more, half less than the truth far below the peak, and nothing at the peak.
    pub hysteresis: f64,
    /// Noise by the signal, part of it rms, beside that of the garment at rest: how the cloth lies changes
    /// all 20 ms.
    pub noise: f64,
    /// Force on a taxel at which it signals half of what it would if it were straight, N: a divider with a
    /// fixed resistor; 0: straight.
    pub half_n: f64,
}

/// What the converter does to the signal.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Converter {
    /// The RP2040's differential nonlinearity: codes 512, 1536, 2560 and 3584 are nine codes wide.
    pub dnl: bool,
    /// Noise of the converter itself, counts rms.
    pub noise_counts: f64,
}

/// A joint of the robot that bends and straightens with the profile of a touch.
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
    /// Begin of the motion, s.
    pub start_s: f64,
    /// Time to the angle reached, s.
    pub rise_s: f64,
    /// Time there, s.
    #[serde(default)]
    pub hold_s: f64,
    /// Time back, s; without it the joint stays.
    pub fall_s: Option<f64>,
}

impl Joint {
    /// Angle at a time (s), degrees.
    pub fn angle_deg(&self, t_s: f64) -> f64 {
        let bend = |part: f64| 0.5 - 0.5 * (std::f64::consts::PI * part.clamp(0.0, 1.0)).cos();
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
    /// The angles of the robot's joints at a time (s), degrees.
    pub fn posture(&self, t_s: f64) -> impl Iterator<Item = (&str, f64)> {
        self.joints.iter().map(move |j| (j.name.as_str(), j.angle_deg(t_s)))
    }
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
