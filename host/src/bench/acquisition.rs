//! `taxel bench acquisition`: frames a second against the error of a taxel.
//!
//! A simulated scan of the reference garment (512 addresses, four converter inputs) of a hard texture: a third of the taxels
//! at rest, a third at full scale, the others anywhere between, so that neighbours in time differ by the full scale. What is
//! modelled: the line of each input, a capacitance that the source charges from what the taxel before left on it; the
//! converter's four wide codes, its noise and its rounding; bits kept; the mean of several scans. Not modelled: the
//! processor, so that the rates are those of wiring and converter alone, and the charge that the converter's 1 pF takes from
//! a line when the inputs change, whose sampling window no data sheet gives.

use super::Report;
use super::chart::{Axis, Better, Chart, Series};
use crate::sim::{Chain, Converter, FULL_SCALE, Idle, Timing, WiringEffects};
use fastrand::Rng;
use serde_json::{Value, json};
use std::fmt::Write;
use taxel_core::acquire::Depth;
use taxel_core::garment::Garment;

/// Capacitance of a line between multiplexer and converter, pF: the common pin of one 74HC4067 (45 by its data sheet), 25 cm
/// of cable at 100 pF/m, a pin of the RP2040 (5) and its sampling capacitor (1), rounded up. Every further multiplexer on
/// the same line adds its own 45 pF, whether enabled or not.
pub const LINE_PF: f64 = 80.0;
/// Settling times of the table, ns.
const SETTLING: [u32; 9] = [0, 1_000, 2_000, 3_000, 5_000, 8_000, 12_000, 16_000, 20_000];
/// Resistances that charge the line, kOhm.
const SOURCES: [f64; 5] = [1.0, 3.0, 10.0, 30.0, 100.0];
const DEPTHS: [(Depth, u32); 2] = [(Depth::Eight, 8), (Depth::Twelve, 12)];
const AVERAGED: [usize; 4] = [1, 2, 4, 8];
/// Of the reference garment.
const ADDRESSES: usize = 512;
const INPUTS: usize = 4;
/// A delay in whole microseconds may end this much early.
const EARLY_NS: u32 = 1_000;

/// The garments that come with the program: the largest source resistance (kOhm, with [`LINE_PF`]) that their shipped settling
/// allows.
pub const SHIPPED: [(&str, f64); 3] = [("reference", 3.0), ("mat-64x32", 3.0), ("block-4x16", 10.0)];

/// How one row is acquired.
#[derive(Debug, Clone, Copy)]
struct Setting {
    settle_ns: u32,
    source_kohm: f64,
    depth: (Depth, u32),
    averaged: usize,
    addresses: usize,
    inputs: usize,
}

/// What comes of it; errors in counts of 12 bits.
#[derive(Debug, Clone, Copy)]
struct Outcome {
    rate: f64,
    residue: f64,
    rms: f64,
    largest: f64,
}

/// What a full-scale step leaves of itself after that time on a line of that time constant (kOhm times pF), counts: the
/// largest error that settling alone can make.
pub fn residue(settle_ns: u32, tau_ns: f64) -> f64 {
    f64::from(FULL_SCALE) * (-f64::from(settle_ns) / tau_ns).exp()
}

/// The settling that a board really gives a garment that asks for so much: the reference board's chain spends it in
/// conversions, a loop's delay may end early; the lesser of the two.
pub fn taken_ns(asked_ns: u32) -> u32 {
    Timing::REFERENCE.settling_ns(asked_ns).min(asked_ns.saturating_sub(EARLY_NS))
}

/// The whole table; the same whenever it is made.
pub fn report() -> Report {
    let rows: Vec<(Setting, Outcome)> =
        settings().map(|setting| (setting, acquire(&setting, true))).collect();
    let shipped: Vec<_> = SHIPPED.iter().filter_map(|(name, source)| shipped(name, *source)).collect();
    let json = json!({
        "garment": "reference", "line_pf": LINE_PF, "noise_counts": noise(), "unit": "counts of 12 bits; frames/s simulated",
        "rows": rows.iter().map(|(setting, outcome)| object(setting, outcome)).collect::<Vec<_>>(),
        "shipped": shipped.iter().map(|(name, asked, setting, outcome)| {
            let mut row = object(setting, outcome);
            row["garment"] = json!(name);
            row["asked_ns"] = json!(asked);
            row
        }).collect::<Vec<_>>(),
    });
    let mut text = format!(
        "Frames a second against the error of a taxel, simulated: reference garment, {LINE_PF} pF a line, noise {} counts rms,\n\
         the RP2040's wide codes; texture with full-scale steps from taxel to taxel. Errors in counts of 12 bits.\n\n",
        noise()
    );
    // Writing to a string cannot fail.
    let _ = by_source(&rows, &mut text);
    let _ = by_depth(&rows, &mut text);
    let _ = by_garment(&shipped, &mut text);
    Report { text, json, chart: chart(&rows) }
}

