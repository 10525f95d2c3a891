//! The map that ships: measures of a touch cause kindness, threat and attack; these cause happiness, anger
//! and politeness. The source prints ten concepts and the matrix with all entries zero. The other ten
//! concepts, all of them measures, and the weights, in steps of 0.05, are ours. They follow the judgement of
//! an observer of forty families of touches (`host/taxel/tests/library/meaning`) and of twenty people
//! (`host/taxel/tests/library/people`).
//!
//! Inputs have no causes, and the edges have no cycle: the map settles within six steps for any input.
//! Without a touch every input is exactly 0, and so is every other concept. A concept that does not hold is
//! 0, not negative ([`Transfer::Positive`]), so that the absence of an attack causes no happiness. Feelings
//! follow meanings: if a threat or an attack leads, happiness and politeness are 0.

use super::config::{Edge, MapConfig, Rule};
use super::input::{MapInput, Source};
use super::transfer::Transfer;
use crate::format::name;

/// Counts of total pressure per newton with the reference garment's usual gain. A scene for another garment
/// sets its own limit in the input `press`.
pub const PRESS_PER_NEWTON: i32 = 1000;
/// Force in newtons at which press is 1, hard; at 0 N it is -1, light.
pub const FULL_PRESS_NEWTON: i32 = 30;
/// Rise up to which time is 0, in counts/ms (N/s): a hand takes at least a tenth of a second to close.
pub const SLOW_RISE: i32 = 400;
/// Rise from which time is -1: a blow takes a few hundredths of a second.
pub const SUDDEN_RISE: i32 = 1000;
/// Rise up to which a touch is too slow for a grip or a stab (slow is -1), and rise from which it is not
/// (slow is 0), in counts/ms.
pub const CREEPING_RISE: [i32; 2] = [90, 130];
/// Rises at which blow is -1 and 1, in counts/ms: hearty pats of 25 N stay below 900, slaps of 30 N exceed
/// 1,600.
pub const BLOW_RISE: [i32; 2] = [600, 1400];
/// Width up to which a contact is narrow (shape 0, edge 1), in 0.1 mm: straps, sticks, fingers, the edge of a
/// hand.
pub const NARROW: i32 = 300;
/// Width from which a contact is no edge (edge 0), in 0.1 mm.
pub const EDGE: i32 = 450;
/// Width from which a contact is broad (shape 1), in 0.1 mm: a palm.
pub const BROAD: i32 = 600;
/// Pressures of a taxel between which an object becomes sharp, in counts: a palm that holds with 70 N stays
/// below 2,200.
pub const SHARP: [i32; 2] = [2600, 3400];
/// Loads between which a grip becomes firm, in counts.
pub const FIRM: [i32; 2] = [18_000, 25_000];
/// Loads between which a grip becomes heavy, in counts.
pub const HEAVY: [i32; 2] = [40_000, 60_000];
/// Durations between which a touch becomes a grip, in ms: longer than a pat.
pub const GRIP_MS: [i32; 2] = [250, 400];
/// Ages between which a grip becomes distinct from the first beat of a handshake, in ms.
pub const SETTLED_MS: [i32; 2] = [450, 550];
/// Areas between which a touch becomes an embrace, in mm2: larger than the largest hand.
pub const EMBRACE_MM2: [i32; 2] = [13_800, 16_500];
/// Loads between which a touch is noticed, in counts: rain drops stay below.
pub const NOTICED: [i32; 2] = [400, 600];
/// Times between which a still object is no longer noticed, in ms.
pub const STILL_MS: [i32; 2] = [2000, 2100];

