//! The map that ships: measures of a touch cause kindness, threat and attack; these cause happiness, anger
//! and politeness. The source prints ten concepts and the matrix with all entries zero. The other concepts and
//! the weights, in steps of 0.01, are ours: the signs and zeros are chosen, the sizes of the boundaries learned
//! from scripts of several hands (docs/concepts/meaning.md).
//!
//! Inputs have no causes, and the edges have no cycle: the map settles within six steps for any input.
//! Without a touch every input is exactly 0, and so is every other concept. A concept that does not hold is
//! 0, not negative ([`Transfer::Positive`]), so that the absence of an attack causes no happiness. Feelings
//! follow meanings: if a threat or an attack leads, happiness and politeness are 0.
//!
//! What is harder, faster or more pointed is never judged milder: every edge from such a measure to threat and
//! attack raises them, and context (goodwill, a broad surface, a slow rise, a usual place) takes from a sum
//! that grows with the load.

use super::config::{Edge, MapConfig, Rule};
use super::input::{MapInput, Source};
use super::transfer::Transfer;
use crate::format::name;

/// Counts of total pressure per newton with the reference garment's usual gain. A scene for another garment
/// sets its own limits in the inputs.
pub const PRESS_PER_NEWTON: i32 = 1000;

/// Names of the concepts: the ten of the source in the order of its matrix, then further ones: measures by what
/// they mean, `object` and `unclear`, which tell why nothing leads, and two that sum up measures.
const CONCEPTS: [&str; 22] = [
    "press",
    "shape",
    "location",
    "time",
    "kindness",
    "threat",
    "attack",
    "happiness",
    "anger",
    "politeness",
    "gradual",
    "slow",
    "lasting",
    "broad",
    "goodwill",
    "notice",
    "own",
    "harm",
    "object",
    "unclear",
    "sting",
    "grip",
];

const PRESS: u8 = 0;
const SHAPE: u8 = 1;
const LOCATION: u8 = 2;
const TIME: u8 = 3;
const KINDNESS: u8 = 4;
const THREAT: u8 = 5;
const ATTACK: u8 = 6;
const HAPPINESS: u8 = 7;
const ANGER: u8 = 8;
const POLITENESS: u8 = 9;
const GRADUAL: u8 = 10;
const SLOW: u8 = 11;
const LASTING: u8 = 12;
const BROAD: u8 = 13;
const GOODWILL: u8 = 14;
const NOTICE: u8 = 15;
const OWN: u8 = 16;
const HARM: u8 = 17;
const OBJECT: u8 = 18;
const UNCLEAR: u8 = 19;
const STING: u8 = 20;
const GRIP: u8 = 21;

/// The edges: cause, effect, weight in hundredths. `host/taxel/maps/tactile.toml` says why each is there.
const EDGES: [(u8, u8, i16); 41] = [
    (TIME, STING, -100),
    (SHAPE, STING, 83),
    (NOTICE, STING, 100),
    (PRESS, GRIP, 100),
    (SLOW, GRIP, 100),
    (LASTING, GRIP, 100),
    (BROAD, GRIP, -100),
    (GOODWILL, GRIP, -100),
    (OBJECT, GRIP, -100),
    (OWN, GRIP, -50),
    (TIME, ATTACK, -100),
    (SHAPE, ATTACK, 83),
    (GRADUAL, ATTACK, -100),
    (NOTICE, ATTACK, 100),
    (LOCATION, ATTACK, -5),
    (STING, THREAT, 50),
    (GRIP, THREAT, 50),
    (HARM, THREAT, 50),
    (LOCATION, THREAT, -5),
    (OWN, THREAT, -30),
    (GOODWILL, KINDNESS, 100),
    (PRESS, KINDNESS, -60),
    (LOCATION, KINDNESS, 5),
    (NOTICE, KINDNESS, 100),
    (OWN, KINDNESS, -100),
    (UNCLEAR, KINDNESS, -100),
    (STING, KINDNESS, -100),
    (HARM, KINDNESS, -100),
    (GRIP, KINDNESS, -100),
    (THREAT, KINDNESS, -100),
    (ATTACK, KINDNESS, -100),
    (KINDNESS, HAPPINESS, 50),
    (THREAT, HAPPINESS, -100),
    (ATTACK, HAPPINESS, -100),
    (KINDNESS, ANGER, -50),
    (THREAT, ANGER, 30),
    (ATTACK, ANGER, 80),
    (KINDNESS, POLITENESS, 40),
    (HAPPINESS, POLITENESS, 10),
    (THREAT, POLITENESS, -100),
    (ATTACK, POLITENESS, -100),
];

/// The ramps: concept, source, range, and the activation at both ends in hundredths. If both ends of a measure
/// are evidence (broad and pointed), they differ in sign. If only one is, the other is 0.
const INPUTS: [(u8, Source, [i32; 2], [i16; 2]); 20] = [
    (PRESS, Source::Force, [18500, 148000], [0, 100]),
    (SHAPE, Source::Pressure, [12, 3072], [-100, 100]),
    (LOCATION, Source::Friendliness, [-100, 100], [-100, 100]),
    (TIME, Source::Loading, [62, 16000], [100, -100]),
    (GRADUAL, Source::Rising, [15500, 22000], [0, 50]),
    (GRADUAL, Source::Rising, [22000, 62000], [0, 50]),
    (SLOW, Source::Rise, [90, 130], [-100, 0]),
    (LASTING, Source::Duration, [250, 400], [-100, 0]),
    (LASTING, Source::Age, [450, 550], [-100, 0]),
    (BROAD, Source::Extent, [15000, 33300], [0, 100]),
    (GOODWILL, Source::Gives, [0, 1], [0, 100]),
    (GOODWILL, Source::Stroked, [0, 200], [0, 100]),
    (GOODWILL, Source::Embraced, [100, 250], [0, 100]),
    (GOODWILL, Source::Cover, [120, 200], [-100, 0]),
    (NOTICE, Source::Load, [400, 600], [-100, 0]),
    (OWN, Source::Own, [0, 1], [0, 100]),
    (HARM, Source::Force, [148000, 296000], [0, 100]),
    (HARM, Source::Pressure, [1050, 2100], [0, 100]),
    (OBJECT, Source::Still, [2000, 2100], [0, 100]),
    (UNCLEAR, Source::Peak, [3600, 3800], [0, 100]),
];

/// Returns the shipped map: kosko, tanh above 0, lambda 3.5 (activations then use most of their range),
/// inputs held.
pub fn tactile() -> MapConfig {
    let mut map = MapConfig {
        name: name("tactile"),
        decimals: 2,
        rule: Rule::Kosko,
        transfer: Transfer::Positive,
        lambda: 3500,
        held: true,
        ..MapConfig::default()
    };
    // Each list fits with room to spare; a test counts them.
    for concept in CONCEPTS {
        let _ = map.concepts.push(name(concept));
    }
    for (from, to, weight) in EDGES {
        let _ = map.edges.push(Edge { from, to, weight });
    }
    for (concept, source, [low, high], [at_low, at_high]) in INPUTS {
        let _ = map.inputs.push(MapInput { concept, source, low, high, at_low, at_high });
    }
    map
}
