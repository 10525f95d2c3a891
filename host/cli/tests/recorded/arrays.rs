//! Frames that the parsers of tactile arrays gave for recorded streams, value for value.

use crate::data::find;
use serde_json::Value;
use taxel::source::array::{ArrayDecoder, ArrayDescription, ArraySpec, described};

/// Formats of the folder, and the name of their source.
const FORMATS: [(&str, &str); 6] = [
    ("flexitac", "flexitac:-"),
    ("vitac_ascii", "vitac:-"),
    ("m0404s", "m0404s:-,range=0..4095"),
    ("m1616", "m1616:-"),
    ("anyskin", "anyskin:-,range=0..1000"),
    ("wiresens", "wiresens:-"),
];

fn cases(format: &str) -> Vec<Value> {
    let text = std::fs::read_to_string(find("foreign").join(format!("{format}.json"))).unwrap();
    serde_json::from_str::<Value>(&text).unwrap()["cases"].as_array().unwrap().clone()
}

fn bytes(hex: &str) -> Vec<u8> {
    let digits: Vec<u8> = hex.chars().map(|digit| digit.to_digit(16).unwrap() as u8).collect();
    digits.chunks(2).map(|pair| pair[0] << 4 | pair[1]).collect()
}

/// The pieces in which a case's stream comes: as it says, whole, and byte by byte.
fn cuttings(case: &Value) -> Vec<Vec<Vec<u8>>> {
    if let Some(notifications) = case["notifications"].as_array() {
        let pieces: Vec<_> = notifications.iter().map(|hex| bytes(hex.as_str().unwrap())).collect();
        return vec![vec![pieces.concat()], pieces];
    }
    let stream = bytes(case["stream"].as_str().unwrap());
    if let Some(answers) = case["answers"].as_array() {
        let mut rest = &stream[..];
        let mut answer =
            |length: &Value| rest.split_off(..length.as_u64().unwrap() as usize).unwrap().to_vec();
        return vec![answers.iter().map(&mut answer).collect()];
    }
    let mut cuts: Vec<usize> =
        case["cuts"].as_array().into_iter().flatten().map(|at| at.as_u64().unwrap() as usize).collect();
    cuts.insert(0, 0);
    cuts.push(stream.len());
    let pieces = cuts.windows(2).map(|pair| stream[pair[0]..pair[1]].to_vec()).collect();
    vec![pieces, vec![stream.clone()], stream.iter().map(|byte| vec![*byte]).collect()]
}

/// Compares the frames of a case with those of its description.
fn agrees(format: &str, case: &Value, description: &ArrayDescription) {
    let name = format!("{format}: {}", case["name"]);
    let wanted: Vec<&Value> = case["frames"].as_array().unwrap().iter().collect();
    let must = wanted.iter().filter(|frame| frame["must"] != Value::Bool(false)).count();
    let is_answer = case["answers"].is_array();
    for pieces in cuttings(case) {
        let (mut decoder, mut frames) = (ArrayDecoder::new(description), Vec::new());
        for piece in pieces {
            decoder.push(&piece, 0, &mut |frame| frames.push(frame));
            if is_answer {
                decoder.quiet(&mut |frame| frames.push(frame));
            }
        }
        assert!((must..=wanted.len()).contains(&frames.len()), "{name}: {} frames", frames.len());
        for (frame, wanted) in frames.iter().zip(&wanted) {
            // No format sends more than an f32 holds, and this reader of JSON may miss the last bit of an f64.
            let single = |value: f64| value as f32;
            let values =
                wanted["values"].as_array().unwrap().iter().map(|value| single(value.as_f64().unwrap()));
            let seen: Vec<f32> = frame.values.iter().map(|value| single(*value)).collect();
            assert_eq!(seen, values.collect::<Vec<_>>(), "{name}");
            assert!(wanted["time_us"].is_null() || frame.time_us == wanted["time_us"].as_u64(), "{name}");
            assert!(
                wanted["seq"].is_null() || frame.sequence.map(u64::from) == wanted["seq"].as_u64(),
                "{name}"
            );
        }
    }
}

#[test]
fn described_arrays_give_the_frames_of_their_own_parsers() {
    for case in cases("generic") {
        let description = ArrayDescription::parse(case["description"].as_str().unwrap(), "mat.toml").unwrap();
        agrees("generic", &case, &description);
    }
}

#[test]
fn named_formats_give_the_frames_of_their_own_parsers() {
    for (format, source) in FORMATS {
        for case in cases(format) {
            let settings = &case["settings"];
            if settings["text"] == Value::Bool(true) {
                eprintln!("{format}: {}: not run: the text sketch has no decoder", case["name"]);
                continue;
            }
            let mut source = source.to_string();
            for (setting, key) in
                [("rows", "rows"), ("cols", "columns"), ("chips", "chips"), ("nodes", "nodes")]
            {
                if let (Some(value), false) = (settings[setting].as_u64(), format.starts_with("vitac")) {
                    source += &format!(",{key}={value}");
                }
            }
            if case["notifications"].is_array() {
                source = source.replace(":-", ":tcp:host:7000");
            }
            let description = described(&ArraySpec::read(&source).unwrap().unwrap()).unwrap();
            agrees(format, &case, &description);
        }
    }
}
