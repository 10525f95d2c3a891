//! Scenes as people write them: the one that ships, with what a script or a file says otherwise.

use crate::fcm;
use crate::sim::Script;
use crate::words;
use anyhow::{Context, Result, anyhow};
use serde_json::Value;
use std::path::Path;
use taxel_core::scene::Scene;

/// The shipped scene with the settings of a script's `[scene]` in their places.
pub fn scene_of(script: &Script) -> Result<Scene> {
    let said = serde_json::to_value(&script.scene)?;
    filled(said, Path::new("."))
        .map_err(|error| anyhow!("scene {}: [scene]: {}", script.name, words::sentence(&error)))
}

/// Reads the file of a scene; what it does not say is as in the shipped scene, and its map may be [named](crate::fcm::scene).
/// Errors name the file, and the line or the section.
pub fn read_scene(path: &Path) -> Result<Scene> {
    let name = path.display().to_string();
    crate::verbose::reads(path);
    let text = std::fs::read_to_string(path).with_context(|| name.clone())?;
    let said: toml::Table =
        toml::from_str(&text).map_err(|error| anyhow!(words::toml(&error, &text, &name)))?;
    filled(serde_json::to_value(said)?, path.parent().unwrap_or(Path::new("."))).with_context(|| name)
}

/// The shipped scene with what is said in its place. `folder` is where the path of a map begins.
fn filled(mut said: Value, folder: &Path) -> Result<Scene> {
    fcm::scene::resolve(&mut said, folder)?;
    // JSON in between: TOML has no 64-bit masks.
    let mut merged = serde_json::to_value(Scene::shipped())?;
    merge(&mut merged, said);
    if let Value::Object(sections) = &merged {
        // One by one, so that an error can say where.
        for (key, value) in sections {
            let alone = Value::Object([(key.clone(), value.clone())].into_iter().collect());
            serde_json::from_value::<Scene>(alone)
                .map_err(|error| anyhow!("{key}: {}", words::cause(&error)))?;
        }
    }
    Ok(serde_json::from_value(merged)?)
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
        assert!(error.starts_with("scene a: [scene]: contact: `lo` is no key that is known here"), "{error}");
        let error = of("speed = 3").unwrap_err().to_string();
        assert!(
            error.starts_with("scene a: [scene]: speed: `speed` is no key that is known here"),
            "{error}"
        );
    }
}
