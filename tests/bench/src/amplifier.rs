//! `cargo xtask bench amplifier`: required speed of the amplifier that holds the multiplexers' commons at one
//! voltage.
//!
//! A transimpedance amplifier holds the summing point of a panel's eight multiplexers at one voltage and
//! converts the taxel's current to the converter's voltage. Its feedback alone would settle with R C; the
//! amplifier has to charge the capacitance of the summing point through that feedback, and is the slower, the
//! less bandwidth it has. With one pole the whole is of second order:
//!
//! `V(s) / I(s) = -R / (1 + s (R C + (1 + R / Rs) / w) + s^2 R (Cs + C) / w)`
//!
//! for a gain-bandwidth product of `w` rad/s, a taxel of `Rs`, and `Cs` from the summing point to ground. Its
//! step response is exact here. Not modelled: the amplifier's slew rate, its second pole (with a noise gain
//! of 1 + Cs / C = 22 it lies far above the loop's crossover), and the on-resistance of a multiplexer, by
//! which ngspice differs by 2 % at most.

use super::Report;
use super::chart::{Axis, Better, Chart, Series};
use serde_json::json;
use std::f64::consts::TAU;
use std::fmt::Write;
use taxel::sim::FULL_SCALE;

/// Feedback: 10 kOhm and 22 pF, whose time constant is 0.22 us.
const FEEDBACK: (f64, f64) = (10e3, 22e-12);
/// Capacitance from the summing point to ground, farad: eight commons of 45 pF, 31 pF of cable and pin, and
/// the 80 pF of the fabric's column and its cable.
const INPUT_F: f64 = 471e-12;
/// Gain-bandwidth products of the table, MHz. 1 is an LM358's, 10 an MCP6022's, 50 an OPA365's.
const BANDWIDTHS: [f64; 10] = [1.0, 3.0, 10.0, 20.0, 30.0, 35.0, 40.0, 50.0, 70.0, 100.0];
/// Taxels: firmly pressed, and nearly isolating; ohm.
const TAXELS: [(&str, f64); 2] = [("pressed, 3 kOhm", 3e3), ("released, 1 MOhm", 1e6)];
/// Allowed share of a full-scale step: half a count of 12 bits, and of 8.
const PARTS: [f64; 2] = [0.5 / 4096.0, 0.5 / 256.0];
/// Settling slot of the shipped garment, s.
const SLOT: f64 = 2e-6;

/// An amplifier with one pole and its feedback, and a taxel.
#[derive(Debug, Clone, Copy)]
pub struct Amplifier {
    /// Half the coefficient of the decay, 1/s.
    decay: f64,
    /// Natural frequency, rad/s.
    natural: f64,
}

impl Amplifier {
    /// An amplifier with this gain-bandwidth product in Hz, for a taxel of this resistance in ohm.
    pub fn new(gain_bandwidth: f64, taxel: f64) -> Amplifier {
        let (ohm, farad) = FEEDBACK;
        let w = TAU * gain_bandwidth;
        let square = w / (ohm * (INPUT_F + farad));
        Amplifier { decay: (ohm * farad + (1.0 + ohm / taxel) / w) * square / 2.0, natural: square.sqrt() }
    }

    /// Damping ratio: below 1 the step overshoots.
    pub fn damping(&self) -> f64 {
        self.decay / self.natural
    }

    /// Residue of a step after a time (s), as a share of it.
    pub fn left(&self, time: f64) -> f64 {
        let Amplifier { decay, natural } = *self;
        let square = natural * natural - decay * decay;
        let root = square.abs().sqrt();
        if root * time < 1e-6 {
            return (-decay * time).exp() * (1.0 + decay * time);
        }
        if square > 0.0 {
            let (sin, cos) = (root * time).sin_cos();
            return (-decay * time).exp() * (cos + decay / root * sin);
        }
        let (slow, fast) = (decay - root, decay + root);
        (fast * (-slow * time).exp() - slow * (-fast * time).exp()) / (fast - slow)
    }

    /// Largest residue of a step at that time or later.
    pub fn most_left(&self, time: f64) -> f64 {
        let turn = self.turn().map_or(0.0, |turn| (time / turn).ceil() * turn);
        self.left(time).abs().max(self.left(turn.max(time)).abs())
    }

    /// Time between two extremes of an overshooting step, s.
    fn turn(&self) -> Option<f64> {
        let square = self.natural * self.natural - self.decay * self.decay;
        (square > 0.0).then(|| TAU / 2.0 / square.sqrt())
    }

    /// Time after which the residue stays below this share of a step, s.
    pub fn settling(&self, part: f64) -> f64 {
        // Between two extremes, and without any, the residue is monotonic.
        let (mut early, mut late) = match self.turn() {
            Some(turn) => {
                let last = (0..).find(|n| self.left(f64::from(n + 1) * turn).abs() <= part).unwrap_or(0);
                (f64::from(last) * turn, f64::from(last + 1) * turn)
            }
            None => {
                let long = (0..).map(|n| 1e-7 * 2f64.powi(n)).find(|time| self.left(*time) <= part);
                (0.0, long.unwrap_or(f64::INFINITY))
            }
        };
        for _ in 0..60 {
            let middle = (early + late) / 2.0;
            // After the last extreme that is too large: up to where it falls below the share, never again
            // above.
            if self.left(middle).abs() > part && self.left(middle).signum() == self.left(early).signum() {
                early = middle;
            } else {
                late = middle;
            }
        }
        late
    }
}

