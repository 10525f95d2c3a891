//! The format of map files.

use taxel::fcm::board::BoardMap;
use taxel::fcm::decimal::Decimal;
use taxel::fcm::map::MapFile;
use taxel::fcm::{engine, load};
use taxel_core::intent::{CONCEPTS, EDGES, MapConfig, Source, Touch, tactile};

/// A map with every element of the format.
pub const WHOLE: &str = r#"
version = 1
name = "whole"
note = "all forms"
rule = "mkosko"
transfer = "sigmoid"
lambda = 2.5
threshold = 0.1
held = true
[[concept]]
name = "press"
note = "how hard"
[[concept]]
name = "gentle"
[[concept]]
name = "kindness"
threshold = -0.25
[[input]]
concept = "press"
source = "press"
fall = [100, 300]
at = [-0.5, 1]
note = "counts"
[[input]]
concept = "gentle"
source = { host = 3 }
trapezoid = [0, 100, 200, 400]
[[edge]]
from = "press"
to = "kindness"
weight = "strong -"
fixed = true
note = "force is what kindness spares"
[[edge]]
from = "gentle"
to = "kindness"
weight = 0.5
"#;

pub fn map(text: &str) -> MapFile {
    load::parse(text, "map.toml").unwrap()
}

#[test]
fn the_shipped_map_is_that_of_the_board() {
    let map = load::map("tactile").unwrap();
    assert_eq!(*map.to_config::<CONCEPTS, EDGES>().unwrap(), tactile());
    assert!(map.concept.iter().all(|c| !c.note.is_empty()) && map.edge.iter().all(|e| !e.note.is_empty()));
}

#[test]
fn a_file_survives_being_read_and_written() {
    let whole = map(WHOLE);
    assert_eq!(map(&toml::to_string(&whole).unwrap()), whole);
    let config: MapConfig = *whole.to_config().unwrap();
    // Not stored by the core: terms, notes; a falling ramp becomes a rising one that ends lower.
    let back = MapFile::from_config(&config);
    assert_eq!(*back.to_config::<CONCEPTS, EDGES>().unwrap(), config);
    assert_eq!(back.input[1], whole.input[1]);
    assert_eq!(
        MapFile::from_config(&tactile()).to_config::<CONCEPTS, EDGES>().unwrap().inputs,
        tactile().inputs
    );
}

#[test]
fn memberships_are_what_the_board_computes() {
    let text = "name = \"m\"\nheld = true\n[[concept]]\nname = \"x\"\n[[input]]\nconcept = \"x\"\nsource = \"press\"\n";
    let of = |form: &str, press: u32| {
        let board = BoardMap::build(&map(&format!("{text}{form}"))).unwrap();
        board.value(board.map.encode(Some(&Touch { press, ..Touch::default() }), &[])[0])
    };
    for (form, points) in [
        ("rise = [100, 300]", [(50, 0.0), (200, 0.5), (400, 1.0)]),
        ("fall = [100, 300]", [(50, 1.0), (250, 0.25), (400, 0.0)]),
        ("rise = [100, 300]\nat = [-1, 1]", [(50, -1.0), (200, 0.0), (400, 1.0)]),
        ("triangle = [0, 100, 200]", [(50, 0.5), (100, 1.0), (175, 0.25)]),
        ("triangle = [0, 100, 200]\nat = [-0.5, 0.5]", [(0, -0.5), (100, 0.5), (300, -0.5)]),
        ("trapezoid = [0, 100, 200, 400]", [(25, 0.25), (150, 1.0), (300, 0.5)]),
    ] {
        for (press, wanted) in points {
            assert_eq!(of(form, press), wanted, "{form} at {press}");
        }
    }
    assert_eq!(map(WHOLE).input[1].source, Some(Source::Host(3)));
}