/// Names of the concepts: the ten of the source in the order of its matrix, then further inputs. The inputs
/// are named by what they mean.
const CONCEPTS: [&str; 20] = [
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
    "blow",
    "edge",
    "sharp",
    "slow",
    "firm",
    "lasting",
    "embrace",
    "rhythm",
    "notice",
    "own",
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
const BLOW: u8 = 10;
const EDGED: u8 = 11;
const SHARPNESS: u8 = 12;
const SLOW: u8 = 13;
const FIRMNESS: u8 = 14;
const LASTING: u8 = 15;
const EMBRACE: u8 = 16;
const RHYTHM: u8 = 17;
const NOTICE: u8 = 18;
const OWN: u8 = 19;

/// The edges: cause, effect, weight in hundredths.
const EDGES: [(u8, u8, i16); 36] = [
    // from the measures
    (PRESS, KINDNESS, -70),      // a light touch is kind
    (SHAPE, KINDNESS, 35),       // a flat hand may press more: it is a sign of good will
    (LOCATION, KINDNESS, 5),     // decides close cases only: a friendly place must not excuse a blow
    (TIME, KINDNESS, 20),        // a sudden touch is hardly kind
    (RHYTHM, KINDNESS, 70),      // shaking hands, pats and a massage are kind
    (EMBRACE, KINDNESS, 70),     // an embrace is kind
    (SHARPNESS, KINDNESS, -100), // a sharp object is not kind
    (NOTICE, KINDNESS, 100),     // a touch that is hardly felt, or an object that lies still, has no meaning
    (OWN, KINDNESS, -100),       // nor has a fold of the garment when the robot bends
    (FIRMNESS, THREAT, 90),      // a threat has force
    (LASTING, THREAT, 100),      // a threat lasts: a grip, not a pat
    (TIME, THREAT, 50),          // an object that fell and lies there is no grip
    (SLOW, THREAT, 70),          // nor is something that leans
    (EMBRACE, THREAT, -100),     // nor an embrace
    (RHYTHM, THREAT, -100),      // nor a handshake
    (LOCATION, THREAT, -5),      // less so where touch is usual
    (OWN, THREAT, -50),          // a touch by the robot's own motion is no threat
    (BLOW, ATTACK, 100),         // a blow is an attack
    (EDGED, ATTACK, 90),         // a narrow object hurts
    (SHARPNESS, ATTACK, 60),     // a sharp one hurts more
    (SLOW, ATTACK, 90),          // not if it comes slowly
    (EMBRACE, ATTACK, -50),      // nor if it is an embrace
    (LOCATION, ATTACK, -5),      // a friendly place excuses little
    // competition of the three
    (ATTACK, THREAT, -100),   // an attack is no mere threat
    (ATTACK, KINDNESS, -100), // an attack is not kind
    (THREAT, KINDNESS, -100), // a threat is not kind
    // feelings of the robot
    (KINDNESS, HAPPINESS, 50),   // kindness pleases
    (THREAT, HAPPINESS, -100),   // a threat does not
    (ATTACK, HAPPINESS, -100),   // nor does an attack
    (KINDNESS, ANGER, -50),      // kindness calms
    (THREAT, ANGER, 30),         // a threat annoys
    (ATTACK, ANGER, 80),         // an attack angers
    (KINDNESS, POLITENESS, 40),  // kindness is answered politely
    (HAPPINESS, POLITENESS, 10), // more so in a good mood
    (THREAT, POLITENESS, -100),  // a threat is not answered politely
    (ATTACK, POLITENESS, -100),  // an attack is not answered politely
];

/// The ramps: concept, source, range, and the activation at both ends. If both ends of a measure are evidence
/// (light and hard), they differ in sign. If only one is, the other is 0.
const INPUTS: [(u8, Source, [i32; 2], [i16; 2]); 18] = [
    (PRESS, Source::Press, [0, FULL_PRESS_NEWTON * PRESS_PER_NEWTON], [-100, 100]),
    (SHAPE, Source::Breadth, [NARROW, BROAD], [0, 100]),
    (LOCATION, Source::Friendliness, [-100, 100], [-100, 100]),
    (TIME, Source::Rise, [SLOW_RISE, SUDDEN_RISE], [0, -100]),
    (BLOW, Source::Blow, BLOW_RISE, [-100, 100]),
    (EDGED, Source::Breadth, [NARROW, EDGE], [100, 0]),
    (SHARPNESS, Source::Peak, SHARP, [0, 100]),
    (SLOW, Source::Rise, CREEPING_RISE, [-100, 0]),
    (FIRMNESS, Source::Load, FIRM, [-100, 55]),
    (FIRMNESS, Source::Load, HEAVY, [0, 45]),
    (LASTING, Source::Duration, GRIP_MS, [-100, 0]),
    (LASTING, Source::Age, SETTLED_MS, [-100, 0]),
    (EMBRACE, Source::Cover, EMBRACE_MM2, [0, 100]),
    (RHYTHM, Source::Beats, [0, 1], [0, 100]),
    (RHYTHM, Source::Load, NOTICED, [-100, 0]),
    (NOTICE, Source::Load, NOTICED, [-100, 0]),
    (NOTICE, Source::Still, STILL_MS, [0, -100]),
    (OWN, Source::Own, [0, 1], [0, 100]),
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