/// The whole table; deterministic.
pub fn report() -> Report {
    let mut text = String::from(
        "A transimpedance amplifier with 10 kOhm and 22 pF in its feedback and 471 pF at its summing point, one pole: the time after\n\
         which half a count of a full-scale step is left, and the most that is left after the 2 us of the shipped settling, in counts\n\
         of 12 bits\n\n",
    );
    // Writing to a string cannot fail.
    let _ = table(&mut text);
    let rows: Vec<_> = BANDWIDTHS
        .iter()
        .flat_map(|mhz| TAXELS.map(|(taxel, ohm)| (mhz, taxel, Amplifier::new(mhz * 1e6, ohm))))
        .map(|(mhz, taxel, amplifier)| {
            let [twelve, eight] = PARTS.map(|part| amplifier.settling(part) * 1e6);
            json!({
                "gain_bandwidth_mhz": mhz, "taxel": taxel, "damping": amplifier.damping(), "settled_12_bit_us": twelve,
                "settled_8_bit_us": eight, "left_after_2_us_counts": left(&amplifier),
            })
        })
        .collect();
    let json =
        json!({ "feedback_ohm": FEEDBACK.0, "feedback_f": FEEDBACK.1, "input_f": INPUT_F, "rows": rows });
    Report { text, json, chart: chart() }
}

/// Residue after the shipped settling time, counts.
fn left(amplifier: &Amplifier) -> f64 {
    f64::from(FULL_SCALE) * amplifier.most_left(SLOT)
}

fn table(text: &mut String) -> std::fmt::Result {
    write!(text, "{:>10}", "")?;
    TAXELS.iter().try_for_each(|(name, _)| write!(text, " | {name:>37}"))?;
    write!(text, "\n{:>10}", "bandwidth")?;
    let heads = ["damping", "12 bits", "8 bits", "left"];
    for _ in TAXELS {
        write!(text, " | {:>7} {:>9} {:>9} {:>9}", heads[0], heads[1], heads[2], heads[3])?;
    }
    writeln!(text)?;
    for mhz in BANDWIDTHS {
        write!(text, "{:>10}", format!("{mhz} MHz"))?;
        for (_, ohm) in TAXELS {
            let amplifier = Amplifier::new(mhz * 1e6, ohm);
            let [twelve, eight] = PARTS.map(|part| format!("{:.2} us", amplifier.settling(part) * 1e6));
            let (damping, left) = (amplifier.damping(), left(&amplifier));
            write!(text, " | {damping:>7.2} {twelve:>9} {eight:>9} {left:>9.2}")?;
        }
        writeln!(text)?;
    }
    Ok(())
}

fn chart() -> Chart {
    let series = TAXELS.map(|(taxel, ohm)| {
        let point = |mhz: f64| {
            let us = Amplifier::new(mhz * 1e6, ohm).settling(PARTS[0]) * 1e6;
            (mhz, us, format!("{mhz} MHz: {us:.2} us"))
        };
        Series { name: taxel.into(), points: BANDWIDTHS.map(point).into() }
    });
    Chart {
        title: "Settling of the amplifier to half a count of 12 bits, full-scale step".into(),
        x: Axis::new("gain-bandwidth product, MHz", Better::Less),
        y: Axis::new("settled after, us", Better::Less),
        named: false,
        series: series.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Results of ngspice 39 for the whole circuit (a step of 0.96 V by a taxel of 3 kOhm, a multiplexer of
    /// 120 ohm between 80 and 391 pF, an output of 50 ohm): MHz, us until half a count is left.
    const NGSPICE: [(f64, f64); 7] =
        [(1.0, 13.75), (3.0, 9.23), (10.0, 4.30), (20.0, 2.12), (30.0, 1.75), (50.0, 0.93), (100.0, 1.49)];

    #[test]
    fn the_closed_form_is_what_ngspice_finds() {
        for (mhz, us) in NGSPICE {
            let settled = Amplifier::new(mhz * 1e6, 3e3).settling(PARTS[0] * 3.3 / 0.96) * 1e6;
            assert!((settled / us - 1.0).abs() < 0.02, "{mhz} MHz: {settled} us, not {us}");
        }
    }

    /// The settling time is the last time at which a finely sampled response is outside.
    #[test]
    fn nothing_is_left_after_the_settling_time() {
        for mhz in BANDWIDTHS {
            for ((_, ohm), part) in TAXELS.into_iter().flat_map(|taxel| PARTS.map(|part| (taxel, part))) {
                let amplifier = Amplifier::new(mhz * 1e6, ohm);
                let settled = amplifier.settling(part);
                let step = settled / 5_000.0;
                let last = (0..20_000).rev().find(|n| amplifier.left(f64::from(*n) * step).abs() > part);
                assert!((4_998..=5_000).contains(&last.unwrap()), "{mhz} MHz, {ohm} ohm: {last:?}");
                let most =
                    (0..20_000).map(|n| amplifier.left(SLOT + f64::from(n) * step).abs()).fold(0.0, f64::max);
                assert!((amplifier.most_left(SLOT) / most - 1.0).abs() < 0.01, "{mhz} MHz: {most}");
            }
        }
    }

    /// 195 frames per second require 2 us: 35 MHz is sufficient, 20 is not, and 50 has a margin of 30 %.
    #[test]
    fn what_195_frames_a_second_need() {
        let worst = |mhz: f64| {
            TAXELS
                .map(|(_, ohm)| Amplifier::new(mhz * 1e6, ohm).settling(PARTS[0]))
                .into_iter()
                .fold(0.0, f64::max)
        };
        assert!(worst(35.0) < SLOT && worst(50.0) < 1.4e-6 && worst(100.0) < SLOT);
        assert!(worst(20.0) > 1.5 * SLOT);
        // However fast the amplifier, its feedback settles no sooner than this.
        assert!(worst(10_000.0) > 1.95e-6);
    }
}
