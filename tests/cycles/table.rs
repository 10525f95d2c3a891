//! The table as text and as JSON, its bars, and the one that was last written.

use crate::row::Row;
use serde_json::{Value, json};
use std::fmt;
use std::path::Path;
use taxel::bench::case::Variant;
use taxel_core::pipeline::Stage;

/// All rows.
pub struct Table {
    /// In the order of the cases.
    pub rows: Vec<Row>,
}

/// What a scene may cost on the emulated board, in cycles.
struct Bar {
    scene: &'static str,
    what: &'static str,
    most: u64,
    of: fn(&Row) -> u64,
}

/// Of what ships.
const BARS: [Bar; 4] = [
    Bar { scene: "empty", what: "all", most: 60_000, of: Row::whole },
    Bar { scene: "5 contacts", what: "all", most: 150_000, of: Row::whole },
    Bar { scene: "saturated", what: "perceive", most: 400_000, of: Row::perceive },
    Bar { scene: "saturated", what: "all", most: 480_000, of: Row::whole },
];

/// How far a figure may be from the one that was written, in percent.
const TOLERANCE: u64 = 10;
/// Fewer cycles than this may differ by this much.
const SMALL: u64 = 500;

impl Table {
    fn bars(&self) -> impl Iterator<Item = (&'static Bar, u64)> {
        BARS.iter().filter_map(|bar| {
            let row = self.rows.iter().find(|r| r.name == bar.scene && r.variant == Variant::Shipped);
            row.map(|row| (bar, (bar.of)(row)))
        })
    }

    /// Every scene within its bar.
    pub fn check_bars(&self) -> Result<(), String> {
        let over: Vec<String> = self
            .bars()
            .filter(|(bar, cost)| *cost > bar.most)
            .map(|(bar, cost)| format!("{}, {}: {cost} cycles, at most {}", bar.scene, bar.what, bar.most))
            .collect();
        if over.is_empty() { Ok(()) } else { Err(over.join("; ")) }
    }

    /// For other programs.
    pub fn json(&self) -> String {
        let bars = self.bars().map(
            |(bar, cost)| json!({ "scene": bar.scene, "what": bar.what, "cycles": cost, "most": bar.most }),
        );
        let value = json!({
            "board": "RP2040 at 125 MHz, emulated", "unit": "cycles a frame of 2,048 taxels",
            "rows": self.rows.iter().map(Row::json).collect::<Vec<_>>(), "bars": bars.collect::<Vec<_>>(),
        });
        serde_json::to_string_pretty(&value).unwrap_or_default()
    }

    /// Writes the table as text and as JSON.
    pub fn write(&self, folder: &Path) -> Result<(), String> {
        let write = |name: &str, text: String| {
            std::fs::write(folder.join(name), text).map_err(|error| format!("{}: {error}", folder.display()))
        };
        std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        write("cycles.txt", self.to_string())?;
        write("cycles.json", format!("{}\n", self.json()))
    }

    /// No figure is far from the one that was written.
    pub fn compare(&self, folder: &Path) -> Result<(), String> {
        let text = std::fs::read_to_string(folder.join("cycles.json"))
            .map_err(|error| format!("{}: {error}; `cargo xtask cycles --write`", folder.display()))?;
        let written: Value = serde_json::from_str(&text).map_err(|error| error.to_string())?;
        for row in &self.rows {
            let variant = row.variant.name();
            let old = written["rows"].as_array().into_iter().flatten();
            let mut old = old.filter(|old| old["scene"] == row.name && old["variant"] == variant);
            let old = old.next().ok_or(format!("{}, {variant}: not written yet", row.name))?;
            for (what, cost) in [("perceive", row.perceive()), ("all", row.whole()), ("largest", row.largest)]
            {
                let before = old[what].as_u64().unwrap_or(0);
                if cost.abs_diff(before) > (before * TOLERANCE / 100).max(SMALL) {
                    let name = row.name;
                    return Err(format!(
                        "{name}, {variant}: {what} takes {cost} cycles, {before} were written: `cargo xtask cycles --write`"
                    ));
                }
            }
        }
        Ok(())
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "Cycles a frame of 2,048 taxels, 12 bit, on the emulated RP2040 (Cortex-M0+, 125 MHz): mean of 16 frames."
        )?;
        writeln!(
            f,
            "perceive: condition to reaction, without the map; all: with encoding and the board's own work; the map apart."
        )?;
        writeln!(f, "Errors against the exact moments of the same touch without noise: largest and rms.\n")?;
        write!(f, "{:13}{:11}", "scene", "variant")?;
        for head in [
            "condition",
            "contact",
            "shape",
            "symbol",
            "react",
            "perceive",
            "encode",
            "all",
            "largest",
            "map",
        ] {
            write!(f, "{head:>10}")?;
        }
        writeln!(
            f,
            "{:>7}{:>9}{:>8}  {:>17}  {:>17}",
            "bytes", "contacts", "dropped", "centroid, taxel", "NMI, %"
        )?;
        for row in &self.rows {
            write!(f, "{:13}{:11}", row.name, row.variant.name())?;
            let stages = [Stage::Condition, Stage::Contact, Stage::Shape, Stage::Symbol, Stage::React];
            let costs = stages.map(|stage| row.stage(stage)).into_iter();
            let sums = [
                row.perceive(),
                row.stage(Stage::Encode),
                row.whole(),
                row.largest,
                row.stage(Stage::Intent),
            ];
            costs.chain(sums).try_for_each(|cost| write!(f, "{cost:>10}"))?;
            write!(f, "{:>7}{:>9}{:>8}", row.bytes, row.contacts[0], row.contacts[1])?;
            if let Some([place, nmi]) = &row.error {
                write!(f, "  {:>8.4} {:>8.4}", place.largest, place.rms())?;
                write!(f, "  {:>8.3} {:>8.3}", nmi.largest * 100.0, nmi.rms() * 100.0)?;
            }
            writeln!(f)?;
        }
        writeln!(f)?;
        for (bar, cost) in self.bars() {
            let share = cost as f64 / bar.most as f64 * 100.0;
            writeln!(f, "{}, {}: {cost} of at most {} cycles ({share:.0} %)", bar.scene, bar.what, bar.most)?;
        }
        let stack = self.rows.iter().map(|row| row.stack).max().unwrap_or(0);
        writeln!(f, "deepest stack: {stack} bytes")
    }
}
