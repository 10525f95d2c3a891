//! `cargo xtask bench acquisition`: frame rate against the error of a taxel.
//!
//! A simulated scan of the reference garment (512 addresses, four converter inputs) with a texture of signals
//! between 200 and 3,800 counts, so that neighbours in time differ by up to 3,600 and no noise is clipped at
//! the ends of the scale. Modelled: the chain that reads the garment ([`Rounds`]); the line of each input, a
//! capacitance that the source charges from the level left by the previous taxel; the converter's four wide
//! codes, its noise and its rounding; the depth of the scene. Not modelled: the processor, so that the rates
//! are those of wiring and converter alone; and the charge that the converter's 1 pF takes from a line when
//! the inputs change, whose sampling window no data sheet gives.

mod order;

use super::Report;
use super::chart::{Axis, Better, Chart, Series};
use fastrand::Rng;
use serde_json::{Value, json};
use std::fmt::Write;
use taxel::sim::{Chain, Converter, FULL_SCALE, Idle, WiringEffects};
use taxel_core::acquire::{CONVERSION_NS, Depth, Rounds};
use taxel_core::garment::Garment;

/// Capacitance of a line between multiplexer and converter, pF: the common pin of one 74HC4067 (45 by its
/// data sheet), 25 cm of cable at 100 pF/m, a pin of the RP2040 (5) and its sampling capacitor (1), rounded
/// up. Every further multiplexer on the same line adds its own 45 pF, whether enabled or not.
pub const LINE_PF: f64 = 80.0;
/// Settling times of a garment, ns.
const SETTLING: [u32; 7] = [2_000, 4_000, 8_000, 14_000, 20_000, 34_000, 64_000];
/// Resistances that charge the line, kOhm.
const SOURCES: [f64; 5] = [1.0, 3.0, 10.0, 30.0, 100.0];
const DEPTHS: [Depth; 5] = [Depth::Eight, Depth::Twelve, Depth::MeanOf2, Depth::MeanOf4, Depth::MeanOf8];
/// Signals of the texture, counts.
const SIGNALS: std::ops::RangeInclusive<u16> = 200..=3_800;
/// Addresses of the reference garment.
const ADDRESSES: usize = 512;
const INPUTS: usize = 4;
/// Most that a delay in whole microseconds may end early, ns.
const EARLY_NS: u32 = 1_000;

/// Presets, with the largest source resistance (kOhm, with [`LINE_PF`]) that their settling time allows.
pub const SHIPPED: [(&str, f64); 3] = [("reference", 3.0), ("mat-64x32", 3.0), ("block-4x16", 10.0)];

/// Setting of one row.
#[derive(Debug, Clone, Copy)]
struct Setting {
    /// Settling time of the garment.
    settle_ns: u32,
    source_kohm: f64,
    depth: Depth,
    addresses: usize,
    inputs: usize,
}

impl Setting {
    fn rounds(&self) -> Rounds {
        Rounds::of(self.inputs, self.settle_ns)
    }

    /// Settling time given by the chain, us.
    fn settled_us(&self) -> f64 {
        self.rounds().settling_ns() as f64 / 1000.0
    }

    fn bits(&self) -> u32 {
        if self.depth == Depth::Eight { 8 } else { 12 }
    }
}

/// Result of a setting; errors in counts of 12 bits.
#[derive(Debug, Clone, Copy)]
struct Outcome {
    rate: f64,
    residue: f64,
    rms: f64,
    largest: f64,
}

/// Residue of a full-scale step after this time on a line with this time constant (kOhm times pF), counts:
/// the largest error by settling alone.
pub fn residue(settle_ns: u64, tau_ns: f64) -> f64 {
    f64::from(FULL_SCALE) * (-(settle_ns as f64) / tau_ns).exp()
}

/// Settling time that every board guarantees to a garment that asks for this one: the reference board's chain
/// counts whole conversions, a loop's delay may end early; the smaller of the two.
pub fn sure_ns(asked_ns: u32) -> u64 {
    let counted = (asked_ns / CONVERSION_NS).max(1) * CONVERSION_NS;
    counted.min(asked_ns.saturating_sub(EARLY_NS)).into()
}

