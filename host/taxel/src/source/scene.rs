//! Scene files: the shipped scene, with the values of a script or a file.

use crate::error::{Context, Error, Result, SettingError};
use crate::fcm;
use crate::files::input;
use crate::sim::Script;
use crate::tell::{toml_key, words};
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
        let text = input::text(path).with_context(|| format!("{name} cannot be read"))?;
        SceneFile::parse(text, name, path.parent().unwrap_or(Path::new(".")))
    }

    /// A scene by its file, or by its text, which has more than one line or an assignment.
    pub fn named(path_or_text: &str) -> Result<SceneFile> {
        if path_or_text.contains(['\n', '=']) && !Path::new(path_or_text).is_file() {
            return SceneFile::parse(path_or_text.into(), "the scene".into(), Path::new("."));
        }
        SceneFile::read(Path::new(path_or_text))
    }

    /// Parses a scene's text. `name` names it in errors; paths of maps are relative to `folder`.
    pub fn parse(text: String, name: String, folder: &Path) -> Result<SceneFile> {
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

/// Reads a scene's file, see [`SceneFile::read`].
pub fn read_scene(path: &Path) -> Result<Scene> {
    Ok(SceneFile::read(path)?.scene)
}

/// What is wrong with a scene's values, and under which key.
struct SceneFault {
    key: String,
    why: String,
}

/// Merges values into the shipped scene. Paths of maps are relative to `folder`.
fn filled(mut said: Value, folder: &Path) -> Result<Scene, SceneFault> {
    fcm::scene::resolve(&mut said, folder).map_err(|error| SceneFault {
        key: "intent.map".into(),
        why: words::chain(&error).skip(1).map(words::cause).collect::<Vec<_>>().join(": "),
    })?;
    scene_as(&said).map_err(|why| SceneFault { key: key_of(&why, &said), why })
}

/// Parses a scene, or returns the parser's message.
fn scene_as(said: &Value) -> Result<Scene, String> {
    // Via JSON, because TOML has no 64-bit masks.
    let mut merged = serde_json::to_value(Scene::shipped()).map_err(|error| error.to_string())?;
    merge(&mut merged, said.clone());
    serde_json::from_value(merged).map_err(|error| words::cause(&error))
}

/// Finds the path of the innermost value without which the parser no longer reports this message.
fn key_of(why: &str, said: &Value) -> String {
    let is_missing = |why: &str| why.contains("is missing") || why.starts_with("missing field");
    let (mut path, mut pointer) = (String::new(), String::new());
    while let Some(node) = said.pointer(&pointer) {
        let children: Vec<(String, String)> = match node {
            Value::Object(table) => {
                let dot = if path.is_empty() { "" } else { "." };
                table.keys().map(|key| (format!("/{key}"), format!("{dot}{key}"))).collect()
            }
            Value::Array(items) => (0..items.len()).map(|at| (format!("/{at}"), format!("[{at}]"))).collect(),
            _ => break,
        };
        let decides = |(step, _): &&(String, String)| match scene_as(&without(said, &pointer, step)) {
            Ok(_) => true,
            // If something is missing, another missing thing proves nothing.
            Err(other) => words_of(&other) != words_of(why) && !(is_missing(why) && is_missing(&other)),
        };
        let Some((step, name)) = children.iter().find(decides) else { break };
        pointer += step;
        path += name;
    }
    path
}

/// A message without its numbers: those of a list's length change as its values are left out.
fn words_of(why: &str) -> String {
    why.chars().filter(|letter| !letter.is_ascii_digit()).collect()
}

/// A copy of the values without one value of the node at `pointer`.
fn without(said: &Value, pointer: &str, step: &str) -> Value {
    let mut rest = said.clone();
    let key = step.trim_start_matches('/');
    match (rest.pointer_mut(pointer), key.parse::<usize>()) {
        (Some(Value::Object(table)), _) => drop(table.remove(key)),
        (Some(Value::Array(items)), Ok(at)) if at < items.len() => drop(items.remove(at)),
        _ => {}
    }
    rest
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
}
