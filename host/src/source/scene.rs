//! The scene of a simulation: the one that ships, with what a script says otherwise.

use crate::fcm;
use crate::sim::Script;
use anyhow::{Context, Result, anyhow};
use serde_json::Value;
use std::path::Path;
use taxel_core::scene::Scene;

/// The shipped scene with the settings of a script's `[scene]` in their places.
pub fn scene_of(script: &Script) -> Result<Scene> {
    let wrong = |error: &dyn std::fmt::Display| anyhow!("scene {}: [scene]: {error}", script.name);
    // JSON in between: TOML has no 64-bit masks.
    let mut merged = serde_json::to_value(Scene::shipped()).map_err(|e| wrong(&e))?;
    let mut said = serde_json::to_value(&script.scene).map_err(|e| wrong(&e))?;
    fcm::scene::resolve(&mut said, Path::new(".")).map_err(|e| wrong(&format!("{e:#}")))?;
    merge(&mut merged, said);
    if let Value::Object(sections) = &merged {
        // One by one, so that an error can say where.
        for (key, value) in sections {
            let alone = Value::Object([(key.clone(), value.clone())].into_iter().collect());
            serde_json::from_value::<Scene>(alone).map_err(|e| wrong(&format!("{key}: {e}")))?;
        }
    }
    serde_json::from_value(merged).map_err(|e| wrong(&e))
}

/// Reads the file of a scene; what it does not say is as in the shipped scene, and its map may be [named](crate::fcm::scene).
pub fn read_scene(path: &Path) -> Result<Scene> {
    let name = path.display().to_string();
    let text = std::fs::read_to_string(path).with_context(|| name.clone())?;
    parse(&text, path).with_context(|| name)
}

/// JSON in between where it gives a map as people write it.
fn parse(text: &str, path: &Path) -> Result<Scene> {
    let table: toml::Table = toml::from_str(text)?;
    let map = table.get("intent").and_then(|intent| intent.get("map"));
    if map.is_none_or(|map| map.get("concepts").is_some()) {
        return Ok(toml::from_str(text)?);
    }
    let mut value = serde_json::to_value(table)?;
    fcm::scene::resolve(&mut value, path.parent().unwrap_or(Path::new(".")))?;
    Ok(serde_json::from_value(value)?)
}

/// Tables are merged, everything else is replaced.
fn merge(base: &mut Value, over: Value) {
    match (base, over) {
        (Value::Object(base), Value::Object(over)) => {
            for (key, value) in over {
                merge(base.entry(key).or_insert(Value::Null), value);
            }
        }
        (base, over) => *base = over,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(scene: &str) -> Result<Scene> {
        scene_of(&Script::parse(&format!("duration_s = 1\n[scene]\n{scene}"), "a.toml").unwrap())
    }

    #[test]
    fn what_a_script_says_replaces_what_ships() {
        assert_eq!(of("").unwrap(), Scene::shipped());
        let scene = of("rate_hz = 50\nstream = { contacts_hz = 20 }\nreact = []").unwrap();
        assert_eq!((scene.rate_hz, scene.stream.contacts_hz, scene.stream.key_ms), (50, 20, 1000));
        assert!(scene.react.is_empty());
        let map = "intent = { map = { name = \"two\", concept = [{ name = \"kindness\" }, { name = \"threat\" }], \
                   edge = [{ from = \"kindness\", to = \"threat\", weight = \"strong -\" }] } }";
        let named = of(map).unwrap().intent.unwrap().map;
        assert_eq!((named.concepts.len(), named.edges[0].weight, named.decimals), (2, -75, 2));
        assert_eq!(of("intent = { map = \"tactile\" }").unwrap(), Scene::shipped());
        let error = of(&map.replace("to = \"threat\"", "to = \"joy\"")).unwrap_err().to_string();
        assert!(error.contains("intent.map: map two: an edge names the unknown concept joy"), "{error}");
        let error = of("contact = { lo = 3 }").unwrap_err().to_string();
        assert!(error.starts_with("scene a: [scene]: contact: unknown field `lo`"), "{error}");
        let error = of("speed = 3").unwrap_err().to_string();
        assert!(error.starts_with("scene a: [scene]: speed: unknown field `speed`"), "{error}");
    }
}
