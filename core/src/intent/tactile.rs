//! The map that ships: shape, location, press and time of a touch cause kindness, threat and attack; those cause
//! happiness, anger and politeness. The source prints the ten concepts and the matrix with all entries zero: the weights
//! here are ours, in steps of 0.05, set by what touches of people are (`tests/people/scripted.rs`); people it never saw judge it.
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
/// Force at which press is 1, hard, in newtons; it begins at -1, light.
pub const FULL_PRESS_NEWTON: i32 = 25;
/// Mean rise of the force up to which time is 1, in counts/ms (N/s): a hand that closes takes at least a tenth of a second.
pub const SLOW_RISE: i32 = 400;
/// Mean rise from which time is -1: a blow is over in a few hundredths.
pub const SUDDEN_RISE: i32 = 1000;
/// Width up to which a contact is narrow (shape 0), in 0.1 mm: straps, sticks, fingers, the edge of a hand.
pub const NARROW: i32 = 300;
/// Width from which it is broad (shape 1), in 0.1 mm: a palm.
pub const BROAD: i32 = 600;
/// Duration at which time is greater by half, in ms.
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
    (PRESS, KINDNESS, -100), // kindness spares force: what is light is kind
    (SHAPE, KINDNESS, 40),   // a flat hand may press more, the oldest sign of good will
    (LOCATION, KINDNESS, 5), // a friendly place tips a close call; it must not excuse a blow
    (TIME, KINDNESS, 25),    // and so may what takes its time
    (PRESS, THREAT, 30),     // a threat has force
    (SHAPE, THREAT, -30),    // which on a broad surface is less of it
    (LOCATION, THREAT, -5),  // less so where touching is usual
    (TIME, THREAT, 80),      // and it takes its time: it holds, the longer the graver
    (PRESS, ATTACK, 30),     // a blow has force
    (SHAPE, ATTACK, -30),    // on a narrow surface, which hurts
    (LOCATION, ATTACK, -5),  // a friendly place excuses little
    (TIME, ATTACK, -45),     // and it comes at once; what follows does not make it undone
    // how the three compete
    (KINDNESS, THREAT, -60), // who is kind does not threaten; who is unkind does
    (KINDNESS, ATTACK, -35), // nor hit
    (THREAT, ATTACK, -10),   // a threat holds back what it threatens with
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

/// The ramps: concept, source, range, and the activation at both ends. Where both sides of a measure say something, they differ
/// in sign: light and hard, sudden and slow. Shape starts at 0: narrow alone says nothing.
const INPUTS: [(u8, Source, [i32; 2], [i16; 2]); 5] = [
    (PRESS, Source::Press, [0, FULL_PRESS_NEWTON * PRESS_PER_NEWTON], [-100, 100]),
    (SHAPE, Source::Breadth, [NARROW, BROAD], [0, 100]),
    (LOCATION, Source::Friendliness, [-100, 100], [-100, 100]),
    (TIME, Source::Rise, [SLOW_RISE, SUDDEN_RISE], [100, -100]),
    (TIME, Source::Duration, [0, LONG_MS], [0, 50]),
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
    for (concept, source, [low, high], [at_low, at_high]) in INPUTS {
        let _ = map.inputs.push(Input { concept, source, low, high, at_low, at_high });
    }
    map
}