/// The whole table; deterministic.
pub fn report() -> Report {
    let rows: Vec<(Setting, Outcome)> =
        settings().map(|setting| (setting, acquire(&setting, true))).collect();
    let shipped: Vec<_> = SHIPPED.iter().filter_map(|(name, source)| shipped(name, *source)).collect();
    let orders = order::rows();
    let json = json!({
        "order": order::json(&orders), "garment": "reference", "line_pf": LINE_PF, "noise_counts": noise(), "unit": "counts of 12 bits; frames/s simulated",
        "rows": rows.iter().map(|(setting, outcome)| object(setting, outcome)).collect::<Vec<_>>(),
        "shipped": shipped.iter().map(|(name, setting, outcome)| {
            let mut row = object(setting, outcome);
            row["garment"] = json!(name);
            row["asked_ns"] = json!(setting.settle_ns);
            row
        }).collect::<Vec<_>>(),
    });
    let mut text = format!(
        "Frames a second against the error of a taxel, simulated: reference garment, {LINE_PF} pF a line, noise {} counts rms,\n\
         the RP2040's wide codes; a texture of signals between {} and {} counts. Errors in counts of 12 bits.\n\n",
        noise(),
        SIGNALS.start(),
        SIGNALS.end()
    );
    // Writing to a string cannot fail.
    let _ = by_source(&rows, &mut text);
    let _ = by_depth(&rows, &mut text);
    let _ = by_garment(&shipped, &mut text);
    let _ = order::table(&orders, &mut text);
    Report { text, json, chart: chart(&rows) }
}

fn settings() -> impl Iterator<Item = Setting> {
    let sources = SOURCES.into_iter().flat_map(|source| SETTLING.map(|settle| (source, settle)));
    sources.flat_map(|(source_kohm, settle_ns)| {
        DEPTHS.map(|depth| Setting { settle_ns, source_kohm, depth, addresses: ADDRESSES, inputs: INPUTS })
    })
}

/// Noise of a sample, as in every simulated scene.
fn noise() -> f64 {
    Idle::default().noise_counts
}

/// Scans the texture; without `real`, only the lines and the rounding have errors.
fn acquire(setting: &Setting, real: bool) -> Outcome {
    let signals = texture(setting.addresses * setting.inputs);
    let chain = Chain {
        wiring: WiringEffects {
            source_kohm: setting.source_kohm,
            line_pf: LINE_PF,
            ..WiringEffects::default()
        },
        converter: Converter { dnl: real, noise_counts: if real { noise() } else { 0.0 } },
        rounds: setting.rounds(),
        inputs: setting.inputs,
        depth: setting.depth,
    };
    let mut sums = vec![0u16; signals.len()];
    let averaged = usize::from(setting.depth.scans());
    let mut scans = 0;
    chain.scan(&signals, 1 + averaged, |codes| {
        // The first scan begins with empty lines; the measured ones follow another.
        if scans > 0 {
            sums.iter_mut().zip(codes).for_each(|(sum, code)| *sum += code);
        }
        scans += 1;
    });
    let errors = || {
        let kept = |sum: &u16| f64::from(setting.depth.mean(*sum));
        sums.iter().zip(&signals).map(move |(sum, signal)| (kept(sum) - f64::from(*signal)).abs())
    };
    let squares: f64 = errors().map(|error| error * error).sum();
    Outcome {
        rate: 1e9 / (chain.scan_ns(setting.addresses) * averaged as u64) as f64,
        residue: residue(setting.rounds().settling_ns(), setting.source_kohm * LINE_PF),
        rms: (squares / signals.len() as f64).sqrt(),
        largest: errors().fold(0.0, f64::max),
    }
}

/// Random signals with a uniform distribution.
fn texture(taxels: usize) -> Vec<f32> {
    let mut rng = Rng::with_seed(3);
    let [least, most] = [SIGNALS.start(), SIGNALS.end()].map(|signal| f32::from(*signal));
    (0..taxels).map(|_| least + rng.f32() * (most - least)).collect()
}