fn settings() -> impl Iterator<Item = Setting> {
    let sources = SOURCES.into_iter().flat_map(|source| SETTLING.map(|settle| (source, settle)));
    let kept = || DEPTHS.into_iter().flat_map(|depth| AVERAGED.map(|averaged| (depth, averaged)));
    sources.flat_map(move |(source_kohm, settle_ns)| {
        kept().map(move |(depth, averaged)| Setting {
            settle_ns,
            source_kohm,
            depth,
            averaged,
            addresses: ADDRESSES,
            inputs: INPUTS,
        })
    })
}

/// Noise of a sample, as in every simulated scene.
fn noise() -> f64 {
    Idle::default().noise_counts
}

/// Scans the texture; without a real converter's faults only the lines and the rounding are left.
fn acquire(setting: &Setting, real: bool) -> Outcome {
    let signals = texture(setting.addresses * setting.inputs);
    let chain = Chain {
        wiring: WiringEffects {
            source_kohm: setting.source_kohm,
            line_pf: LINE_PF,
            ..WiringEffects::default()
        },
        converter: Converter { dnl: real, noise_counts: if real { noise() } else { 0.0 } },
        settle_ns: setting.settle_ns,
        conversion_ns: Timing::REFERENCE.conversion_ns,
        inputs: setting.inputs,
        depth: setting.depth.0,
    };
    let mut sums = vec![0u32; signals.len()];
    let mut scans = 0;
    chain.scan(&signals, 1 + setting.averaged, |codes| {
        // The first scan begins with empty lines; those that count come after another one.
        if scans > 0 {
            sums.iter_mut().zip(codes).for_each(|(sum, code)| *sum += u32::from(*code));
        }
        scans += 1;
    });
    let errors = || {
        let mean = |sum: &u32| f64::from(*sum) / setting.averaged as f64;
        sums.iter().zip(&signals).map(move |(sum, signal)| (mean(sum) - f64::from(*signal)).abs())
    };
    let squares: f64 = errors().map(|error| error * error).sum();
    Outcome {
        rate: 1e9 / (chain.scan_ns(setting.addresses) * setting.averaged as u64) as f64,
        residue: residue(setting.settle_ns, setting.source_kohm * LINE_PF),
        rms: (squares / signals.len() as f64).sqrt(),
        largest: errors().fold(0.0, f64::max),
    }
}

/// At rest, at full scale, anywhere between: a third each.
fn texture(taxels: usize) -> Vec<f32> {
    let mut rng = Rng::with_seed(3);
    let full = f32::from(FULL_SCALE);
    let mut taxel = || match rng.u8(..3) {
        0 => 0.0,
        1 => full,
        _ => rng.f32() * full,
    };
    (0..taxels).map(|_| taxel()).collect()
}

/// A garment that comes with the program at its largest source resistance: name, settling asked for, setting, outcome.
fn shipped(name: &'static str, source_kohm: f64) -> Option<(&'static str, u32, Setting, Outcome)> {
    let garment = Garment::preset(name)?;
    let asked = garment.wiring.settle_ns;
    let mut inputs: Vec<u8> = garment.blocks.iter().map(|block| block.input).collect();
    inputs.sort_unstable();
    inputs.dedup();
    let taxels: usize = garment.panels.iter().map(|p| usize::from(p.rows) * usize::from(p.columns)).sum();
    let setting = Setting {
        settle_ns: taken_ns(asked),
        source_kohm,
        depth: (Depth::Twelve, 12),
        averaged: 1,
        addresses: taxels / inputs.len().max(1),
        inputs: inputs.len(),
    };
    Some((name, asked, setting, acquire(&setting, true)))
}

fn object(setting: &Setting, outcome: &Outcome) -> Value {
    json!({
        "source_kohm": setting.source_kohm, "settle_us": f64::from(setting.settle_ns) / 1000.0, "bits": setting.depth.1,
        "averaged": setting.averaged, "frames_per_s": outcome.rate, "residue": outcome.residue, "rms": outcome.rms,
        "largest": outcome.largest,
    })
}

/// Settling by source resistance, everything kept.
fn by_source(rows: &[(Setting, Outcome)], text: &mut String) -> std::fmt::Result {
    writeln!(text, "12 bits, one scan: rms error / largest error")?;
    write!(text, "{:>9} {:>9}", "settling", "frames/s")?;
    SOURCES.iter().try_for_each(|source| write!(text, " {:>16}", format!("{source} kOhm")))?;
    writeln!(text)?;
    for settle in SETTLING {
        let plain = |s: &Setting| s.settle_ns == settle && s.depth.1 == 12 && s.averaged == 1;
        let of = rows.iter().filter(|(setting, _)| plain(setting)).map(|(_, outcome)| outcome);
        let rate = of.clone().next().map_or(0.0, |outcome| outcome.rate);
        write!(text, "{:>6} us {rate:>9.1}", settle / 1000)?;
        for outcome in of {
            write!(text, " {:>8.1} /{:>6.0}", outcome.rms, outcome.largest.ceil())?;
        }
        writeln!(text)?;
    }
    Ok(())
}

