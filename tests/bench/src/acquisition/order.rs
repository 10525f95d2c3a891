//! Effect of the scan order on settling: one touch, scanned row by row and interlaced.
//!
//! Row by row, a line settles between neighbours, whose signals differ little under a broad touch;
//! interlaced, it settles from a distant taxel, so that the residue is a share of the whole signal. The
//! bound, for a step of full scale, is the same for both.

use super::{LINE_PF, texture};
use serde_json::{Value, json};
use std::fmt::Write;
use taxel::sim::{Chain, Converter, WiringEffects};
use taxel_core::acquire::{Depth, Fields, Plan, Rounds, SWEEP_ADDRESSES, SWEEP_STRETCHES, Sweep};
use taxel_core::garment::{Circuit, Garment, Layout, Pins};

/// Settling times of the garment, ns, and resistances that charge its lines, kOhm.
const SETTLING: [u32; 3] = [2_000, 4_000, 8_000];
const SOURCES: [f64; 3] = [3.0, 10.0, 30.0];
/// Signal at rest and at the peak of a touch, counts, and its extent, taxels.
const REST: f32 = 200.0;
const PEAK: f32 = 3_800.0;
const BREADTH: f32 = 4.0;

/// A scan order: the taxels read at each address, input by input.
type Order = Vec<usize>;

/// Errors of a scene by settling, counts: rms and largest.
pub struct OrderRow {
    settle_ns: u32,
    source_kohm: f64,
    scene: &'static str,
    progressive: [f64; 2],
    interlaced: [f64; 2],
}

/// Both orders, over settling times, sources, and two scenes.
pub fn rows() -> Vec<OrderRow> {
    let garment = Garment::reference();
    let Some((layout, circuit)) = built(&garment) else { return Vec::new() };
    let scenes = [("touch", touch(&layout)), ("texture", texture(layout.taxels()))];
    let (progressive, interlaced) = (progressive(&circuit), interlaced(&circuit));
    let settings = SETTLING.into_iter().flat_map(|settle| SOURCES.map(|source| (settle, source)));
    let row = |(settle_ns, source_kohm)| {
        let errors = |order: &Order, signals: &[f32]| errors(settle_ns, source_kohm, order, signals);
        scenes.each_ref().map(|(scene, signals)| OrderRow {
            settle_ns,
            source_kohm,
            scene,
            progressive: errors(&progressive, signals),
            interlaced: errors(&interlaced, signals),
        })
    };
    settings.flat_map(row).collect()
}

fn built(garment: &Garment) -> Option<(Layout, Circuit)> {
    let layout = Layout::build(garment, usize::from(u16::MAX), u16::MAX).ok()?;
    let circuit = Circuit::build(garment, &layout, Pins::ANY).ok()?;
    Some((layout, circuit))
}

fn progressive(circuit: &Circuit) -> Order {
    let mut sweep = Box::new(Sweep::<SWEEP_ADDRESSES, SWEEP_STRETCHES>::new());
    let (mut order, mut here) = (Order::new(), [None; 4]);
    if sweep.fill(circuit, &Plan::default()).is_ok() {
        for address in 0..sweep.levels().len() {
            match sweep.stretches().iter().find(|stretch| usize::from(stretch.first) == address) {
                Some(stretch) => here = stretch.taxels,
                None => here = here.map(|taxel| taxel.map(|taxel| taxel + 1)),
            }
            order.extend(here.into_iter().flatten().map(usize::from));
        }
    }
    order
}

fn interlaced(circuit: &Circuit) -> Order {
    let plan = Plan { depth: Depth::Interlaced, ..Plan::default() };
    let mut order = Order::new();
    if let Ok(fields) = Fields::of(circuit, &plan) {
        fields.each(circuit, &plan, |_, _, taxels| {
            order.extend(taxels.into_iter().flatten().map(usize::from));
        });
    }
    order
}