/// A preset at its largest source resistance: name, setting, result.
fn shipped(name: &'static str, source_kohm: f64) -> Option<(&'static str, Setting, Outcome)> {
    let garment = Garment::preset(name)?;
    let mut inputs: Vec<u8> = garment.blocks.iter().map(|block| block.input).collect();
    inputs.sort_unstable();
    inputs.dedup();
    let taxels: usize = garment.panels.iter().map(|p| usize::from(p.rows) * usize::from(p.columns)).sum();
    let setting = Setting {
        settle_ns: garment.wiring.settle_ns,
        source_kohm,
        depth: Depth::Twelve,
        addresses: taxels / inputs.len().max(1),
        inputs: inputs.len(),
    };
    Some((name, setting, acquire(&setting, true)))
}

fn object(setting: &Setting, outcome: &Outcome) -> Value {
    json!({
        "source_kohm": setting.source_kohm, "settle_us": f64::from(setting.settle_ns) / 1000.0,
        "settled_us": setting.settled_us(), "bits": setting.bits(), "averaged": setting.depth.scans(), "frames_per_s": outcome.rate, "residue": outcome.residue, "rms": outcome.rms,
        "largest": outcome.largest,
    })
}

/// Settling by source resistance, at full depth.
fn by_source(rows: &[(Setting, Outcome)], text: &mut String) -> std::fmt::Result {
    writeln!(
        text,
        "12 bits, one scan: rms error / largest error, by the settling that a garment asks for and the chain gives"
    )?;
    write!(text, "{:>6} {:>9} {:>9}", "asked", "given", "frames/s")?;
    SOURCES.iter().try_for_each(|source| write!(text, " {:>16}", format!("{source} kOhm")))?;
    writeln!(text)?;
    for settle in SETTLING {
        let of = || rows.iter().filter(|(s, _)| s.settle_ns == settle && s.depth == Depth::Twelve);
        let (given, rate) =
            of().next().map_or((0.0, 0.0), |(setting, outcome)| (setting.settled_us(), outcome.rate));
        write!(text, "{:>3} us {given:>6.1} us {rate:>9.1}", settle / 1000)?;
        for (_, outcome) in of() {
            write!(text, " {:>8.1} /{:>6.0}", outcome.rms, outcome.largest.ceil())?;
        }
        writeln!(text)?;
    }
    Ok(())
}

/// Effect of the depth on settled lines.
fn by_depth(rows: &[(Setting, Outcome)], text: &mut String) -> std::fmt::Result {
    let (settle, source) = (2_000, 3.0);
    writeln!(text, "\n{} us, {source} kOhm: bits kept, and the mean of several scans", settle / 1000)?;
    writeln!(text, "{:>5} {:>6} {:>9} {:>8} {:>8}", "bits", "scans", "frames/s", "rms", "largest")?;
    for (setting, outcome) in rows.iter().filter(|(s, _)| s.settle_ns == settle && s.source_kohm == source) {
        let Outcome { rate, rms, largest, .. } = outcome;
        let (bits, scans) = (setting.bits(), setting.depth.scans());
        writeln!(text, "{bits:>5} {scans:>6} {rate:>9.1} {rms:>8.2} {largest:>8.2}")?;
    }
    Ok(())
}