/// Bits and averaging, where the lines have settled.
fn by_depth(rows: &[(Setting, Outcome)], text: &mut String) -> std::fmt::Result {
    let (settle, source) = (2_000, 3.0);
    writeln!(text, "\n{} us, {source} kOhm: bits kept, and the mean of several scans", settle / 1000)?;
    writeln!(text, "{:>5} {:>6} {:>9} {:>8} {:>8}", "bits", "scans", "frames/s", "rms", "largest")?;
    for (setting, outcome) in rows.iter().filter(|(s, _)| s.settle_ns == settle && s.source_kohm == source) {
        let Outcome { rate, rms, largest, .. } = outcome;
        let (bits, scans) = (setting.depth.1, setting.averaged);
        writeln!(text, "{bits:>5} {scans:>6} {rate:>9.1} {rms:>8.2} {largest:>8.2}")?;
    }
    Ok(())
}

fn by_garment(shipped: &[(&'static str, u32, Setting, Outcome)], text: &mut String) -> std::fmt::Result {
    writeln!(text, "\nThe garments that come with the program, at the largest source resistance they allow")?;
    writeln!(
        text,
        "{:<12} {:>8} {:>8} {:>8} {:>9} {:>8} {:>8} {:>8}",
        "garment", "asked", "taken", "source", "frames/s", "residue", "rms", "largest"
    )?;
    for (name, asked, setting, outcome) in shipped {
        let Outcome { rate, residue, rms, largest } = outcome;
        let [asked, taken] = [*asked, setting.settle_ns].map(|ns| format!("{} us", f64::from(ns) / 1000.0));
        let source = format!("{} kOhm", setting.source_kohm);
        writeln!(
            text,
            "{name:<12} {asked:>8} {taken:>8} {source:>8} {rate:>9.1} {residue:>8.2} {rms:>8.2} {largest:>8.2}"
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
                s.depth.1,
                s.averaged,
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
            let (_, asked, setting, _) = shipped(name, source_kohm).unwrap();
            let tau_ns = source_kohm * LINE_PF;
            let left = residue(setting.settle_ns, tau_ns);
            assert!(left < 1.0, "{name}: {left} counts left after {} of {asked} ns", setting.settle_ns);
            // As simulated, with an ideal converter: the residue, and half a count of rounding.
            let simulated = acquire(&setting, false).largest;
            assert!(simulated < 1.5, "{name}: {simulated}");
            // A microsecond less would not do: the figure is as small as it can be.
            assert!(residue(taken_ns(asked - 1_000).min(setting.settle_ns - 1_000), tau_ns) > 1.0, "{name}");
        }
    }

    #[test]
    fn lines_that_the_documents_name() {
        // 10 kOhm and 22 pF in an amplifier's feedback; eight multiplexers at a divider.
        assert!(residue(2_000, 220.0) < 0.5);
        let divider = 10.0 * (8.0 * 45.0 + 31.0);
        assert_eq!((residue(2_000, divider) / 40.95).round(), 60.0);
        assert!(residue(taken_ns(34_000), divider) < 1.0 && residue(taken_ns(33_000), divider) > 1.0);
        assert_eq!((residue(2_000, 240.0) * 100.0).round(), 98.0);
        assert_eq!((residue(7_000, 800.0) * 100.0).round(), 65.0);
    }

    #[test]
    fn no_error_is_above_residue_and_rounding() {
        for setting in settings().filter(|s| s.depth.1 == 12 && s.averaged < 4) {
            let Outcome { residue, largest, .. } = acquire(&setting, false);
            // Half a count of rounding, and what f32 loses of 4095.
            assert!(largest <= residue + 0.501, "{setting:?}: {largest} > {residue}");
            assert!(
                largest >= 0.9 * residue,
                "the texture has the worst step: {setting:?} {largest} {residue}"
            );
        }
    }

    #[test]
    fn averaging_takes_noise_away_and_nothing_else() {
        let at = |averaged, real| {
            let depth = (Depth::Twelve, 12);
            let setting =
                Setting { settle_ns: 8_000, source_kohm: 1.0, depth, averaged, addresses: 512, inputs: 4 };
            acquire(&setting, real)
        };
        let (one, eight) = (at(1, true), at(8, true));
        assert!((one.rate / eight.rate - 8.0).abs() < 1e-9);
        assert!(eight.rms < 0.75 * one.rms, "{} {}", eight.rms, one.rms);
        // The wide codes stay: they are no noise.
        assert!(eight.largest > 3.0, "{}", eight.largest);
        assert!(at(1, false).largest <= 0.501);
    }
}