/// A broad touch in the middle of each panel.
fn touch(layout: &Layout) -> Vec<f32> {
    let places = (0..layout.taxels()).filter_map(|taxel| layout.place(taxel));
    let signal = |place: taxel_core::garment::Place| {
        let (y, x) = (f32::from(place.row) - 15.5, f32::from(place.column) - 7.5);
        REST + (PEAK - REST) * (-(x * x + y * y) / (2.0 * BREADTH * BREADTH)).exp()
    };
    places.map(signal).collect()
}

fn errors(settle_ns: u32, source_kohm: f64, order: &Order, signals: &[f32]) -> [f64; 2] {
    let inputs = 4;
    let chain = Chain {
        wiring: WiringEffects { source_kohm, line_pf: LINE_PF, ..WiringEffects::default() },
        converter: Converter { dnl: false, noise_counts: 0.0 },
        rounds: Rounds::of(inputs, settle_ns),
        inputs,
        depth: Depth::Twelve,
    };
    let scanned: Vec<f32> =
        order.iter().map(|taxel| signals.get(*taxel).copied().unwrap_or_default()).collect();
    // The first scan begins with empty lines; the second one is measured.
    let mut last = Vec::new();
    chain.scan(&scanned, 2, |codes| last = codes.to_vec());
    let errors =
        || last.iter().zip(&scanned).map(|(code, signal)| f64::from((f32::from(*code) - signal).abs()));
    let squares: f64 = errors().map(|error| error * error).sum();
    [(squares / scanned.len().max(1) as f64).sqrt(), errors().fold(0.0, f64::max)]
}

/// Readable form.
pub fn table(rows: &[OrderRow], text: &mut String) -> std::fmt::Result {
    writeln!(
        text,
        "\nThe order of the addresses, an ideal converter: rms error / largest error, row by row and interlaced"
    )?;
    writeln!(
        text,
        "{:>6} {:>8} {:<8} {:>16} {:>16}",
        "asked", "source", "scene", "row by row", "interlaced"
    )?;
    for OrderRow { settle_ns, source_kohm, scene, progressive, interlaced } in rows {
        let both = |[rms, largest]: &[f64; 2]| format!("{rms:.1} /{:>6.0}", largest.ceil());
        let source = format!("{source_kohm} kOhm");
        writeln!(
            text,
            "{:>3} us {source:>8} {scene:<8} {:>16} {:>16}",
            settle_ns / 1000,
            both(progressive),
            both(interlaced)
        )?;
    }
    Ok(())
}

/// JSON form.
pub fn json(rows: &[OrderRow]) -> Value {
    let both = |[rms, largest]: &[f64; 2]| json!({ "rms": rms, "largest": largest });
    let row = |row: &OrderRow| {
        json!({
            "settle_us": f64::from(row.settle_ns) / 1000.0, "source_kohm": row.source_kohm, "scene": row.scene,
            "progressive": both(&row.progressive), "interlaced": both(&row.interlaced),
        })
    };
    rows.iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::super::residue;
    use super::*;

    #[test]
    fn settling_from_afar_is_within_the_same_bound() {
        for row in rows() {
            let bound = residue(Rounds::of(4, row.settle_ns).settling_ns(), row.source_kohm * LINE_PF);
            for [rms, largest] in [row.progressive, row.interlaced] {
                assert!(largest <= bound + 0.51 && rms <= largest, "{} {largest} {bound}", row.scene);
            }
            // On a settled line, the order does not matter.
            if bound < 1.0 {
                assert!((row.progressive[1] - row.interlaced[1]).abs() <= 1.0);
            }
        }
    }

    #[test]
    fn a_slow_line_smears_a_broad_touch_more_when_interlaced() {
        let rows = rows();
        let slow =
            rows.iter().find(|row| row.settle_ns == 2_000 && row.source_kohm == 10.0 && row.scene == "touch");
        let OrderRow { progressive, interlaced, .. } = slow.unwrap();
        assert!(interlaced[0] > 2.0 * progressive[0], "{progressive:?} {interlaced:?}");
    }
}
