//! The shipped scene, as a file to edit.

use anyhow::{Context, Result};
use serde_json::{Value, json};
use taxel_core::scene::Scene;

/// The scene as TOML: the map by its name, and without what TOML cannot represent (all blocks, a mask of 64
/// bits; null).
pub(super) fn text() -> Result<String> {
    let mut scene = serde_json::to_value(Scene::shipped())?;
    scene["intent"]["map"] = json!("tactile");
    if let Some(plan) = scene["plan"].as_object_mut() {
        plan.remove("blocks");
    }
    toml::to_string(&without_null(scene)).context("the scene cannot be written as TOML")
}

fn without_null(value: Value) -> Value {
    match value {
        Value::Object(table) => {
            let said = table.into_iter().filter(|(_, value)| !value.is_null());
            said.map(|(key, value)| (key, without_null(value))).collect()
        }
        Value::Array(items) => items.into_iter().map(without_null).collect(),
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel::source::read_scene;

    #[test]
    fn what_is_written_is_the_scene_that_ships() {
        let file = std::env::temp_dir().join(format!("taxel-config-scene-{}.toml", std::process::id()));
        std::fs::write(&file, text().unwrap()).unwrap();
        assert_eq!(read_scene(&file).unwrap(), Scene::shipped());
        std::fs::remove_file(&file).unwrap();
    }
}
