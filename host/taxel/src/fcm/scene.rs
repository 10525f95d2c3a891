//! Maps in scene files: `intent.map` may be the name of a shipped map, the path of a map file, or an inline
//! map.

use super::load;
use super::map::MapFile;
use crate::error::{Context, MapFileError, Result};
use serde_json::Value;
use std::path::Path;
use taxel_core::intent::MapConfig;

/// Replaces a scene's `intent.map` by the core's form of the map. Paths are relative to `folder`. A map in
/// the core's own form stays unchanged.
pub fn resolve(scene: &mut Value, folder: &Path) -> Result<()> {
    let Some(map) = scene.get_mut("intent").and_then(|intent| intent.get_mut("map")) else { return Ok(()) };
    let file: MapFile = match map {
        Value::String(name) if load::SHIPPED.iter().any(|(shipped, _)| shipped == name) => load::map(name)?,
        Value::String(path) => load::map(&folder.join(path).display().to_string()).context("intent.map")?,
        Value::Object(table) if table.contains_key("concept") => {
            serde_json::from_value(map.clone()).context("intent.map")?
        }
        _ => return Ok(()),
    };
    if let Some(input) = file.input.iter().find(|input| input.robot.is_some()) {
        let concept = &input.concept;
        fail!(MapFileError::Unanswerable, "intent.map: input {concept} is of a robot, which no board knows");
    }
    let config: MapConfig = *file.to_config().context("intent.map")?;
    *map = serde_json::to_value(config).context("intent.map")?;
    Ok(())
}
