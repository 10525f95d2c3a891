//! What the chain may cost on the emulated board, and the tables that were last written.

use serde_json::{Value, json};
use std::path::Path;
use taxel_bench::stages::case::Variant;
use taxel_bench::stages::format::INFERENCE;
use taxel_bench::stages::row::Row;
use taxel_bench::stages::table::Table;
use taxel_core::fold::FOLDED;
use taxel_core::pipeline::Stage;
use taxel_suite::chain::PERIOD_US;
use taxel_suite::pattern::TouchPattern;

/// What a scene or a kernel may cost, in cycles.
struct Bar {
    scene: &'static str,
    what: &'static str,
    most: u64,
    of: fn(&Table, &str) -> Option<u64>,
}

/// A figure of the chain in a scene, as it ships.
fn chain(table: &Table, scene: &str, of: fn(&Row) -> u64) -> Option<u64> {
    table.rows.iter().find(|row| row.name == scene && row.variant == Variant::Shipped).map(of)
}

/// The condition stage of an empty frame.
fn condition(table: &Table, variant: Variant) -> Option<u64> {
    let mut rows = table.rows.iter().filter(|row| row.name == TouchPattern::Empty.name());
    Some(rows.find(|row| row.variant == variant)?.stage(Stage::Condition))
}

/// The dearest of the kernels of a name.
fn kernel(table: &Table, what: &str) -> Option<u64> {
    table.forms.iter().filter(|row| row.form.what == what).map(|row| row.cost).max()
}

/// Of what ships.
const BARS: [Bar; 6] = [
    Bar { scene: "empty", what: "all", most: 60_000, of: |table, scene| chain(table, scene, Row::whole) },
    Bar {
        scene: "5 contacts",
        what: "all",
        most: 150_000,
        of: |table, scene| chain(table, scene, Row::whole),
    },
    Bar {
        scene: "saturated",
        what: "perceive",
        most: 400_000,
        of: |table, scene| chain(table, scene, Row::perceive),
    },
    Bar {
        scene: "saturated",
        what: "all",
        most: 480_000,
        of: |table, scene| chain(table, scene, Row::whole),
    },
    Bar { scene: INFERENCE, what: "ten concepts", most: 25_000, of: kernel },
    Bar {
        scene: "a bending arm",
        what: "condition",
        most: 70_000,
        of: |table, _| condition(table, Variant::Bending),
    },
];

/// How far a figure may be from the one that was written, in percent, and in cycles where it is small, if
/// both are of one compiler.
const TOLERANCE: u64 = 10;
const SMALL: u64 = 500;
/// By how much an image of another compiler may exceed a bar, in percent: rustup's library keeps frame
/// pointers, which cost 3 to 6 %.
const MARGIN: u64 = 6;

/// The bars and what is measured against them.
fn bars(table: &Table) -> impl Iterator<Item = (&'static Bar, u64)> {
    BARS.iter().filter_map(|bar| Some((bar, (bar.of)(table, bar.scene)?)))
}

/// Cycles that it takes to read each code once.
fn reading(table: &Table) -> u64 {
    table.forms.first().map_or(1, |row| row.cost.max(1))
}

/// What the garment's own folds cost, cycles for each taxel that folds and is renewed: all of them are in 20 ms.
struct Bending {
    /// All that an arm that turns between two knots adds to an empty frame.
    posture: u64,
    /// All that an arm adds that turns with 1 rad/s, from knot to knot, comparisons included.
    turning: u64,
    /// All that coming to another knot with each posture adds to the first.
    compared: u64,
    /// All that an arm adds that comes where it was not before, and is compared at every other posture.
    onward: u64,
    /// All that an arm adds that stands still.
    still: u64,
}

impl Bending {
    fn of(table: &Table) -> Option<Bending> {
        let condition = |variant| condition(table, variant);
        let (shipped, swaying) = (condition(Variant::Shipped)?, condition(Variant::Swaying)?);
        let by_taxel =
            |more: u64, than: u64| (more.saturating_sub(than) * 20_000).div_ceil(FOLDED as u64 * PERIOD_US);
        Some(Bending {
            posture: by_taxel(swaying, shipped),
            turning: by_taxel(condition(Variant::Turning)?, shipped),
            compared: by_taxel(condition(Variant::Comparing)?, swaying),
            onward: by_taxel(condition(Variant::Bending)?, shipped),
            still: by_taxel(condition(Variant::Folds)?, shipped),
        })
    }
}

