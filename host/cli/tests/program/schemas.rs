//! The schemas of files.

use super::tools::{file, said};
use super::validator::wrong;
use crate::start::root;
use serde_json::Value;
use taxel_core::garment::Garment;
use taxel_core::react::ReactionConfig;
use taxel_core::scene::Scene;

/// A file as editors see it.
fn toml_value(text: &str) -> Value {
    serde_json::to_value(toml::from_str::<toml::Table>(text).unwrap()).unwrap()
}

#[test]
fn the_schema_of_garments_takes_what_ships_and_nothing_wrong() {
    let schema: Value = serde_json::from_str(&said(&["config", "schema", "garment"])).unwrap();
    for name in Garment::PRESETS {
        let text = toml::to_string(&Garment::preset(name).unwrap()).unwrap();
        assert_eq!(wrong(&toml_value(&text), &schema), None, "{name}");
    }
    let block = std::fs::read_to_string(root().join("host/taxel/garments/block-4x16.toml")).unwrap();
    assert_eq!(wrong(&toml_value(&block), &schema), None);
    let grid = toml_value("name = \"mat\"\n[grid]\nrows = 2\ncolumns = 3\npitch_um = [5000, 8000]\n");
    assert_eq!(wrong(&grid, &schema), None);
    assert!(wrong(&toml_value("name = \"mat\"\n"), &schema).is_some());
    for (from, to, place) in [
        ("columns = 16\n", "colums = 16\n", "/panels/0"),
        ("settle_ns = 8000", "settle_ns = \"8000\"", "/wiring/settle_ns"),
        ("{ pin = 9 }", "{ pin = 64 }", "/wiring/column/lines/0/pin"),
        ("rows = 4\n", "rows = 0\n", "/panels/0/rows"),
    ] {
        assert!(block.contains(from), "{from}");
        let why = wrong(&toml_value(&block.replacen(from, to, 1)), &schema).unwrap();
        assert!(why.starts_with(place), "{to}: {why}");
    }
}

#[test]
fn the_schema_of_scenes_takes_what_ships_and_nothing_wrong() {
    let schema: Value = serde_json::from_str(&said(&["config", "schema", "scene"])).unwrap();
    assert_eq!(wrong(&serde_json::to_value(Scene::shipped()).unwrap(), &schema), None);
    let begun = file("calm.toml");
    // A schema of an earlier version may exist.
    file("taxel-scene.schema.json");
    said(&["config", "scene", begun.to_str().unwrap()]);
    let text = std::fs::read_to_string(&begun).unwrap();
    assert!(text.starts_with("#:schema ./taxel-scene.schema.json\n"), "{text}");
    let scene = toml_value(&text);
    assert_eq!(wrong(&scene, &schema), None);
    // The scene of every simulation.
    for script in std::fs::read_dir(root().join("host/sim/scenes")).unwrap() {
        let script = toml_value(&std::fs::read_to_string(script.unwrap().path()).unwrap());
        assert_eq!(script.get("scene").and_then(|scene| wrong(scene, &schema)), None);
    }
    for (place, value) in [
        ("/stream/key_ms", Value::from(1001)),
        ("/condition/filter", "mean".into()),
        ("/contact/low", 0.into()),
        ("/symbol/extent", serde_json::json!([1])),
        ("/react/0/cause", "anger".into()),
        ("/intent/map", 7.into()),
        ("/name", "a name of more than sixteen".into()),
    ] {
        let mut changed = scene.clone();
        *changed.pointer_mut(place).unwrap() = value;
        let why = wrong(&changed, &schema).unwrap();
        assert!(why.starts_with(place), "{place}: {why}");
    }
    for cause in [
        "\"moving\"",
        "\"fault\"",
        "\"blind\"",
        "\"faulty\"",
        "\"silent\"",
        "\"watching\"",
        "{\"reflex\":\"two\"}",
    ] {
        let mut changed = scene.clone();
        changed["react"][0]["cause"] = serde_json::from_str(cause).unwrap();
        assert_eq!(wrong(&changed, &schema), None, "{cause}");
        serde_json::from_value::<ReactionConfig>(changed["react"][0].take()).unwrap();
    }
    let mut unknown = scene;
    unknown["contact"]["lo"] = 3.into();
    assert!(wrong(&unknown, &schema).unwrap().starts_with("/contact: additionalProperties"));
}

#[test]
fn the_schema_of_touches_takes_what_ships_and_nothing_wrong() {
    let schema: Value = serde_json::from_str(&said(&["config", "schema", "touches"])).unwrap();
    let mut scripts = 0;
    for script in std::fs::read_dir(root().join("host/sim/scenes")).unwrap() {
        let path = script.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(wrong(&toml_value(&text), &schema), None, "{}", path.display());
        scripts += 1;
    }
    assert!(scripts >= 13, "{scripts}");
    let text = std::fs::read_to_string(root().join("host/sim/scenes/pat.toml")).unwrap();
    for (from, to, place) in [
        ("duration_s = 1.4", "duration_s = -1", "/duration_s"),
        ("force_n = 8", "force_n = \"8\"", "/touch/0/force_n"),
        ("shape = \"palm\"", "shape = \"hand\"", "/touch/0/shape"),
        ("at = [7.5, 11]", "at = [7.5]", "/touch/0/at"),
        ("repeat = 3", "repeat = 0", "/touch/0/repeat"),
        ("angle_deg = 20", "angle = 20", "/touch/0"),
    ] {
        assert!(text.contains(from), "{from}");
        let why = wrong(&toml_value(&text.replacen(from, to, 1)), &schema).unwrap();
        assert!(why.starts_with(place), "{to}: {why}");
    }
}

#[test]
fn the_schema_of_robots_takes_the_robot_of_the_guide_and_nothing_wrong() {
    let schema: Value = serde_json::from_str(&said(&["config", "schema", "robot"])).unwrap();
    let two = super::robot::two();
    assert_eq!(wrong(&toml_value(&two), &schema), None);
    for (from, to, place) in
        [("tare = 32", "tare = \"32\"", "/boards/1/tare"), ("link =", "limb =", "/boards/1")]
    {
        assert!(two.contains(from), "{from}");
        let why = wrong(&toml_value(&two.replacen(from, to, 1)), &schema).unwrap();
        assert!(why.starts_with(place), "{to}: {why}");
    }
}
