//! The map that ships: shape, location, press and time of a touch cause kindness, threat and attack; those cause
//! happiness, anger and politeness. The source prints the ten concepts and the matrix with all entries zero: the weights
//! here are ours, searched in steps of 0.05 for the largest margin over the touches that `tests.rs` lists.
//!
//! Nothing causes an input and no edge closes a loop: the map settles within six steps, whatever is put in. Without a
//! touch every input is 0, and tanh(0) = 0 keeps every other concept at exactly 0.

use super::config::{Edge, MapConfig, Rule};
use super::input::{Input, Source};
use super::transfer::Transfer;
use crate::format::name;

/// Counts of total pressure per newton with the reference garment's usual gain. A scene for another garment writes its
/// own limit into the input `press`.
pub const PRESS_PER_NEWTON: i32 = 1000;
/// Force at which press is 1, in newtons.
pub const FULL_PRESS_NEWTON: i32 = 30;
/// Width up to which a contact is narrow (shape 0), in 0.1 mm: straps, sticks, fingers, the edge of a hand.
pub const NARROW: i32 = 300;
/// Width from which it is broad (shape 1), in 0.1 mm: a palm.
pub const BROAD: i32 = 600;
/// Duration at which time is 1, in ms.
pub const LONG_MS: i32 = 1000;

/// The concepts, in the order of the source's matrix with the inputs by their meaning.
const CONCEPTS: [&str; 10] = [
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

/// The edges: cause, effect, weight in hundredths.
const EDGES: [(u8, u8, i16); 24] = [
    // what the touch says
    (PRESS, KINDNESS, -90), // force is what kindness spares: half of 30 N leaves a broad touch kind, all of it not
    (SHAPE, KINDNESS, 90),  // the flat hand, the oldest sign of good will
    (LOCATION, KINDNESS, 5), // a friendly place tips a close call; it must not excuse a blow
    (TIME, KINDNESS, 10),   // staying with somebody is kind, as long as it is not pressed
    (PRESS, THREAT, 15),    // force of any shape is a warning
    (SHAPE, THREAT, 10),    // a broad contact under force is a hold, and being held is a threat
    (LOCATION, THREAT, -5), // less so where touching is usual
    (TIME, THREAT, 5),      // and more so the longer it does not let go
    (PRESS, ATTACK, 100),   // a blow is force before anything else: without it nothing is an attack
    (SHAPE, ATTACK, -50),   // on a narrow surface, which hurts
    (LOCATION, ATTACK, -5), // a friendly place excuses little
    (TIME, ATTACK, -45),    // and short: what stays has stopped hitting
    // how the three compete
    (KINDNESS, THREAT, -5),  // a kind touch threatens a little less
    (KINDNESS, ATTACK, -20), // who is kind does not hit; what is unkind hits the harder
    (THREAT, ATTACK, -40),   // a threat holds back what it threatens with
    // what the robot feels about it
    (KINDNESS, HAPPINESS, 80),   // kindness pleases
    (THREAT, HAPPINESS, -30),    // a threat spoils it
    (ATTACK, HAPPINESS, -60),    // an attack more so
    (KINDNESS, ANGER, -20),      // kindness calms
    (THREAT, ANGER, 30),         // a threat annoys
    (ATTACK, ANGER, 80),         // an attack angers
    (KINDNESS, POLITENESS, 50),  // kindness is answered politely
    (HAPPINESS, POLITENESS, 30), // the more so in a good mood
    (ANGER, POLITENESS, -50),    // and anger forgets its manners
];

/// The ramps: concept, source, range. All run from 0 to 1 except location, whose two sides differ in sign. Shape starts
/// at 0, not at -1: if a narrow contact counted by itself, a light flick with a strap would be half an attack.
const INPUTS: [(u8, Source, i32, i32, i16); 4] = [
    (PRESS, Source::Press, 0, FULL_PRESS_NEWTON * PRESS_PER_NEWTON, 0),
    (SHAPE, Source::Breadth, NARROW, BROAD, 0),
    (LOCATION, Source::Friendliness, -100, 100, -100),
    (TIME, Source::Duration, 0, LONG_MS, 0),
];

/// The shipped map: kosko, tanh, lambda 3.5 (activations then use most of their range), inputs held.
pub fn tactile() -> MapConfig {
    let mut map = MapConfig {
        name: name("tactile"),
        decimals: 2,
        rule: Rule::Kosko,
        transfer: Transfer::Tanh,
        lambda: 3500,
        held: true,
        ..MapConfig::default()
    };
    // Each list fits by far; a test counts them.
    for concept in CONCEPTS {
        let _ = map.concepts.push(name(concept));
    }
    for (from, to, weight) in EDGES {
        let _ = map.edges.push(Edge { from, to, weight });
    }
    for (concept, source, low, high, at_low) in INPUTS {
        let _ = map.inputs.push(Input { concept, source, low, high, at_low, at_high: 100 });
    }
    map
}