fn by_garment(shipped: &[(&'static str, Setting, Outcome)], text: &mut String) -> std::fmt::Result {
    writeln!(text, "\nThe garments that come with the program, at the largest source resistance they allow")?;
    writeln!(
        text,
        "{:<12} {:>8} {:>8} {:>8} {:>9} {:>8} {:>8} {:>8}",
        "garment", "asked", "given", "source", "frames/s", "residue", "rms", "largest"
    )?;
    for (name, setting, outcome) in shipped {
        let Outcome { rate, residue, rms, largest } = outcome;
        let asked = format!("{} us", f64::from(setting.settle_ns) / 1000.0);
        let given = format!("{} us", setting.settled_us());
        let source = format!("{} kOhm", setting.source_kohm);
        writeln!(
            text,
            "{name:<12} {asked:>8} {given:>8} {source:>8} {rate:>9.1} {residue:>8.2} {rms:>8.2} {largest:>8.2}"
        )?;
    }
    writeln!(text, "(residue: what settling alone leaves of a full-scale step)")
}

fn chart(rows: &[(Setting, Outcome)]) -> Chart {
    let series = SOURCES.map(|source| {
        let points = rows.iter().filter(|(setting, _)| setting.source_kohm == source).map(|(s, o)| {
            let name = format!(
                "{} us, {} bits, {} scans: {:.1} frames/s, {:.1} counts rms, {:.0} at most",
                s.settle_ns / 1000,
                s.bits(),
                s.depth.scans(),
                o.rate,
                o.rms,
                o.largest.ceil()
            );
            (o.rate, o.rms, name)
        });
        Series { name: format!("{source} kOhm, {LINE_PF} pF"), points: points.collect() }
    });
    Chart {
        title: "Acquisition: 2,048 taxels, simulated wiring and converter".into(),
        x: Axis::new("frames a second", Better::More),
        y: Axis::new("error of a taxel, counts of 12 bits, rms", Better::Less),
        named: false,
        series: series.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shipped_settling_leaves_less_than_a_count() {
        for (name, source_kohm) in SHIPPED {
            let (_, setting, _) = shipped(name, source_kohm).unwrap();
            let tau_ns = source_kohm * LINE_PF;
            let left = residue(sure_ns(setting.settle_ns), tau_ns);
            assert!(left < 1.0, "{name}: {left} counts left of {} ns", setting.settle_ns);
            // As simulated, with an ideal converter: the residue, and half a count of rounding.
            let simulated = acquire(&setting, false).largest;
            assert!(simulated < 1.5, "{name}: {simulated}");
            // A microsecond less would not do: the setting is minimal.
            assert!(residue(sure_ns(setting.settle_ns - 1_000), tau_ns) > 1.0, "{name}");
        }
    }

    #[test]
    fn lines_that_the_documents_name() {
        // Eight multiplexers at a divider.
        let divider = 10.0 * (8.0 * 45.0 + 31.0);
        assert_eq!((residue(2_000, divider) / 40.95).round(), 60.0);
        assert!(residue(Rounds::of(4, 34_000).settling_ns(), divider) < 1.0);
        assert!(residue(Rounds::of(4, 32_000).settling_ns(), divider) > 1.0);
        assert_eq!((residue(2_000, 240.0) * 100.0).round(), 98.0);
        assert_eq!((residue(7_000, 800.0) * 100.0).round(), 65.0);
    }

    #[test]
    fn no_error_is_above_residue_and_rounding() {
        for setting in settings().filter(|s| s.bits() == 12 && s.depth.scans() < 4) {
            let Outcome { residue, largest, .. } = acquire(&setting, false);
            // Half a count of rounding, twice for a rounded mean, and what f32 loses of 4095.
            assert!(largest <= residue + 1.01, "{setting:?}: {largest} > {residue}");
            // Its largest step is nine tenths of full scale, from a line that has hardly settled before.
            assert!(largest >= 0.7 * residue, "a hard texture: {setting:?} {largest} {residue}");
        }
    }

    #[test]
    fn averaging_takes_noise_away_and_nothing_else() {
        let at = |depth, real| {
            let setting = Setting { settle_ns: 8_000, source_kohm: 1.0, depth, addresses: 512, inputs: 4 };
            acquire(&setting, real)
        };
        let (one, eight) = (at(Depth::Twelve, true), at(Depth::MeanOf8, true));
        assert!((one.rate / eight.rate - 8.0).abs() < 1e-9);
        assert!(eight.rms < 0.75 * one.rms, "{} {}", eight.rms, one.rms);
        // The wide codes stay, because they are not noise.
        assert!(eight.largest > 3.0, "{}", eight.largest);
        assert!(at(Depth::Twelve, false).largest <= 0.501);
    }
}
