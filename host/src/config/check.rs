//! Whether a garment's file can be worn, and a scene's played on it.

use super::line;
use crate::source::read_scene;
use crate::words;
use anyhow::{Context, Result, anyhow};
use std::path::Path;
use taxel_core::board::{BoardInfo, Setup};
use taxel_core::garment::{Circuit, Garment, Layout, Pins};
use taxel_core::scene::Scene;

/// The board that ships: taxels that it holds, and what it brings out.
const BOARD: (usize, BoardInfo) =
    (2048, BoardInfo { firmware: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 1_000_000 });

/// Checks a garment's file, and a scene's; what it is, in a sentence. Errors name file, line and key or place.
pub fn check(file: &Path, scene: Option<&Path>) -> Result<String> {
    let name = file.display().to_string();
    crate::verbose::reads(file);
    let text = std::fs::read_to_string(file).with_context(|| format!("cannot read {name}"))?;
    let garment: Garment =
        toml::from_str(&text).map_err(|error| anyhow!(words::toml(&error, &text, &name)))?;
    let (capacity, info) = BOARD;
    let place = |error: String| match line::of(&error, &text) {
        Some(line) => anyhow!("{name}, line {line}: {error}"),
        None => anyhow!("{name}: {error}"),
    };
    let layout =
        Layout::build(&garment, capacity, info.full_scale).map_err(|error| place(error.to_string()))?;
    Circuit::build(&garment, &layout, info.pins).map_err(|error| place(error.to_string()))?;
    let said = match scene {
        Some(file) => {
            let scene = read_scene(file)?;
            let scene_name = scene.name.clone();
            Setup::build(&info, garment.clone(), scene, capacity)
                .with_context(|| file.display().to_string())?;
            format!("; scene {scene_name} can be played on it")
        }
        None => {
            let mut scene = Scene::shipped();
            // What ships names regions and pins that a garment of one's own need not have.
            scene.react.clear();
            scene.friendliness.clear();
            Setup::build(&info, garment.clone(), scene, capacity).with_context(|| name.clone())?;
            String::new()
        }
    };
    let (panels, blocks) = (layout.areas().len(), garment.blocks.len());
    Ok(format!(
        "{name}: garment {}, {} taxels in {panels} panels and {blocks} blocks: fits{said}.",
        garment.name,
        layout.taxels()
    ))
}

#[cfg(test)]
mod tests {
    use super::super::Kind;
    use super::*;
    use serde_json::Value;

    fn checked(text: &str) -> Result<String> {
        let file = std::env::temp_dir().join(format!(
            "taxel-config-{}-{}.toml",
            std::process::id(),
            fastrand::u64(..)
        ));
        std::fs::write(&file, text).unwrap();
        let said = check(&file, None);
        std::fs::remove_file(&file).unwrap();
        said
    }

    #[test]
    fn errors_name_line_and_key() {
        let block = include_str!("../../garments/block-4x16.toml");
        assert!(
            checked(block)
                .unwrap()
                .ends_with("garment block-4x16, 64 taxels in 1 panels and 1 blocks: fits.")
        );
        let why = |from: &str, to: &str| format!("{:#}", checked(&block.replacen(from, to, 1)).unwrap_err());
        let line = |of: &str| block.lines().position(|line| line.starts_with(of)).unwrap() + 1;
        assert!(why("columns = 16\n", "colums = 16\n").contains(", line "));
        let outside = why("\nrow = 0", "\nrow = 2");
        assert!(
            outside.contains(&format!(
                ", line {}: block 0: it is empty or leaves panel mat",
                line("[[blocks]]")
            )),
            "{outside}"
        );
        let pin = why("{ pin = 9 }", "{ pin = 2 }");
        assert!(pin.contains(&format!(", line {}: wiring: pin 2 is used twice", line("[wiring]"))), "{pin}");
        let wrong = why("settle_ns = 8000", "settle_ns = \"8000\"");
        assert!(wrong.contains(&format!(", line {}, `settle_ns`", line("settle_ns"))), "{wrong}");
        let empty = why("rows = 4\n", "rows = 0\n");
        assert!(empty.contains(&format!(", line {}: panel mat: rows", line("[[panels]]"))), "{empty}");
    }

    /// Keys of a value, as paths; arrays give those of all of their items.
    fn keys(value: &Value, path: &str, found: &mut Vec<String>) {
        match value {
            Value::Object(table) => {
                for (key, value) in table {
                    let path = format!("{path}/{key}");
                    keys(value, &path, found);
                    found.push(path);
                }
            }
            Value::Array(items) => items.iter().for_each(|item| keys(item, path, found)),
            _ => {}
        }
    }

    /// Keys that a schema allows, as paths.
    fn allowed(schema: &Value, root: &Value, path: &str, found: &mut Vec<String>) {
        let there = schema.get("$ref").and_then(Value::as_str);
        let schema = there.map_or(schema, |name| root.pointer(&name[1..]).unwrap());
        if let Some(items) = schema.get("items") {
            allowed(items, root, path, found);
        }
        for (key, value) in schema.get("properties").and_then(Value::as_object).into_iter().flatten() {
            let path = format!("{path}/{key}");
            allowed(value, root, &path, found);
            found.push(path);
        }
    }

    #[test]
    fn the_schema_has_the_keys_of_a_garment_and_no_others() {
        let schema: Value = serde_json::from_str(Kind::Garment.schema()).unwrap();
        let (mut have, mut want) = (Vec::new(), Vec::new());
        allowed(&schema, &schema, "", &mut have);
        for garment in Garment::PRESETS.iter().filter_map(|name| Garment::preset(name)) {
            keys(&serde_json::to_value(garment).unwrap(), "", &mut want);
        }
        // No preset has a gap.
        let gap = taxel_core::garment::Absent { panel: 0, row: 0, column: 0, rows: 1, columns: 1 };
        keys(&serde_json::to_value(gap).unwrap(), "/absent", &mut want);
        let enable = taxel_core::garment::Line { pin: 0, inverted: false };
        keys(&serde_json::to_value(enable).unwrap(), "/wiring/enable", &mut want);
        for list in [&mut have, &mut want] {
            list.sort();
            list.dedup();
        }
        assert_eq!(have, want);
    }
}
