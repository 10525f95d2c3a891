//! Scene files: the shipped scene, with the values of a script or a file.

use crate::error::{Context, Error, Result, SettingError};
use crate::fcm;
use crate::files::input;
use crate::sim::Script;
use crate::text::{toml_key, words};
use serde_json::Value;
use std::fmt::Display;
use std::path::Path;
use taxel_core::scene::Scene;

/// The shipped scene with the values of a script's `[scene]`.
pub fn scene_of(script: &Script) -> Result<Scene> {
    let said = serde_json::to_value(&script.scene)?;
    filled(said, &script.folder).map_err(|SceneFault { key, why }| {
        let key = format!("scene.{key}");
        let text = format!("script {}: `{key}`: {why}", script.name);
        SettingError::Key { key, text }.into()
    })
}

/// Longest text of a scene, bytes. One with every key and a map of its own takes a tenth.
const LONGEST: u64 = 64 << 10;

/// A scene's file and its contents.
#[derive(Debug, Clone)]
pub struct SceneFile {
    /// The scene; missing keys have the shipped scene's values.
    pub scene: Scene,
    name: String,
    text: String,
}

impl SceneFile {
    /// Reads a scene's file, whose map may be [named](crate::fcm::scene). Errors name file, line and key.
    pub fn read(path: &Path) -> Result<SceneFile> {
        let name = path.display().to_string();
        std::fs::metadata(path).map_or(Ok(()), |file| check_length(&name, file.len()))?;
        let text = input::text(path).with_context(|| format!("{name} cannot be read"))?;
        SceneFile::parse(text, name, path.parent().unwrap_or(Path::new(".")))
    }

    /// A scene by its file, or by its text, which has more than one line or an assignment. Either has at most
    /// 64 KiB.
    pub fn named(path_or_text: &str) -> Result<SceneFile> {
        if path_or_text.contains(['\n', '=']) && !Path::new(path_or_text).is_file() {
            return SceneFile::parse(path_or_text.into(), "the scene".into(), Path::new("."));
        }
        SceneFile::read(Path::new(path_or_text))
    }

    /// Parses a scene's text. `name` names it in errors; paths of maps are relative to `folder`.
    pub fn parse(text: String, name: String, folder: &Path) -> Result<SceneFile> {
        check_length(&name, text.len() as u64)?;
        let said: toml::Table = toml::from_str(&text)
            .map_err(|error| SettingError::Malformed(words::toml(&error, &text, &name)))?;
        let said = serde_json::to_value(said)?;
        let scene = filled(said, folder)
            .map_err(|SceneFault { key, why }| toml_key::error(&name, &text, &key, why))?;
        Ok(SceneFile { scene, name, text })
    }

    /// Path of the file, or what else names the scene in errors.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Error about one of its keys, with its line.
    pub fn error(&self, key: &str, why: impl Display) -> Error {
        toml_key::error(&self.name, &self.text, key, why).into()
    }
}

/// Error if a scene is longer than it may be.
fn check_length(name: &str, bytes: u64) -> Result<()> {
    require!(
        bytes <= LONGEST,
        SettingError::TooLong,
        "{name}: a scene has at most {} KiB, not {}",
        LONGEST >> 10,
        bytes.div_ceil(1 << 10)
    );
    Ok(())
}

/// Reads a scene's file, see [`SceneFile::read`].
pub fn read_scene(path: &Path) -> Result<Scene> {
    Ok(SceneFile::read(path)?.scene)
}

/// Fault in a scene's values, and the key under which it is.
struct SceneFault {
    key: String,
    why: String,
}

/// Merges values into the shipped scene. Paths of maps are relative to `folder`.
fn filled(mut said: Value, folder: &Path) -> Result<Scene, SceneFault> {
    let fault = |key: &str, why: String| SceneFault { key: key.into(), why };
    fcm::scene::resolve(&mut said, folder).map_err(|error| {
        let causes = words::chain(&error).skip(1).map(words::cause);
        fault("intent.map", causes.collect::<Vec<_>>().join(": "))
    })?;
    // Via JSON, because TOML has no 64-bit masks.
    let shipped = serde_json::to_value(Scene::shipped());
    let mut merged = shipped.map_err(|error| fault("", words::cause(&error)))?;
    merge(&mut merged, said);
    serde_path_to_error::deserialize(merged)
        .map_err(|error| fault(&error.path().to_string(), words::cause(error.inner())))
}

/// Merges tables; replaces everything else.
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
    use crate::files::scripts;

    fn of(scene: &str) -> Result<Scene> {
        scene_of(&scripts::parse(&format!("duration_s = 1\n[scene]\n{scene}"), "a.toml").unwrap())
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
        assert!(
            error.contains("`scene.intent.map`: map two: an edge names the unknown concept joy"),
            "{error}"
        );
        let error = of("contact = { lo = 3 }").unwrap_err().to_string();
        assert!(error.starts_with("script a: `scene.contact.lo`: `lo` is not a known key"), "{error}");
        let error = of("speed = 3").unwrap_err().to_string();
        assert!(error.starts_with("script a: `scene.speed`: `speed` is not a known key"), "{error}");
    }

    #[test]
    fn a_map_that_a_script_names_lies_beside_it() {
        let text = "duration_s = 1\nscene = { intent = { map = \"mine.toml\" } }";
        let error = scene_of(&scripts::parse(text, "some/where/a.toml").unwrap()).unwrap_err().to_string();
        assert!(error.contains("some/where/mine.toml: cannot be read"), "{error}");
    }

    /// The key is found while the scene is read once: it was sought by reading the scene without each of its values.
    #[test]
    fn the_last_of_many_keys_is_reported() {
        let row = |name: &str| format!("{{ region = \"{name}\", percent = 1 }},\n");
        let many: String = (0..4).map(|at| row(&format!("part {at}"))).collect();
        let error =
            SceneFile::named(&format!("friendliness = [\n{many}{}]", row("part").replace('1', "1000")));
        let text = error.unwrap_err().to_string();
        assert!(text.starts_with("the scene, line 6, `friendliness[4].percent`: must be"), "{text}");
        let keys: String = (0..3000).map(|at| format!("key_{at} = {at}\n")).collect();
        let text = SceneFile::named(&keys).unwrap_err().to_string();
        assert!(text.starts_with("the scene, line 1, `key_0`: `key_0` is not a known key"), "{text}");
    }

    #[test]
    fn a_scene_that_is_too_long_is_refused() {
        let text = format!("name = \"long\"\n# {}", "x".repeat(LONGEST as usize));
        let refused = |error: crate::Error, name: &str| {
            assert_eq!(error.to_string(), format!("{name}: a scene has at most 64 KiB, not 65"));
        };
        refused(SceneFile::named(&text).unwrap_err(), "the scene");
        let path = std::env::temp_dir().join(format!("taxel-long-scene-{}.toml", std::process::id()));
        std::fs::write(&path, &text).unwrap();
        let read = SceneFile::read(&path);
        std::fs::remove_file(&path).unwrap();
        refused(read.unwrap_err(), &path.display().to_string());
    }
}
