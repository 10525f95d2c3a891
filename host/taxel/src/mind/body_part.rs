//! Parts of the body that a map names: words are compared once for each place, and not at each thought.

use super::place::BodyPlace;
use crate::fcm::robot_source::{PartWords, RobotInput, RobotSource};
use std::sync::Arc;

/// Parts of which a place is, by their numbers.
pub type PartFlags = Arc<[bool]>;

/// A part of the body.
#[derive(Debug, Clone, Copy)]
pub struct BodyPart<'a> {
    words: &'a [String],
    /// Number of the part; none if it has none.
    number: Option<usize>,
}

impl BodyPart<'_> {
    /// The part that these words name, among those that have a number.
    pub fn of<'a>(words: &'a [String], known: &[PartWords]) -> BodyPart<'a> {
        BodyPart { words, number: known.iter().position(|part| part == words) }
    }

    /// True if a place, which is of these parts, is of this one.
    pub fn has(self, place: &BodyPlace, flags: &PartFlags) -> bool {
        let flag = self.number.and_then(|number| flags.get(number).copied());
        flag.unwrap_or_else(|| place.is_of(self.words))
    }
}

impl BodyPlace {
    /// Returns of which of these parts it is.
    pub(super) fn parts(&self, parts: &[PartWords]) -> PartFlags {
        parts.iter().map(|part| self.is_of(part)).collect()
    }
}

/// The parts that inputs name, each once.
pub(crate) fn parts_of(inputs: &[RobotInput]) -> Vec<PartWords> {
    let mut parts: Vec<PartWords> = Vec::new();
    for input in inputs {
        let named: &[&PartWords] = match &input.source {
            RobotSource::Load(part)
            | RobotSource::Cover(part)
            | RobotSource::Lasts(part)
            | RobotSource::Motion(part)
            | RobotSource::Hardness(part)
            | RobotSource::Point(part)
            | RobotSource::Slide(part)
            | RobotSource::Stir(part) => &[part],
            RobotSource::Apart(first, second) => &[first, second],
            RobotSource::Intent(_) | RobotSource::Own | RobotSource::HostInput(_) => &[],
        };
        for part in named {
            if !parts.contains(part) {
                parts.push((*part).clone());
            }
        }
    }
    parts
}