/// Settings of the file, thresholds of single concepts and terms reach both engines.
#[test]
fn both_engines_take_the_whole_file() {
    let start = [("press".to_string(), Decimal::parse("0.3").unwrap())];
    let (problem, settings) = map(WHOLE).problem(&start).unwrap();
    let float = engine::run(&problem, &settings, 1);
    // mkosko from 0: z = -0.75 * 0.3 + 0.25 = 0.025, sigmoid with lambda 2.5
    let wanted = 1.0 / (1.0 + (-2.5f64 * 0.025).exp());
    assert!((float.last()[2] - wanted).abs() < 1e-15);
    let fixed = engine::q15(&problem, &settings, 1).unwrap();
    assert!((fixed.last()[2] - wanted).abs() < 3e-5);
}

#[test]
fn a_bad_file_is_refused_in_one_sentence() {
    let refused = |from: &str, to: &str| {
        assert!(WHOLE.contains(from), "{from}");
        let read = load::parse(&WHOLE.replacen(from, to, 1), "map.toml");
        let error = read.and_then(|map| map.to_config::<CONCEPTS, EDGES>().map(drop)).unwrap_err();
        format!("{error:#}")
    };
    for (from, to, message) in [
        (
            "version = 1",
            "version = 2",
            "map.toml, line 2, `version`: map whole: version 2 is not known, this program reads 1",
        ),
        (
            "weight = 0.5",
            "weight = 2.0",
            "map.toml, line 37, `weight`: map whole: W[gentle][kindness] = 2 is outside [-1, 1]",
        ),
        (
            "weight = 0.5",
            "weight = nan",
            "map.toml, line 37, `weight`: map whole: W[gentle][kindness] = NaN is not a number of at most 4 decimals",
        ),
        (
            "weight = 0.5",
            "weight = inf",
            "map.toml, line 37, `weight`: map whole: W[gentle][kindness] = inf is outside [-1, 1]",
        ),
        (
            "strong -",
            "strongish -",
            "map.toml, line 31, `weight`: \"strongish -\" is not a weight: expected none, or weak, medium, strong, very strong followed by + or -",
        ),
        (
            "lambda",
            "lamda",
            "map.toml, line 7: `lamda` is not a known key, did you mean `lambda`? Known are `version`, `name`, `note`, `rule`, `transfer`, `lambda`, `threshold`, `held`, `concept`, `input`, `edge`",
        ),
        (
            "lambda = 2.5",
            "lambda = 0",
            "map.toml, line 7, `lambda`: map whole: lambda = 0 is outside 0.001 ..= 65.535",
        ),
        (
            "lambda = 2.5",
            "lambda = 2.51234",
            "map whole: lambda = 2.51234 is not a number of at most 3 decimals",
        ),
        (
            "to = \"kindness\"",
            "to = \"joy\"",
            "map.toml, line 30, `to`: map whole: an edge names the unknown concept joy",
        ),
        (
            "from = \"gentle\"",
            "from = \"press\"",
            "map.toml, line 34, `edge`: map whole: edge press -> kindness is given twice",
        ),
        (
            "name = \"gentle\"",
            "name = \"press\"",
            "map.toml, line 14, `name`: map whole: concept press is named twice",
        ),
        (
            "name = \"whole\"",
            "name = \"a map with a long name\"",
            "name a map with a long name is longer than 16 bytes",
        ),
        (
            "fall = [100, 300]",
            "",
            "map whole: input press: give exactly one of rise, fall, triangle and trapezoid",
        ),
        ("[100, 300]", "[300, 100]", "map whole: input press: the points [300, 100] do not rise"),
        ("source = \"press\"", "", "map whole: input press: source is missing"),
        (
            "threshold = -0.25",
            "threshold = -1.25",
            "map.toml, line 17, `threshold`: map whole: threshold of kindness = -1.25 is outside [-1, 1]",
        ),
    ] {
        assert_eq!(refused(from, to), message);
    }
    let cut = load::parse(&WHOLE[..WHOLE.len() - 16], "map.toml").unwrap_err().to_string();
    assert!(cut.starts_with("map.toml, line "), "{cut}");
    let empty = load::parse("name = \"m\"", "m.toml").unwrap_err();
    assert_eq!(format!("{empty:#}"), "m.toml: map m: it has no concept");
    let missing = format!("{:#}", load::map("missing.toml").unwrap_err());
    assert!(
        missing.starts_with("missing.toml: cannot be read, and the shipped maps are tactile"),
        "{missing}"
    );
}