/// The bars for people, each beside the cost of merely reading each taxel.
pub fn text(table: &Table) -> String {
    let line = |(bar, cost): (&Bar, u64)| {
        let (share, times) = (cost * 100 / bar.most, cost as f64 / reading(table) as f64);
        let Bar { scene, what, most, .. } = bar;
        let verdict = if cost > *most { "MISSED" } else { "met" };
        format!(
            "{scene}, {what}: {cost} of at most {most} cycles ({share} %, {verdict}), {times:.1} times reading each code once\n"
        )
    };
    let stack = table.rows.iter().filter_map(|row| row.stack).max().unwrap_or(0);
    let posture = Bending::of(table).map(|Bending { posture, turning, compared, onward, still }| {
        format!(
            "bending: {posture} cycles a change of posture and taxel, {compared} more where it is compared; with \
             comparisons, {turning} a change at 1 rad/s, {onward} on the way to new postures; {still} every 20 ms \
             while the arm stands still\n"
        )
    });
    bars(table).map(line).collect::<String>()
        + &posture.unwrap_or_default()
        + &format!("deepest stack of a frame: {stack} bytes\n")
}

/// For other programs.
pub fn json(table: &Table) -> String {
    let bars = bars(table)
        .map(|(bar, cost)| json!({ "scene": bar.scene, "what": bar.what, "cycles": cost, "most": bar.most }));
    let mut value = table.json();
    value["bars"] = bars.collect();
    serde_json::to_string_pretty(&value).unwrap_or_default()
}

/// Writes the tables and the chart.
pub fn write(table: &Table, folder: &Path) -> Result<(), String> {
    let fail = |error: std::io::Error| format!("{}: {error}", folder.display());
    let write = |name: &str, text: String| std::fs::write(folder.join(name), text).map_err(fail);
    std::fs::create_dir_all(folder).map_err(fail)?;
    write("cycles.txt", format!("{table}\n{}", text(table)))?;
    write("cycles.svg", table.chart().svg())?;
    write("cycles.json", format!("{}\n", json(table)))
}

const RENEW: &str = "`cargo xtask cycles --write` renews the table";

/// No bar is missed; and if the table that was written is of the same compiler, no figure is far from the one
/// in it. Else the figures are put beside each other, for people.
pub fn compare(table: &Table, folder: &Path) -> Result<(), String> {
    let text = std::fs::read_to_string(folder.join("cycles.json"))
        .map_err(|error| format!("{}: {error}; {RENEW}", folder.display()))?;
    let written: Value = serde_json::from_str(&text).map_err(|error| error.to_string())?;
    let now: Value = serde_json::from_str(&json(table)).map_err(|error| error.to_string())?;
    let is_same = written["place"] == now["place"];
    if !is_same {
        println!("beside the table of {}: now, then, ratio", written["place"].as_str().unwrap_or_default());
    }
    for (list, names, figures) in [
        ("rows", ["scene", "variant"], &["perceive", "encode", "all", "largest"][..]),
        ("forms", ["what", "form"], &["cost"][..]),
    ] {
        for row in now[list].as_array().into_iter().flatten() {
            let called = names.map(|name| row[name].as_str().unwrap_or_default());
            let mut old = written[list].as_array().into_iter().flatten();
            let old = old.find(|old| names.map(|name| old[name].as_str().unwrap_or_default()) == called);
            let called = called.join(", ");
            let old = old.ok_or(format!("{called} is not written yet; {RENEW}"))?;
            for figure in figures {
                let [cost, before] = [row, old].map(|row| row[figure].as_u64().unwrap_or(0));
                if !is_same {
                    let ratio = cost as f64 / before.max(1) as f64;
                    println!("{:<32}{cost:>10}{before:>10}{ratio:>8.3}", format!("{called}, {figure}"));
                } else if cost.abs_diff(before) > (before * TOLERANCE / 100).max(SMALL) {
                    return Err(format!("{called}, {figure}: {cost} cycles, {before} were written; {RENEW}"));
                }
            }
        }
    }
    let margin = if is_same { 0 } else { MARGIN };
    match bars(table).find(|(bar, cost)| *cost > bar.most + bar.most * margin / 100) {
        Some((bar, cost)) => {
            let Bar { scene, what, most, .. } = bar;
            Err(format!("{scene}, {what}: {cost} cycles, at most {most} and {margin} %"))
        }
        None => Ok(()),
    }
}
