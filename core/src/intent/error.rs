//! Errors of a map's configuration: each names the concept, the edge or the parameter, and its value.

use crate::format::Name;
use core::fmt;

/// Reason why [`super::map::Map::build`] refused a configuration.
#[derive(Debug, Clone, PartialEq, Eq)]
#[allow(missing_docs)] // the fields are the words of the messages below
pub enum MapError {
    /// No concept, or more than the type has room for.
    Concepts { found: usize, room: usize },
    /// More edges than the type has room for.
    Edges { found: usize, room: usize },
    /// More inputs than the type has room for.
    Inputs { found: usize, room: usize },
    /// Two concepts have one name.
    DuplicateConcept { concept: Name },
    /// The decimal step is finer than 10^-4.
    Decimals { found: u8 },
    /// An edge starts or ends at a concept that does not exist.
    EdgeConcept { edge: usize, concept: u8, concepts: usize },
    /// A weight is outside -1 ..= 1.
    Weight { from: Name, to: Name, weight: i16, decimals: u8 },
    /// A pair of concepts has two edges in the same direction.
    DuplicateEdge { from: Name, to: Name },
    /// lambda is 0.
    Lambda,
    /// A threshold is outside -1 ..= 1; without a concept it is the common one.
    Threshold { concept: Option<Name>, value: i16, decimals: u8 },
    /// A threshold belongs to a concept that does not exist.
    ThresholdConcept { concept: u8, concepts: usize },
    /// A concept has two thresholds.
    DuplicateThreshold { concept: Name },
    /// The causes of a concept of a threshold map may sum to more than 32 bits: it needs fewer decimals.
    TooLarge { concept: Name },
    /// An input belongs to a concept that does not exist.
    InputConcept { input: usize, concept: u8, concepts: usize },
    /// An input concept also has causes, which would overwrite it at the first step.
    DrivenInput { concept: Name },
    /// The range of an input is empty.
    InputRange { concept: Name, low: i32, high: i32 },
    /// An end of an input's ramp is outside -1 ..= 1.
    InputValue { concept: Name, value: i16, decimals: u8 },
    /// None of the three intentions is a concept of the map.
    NoIntention,
    /// `level` or `margin`, in thousandths, is above 1.
    Fraction { parameter: &'static str, thousandths: u16 },
    /// `steps` is 0: such an inference has no result.
    NoSteps,
}

/// A number of decimal steps that prints as a decimal number: `Steps(-35, 2)` is -0.35.
#[derive(Debug, Clone, Copy)]
pub struct Steps(pub i16, pub u8);

impl fmt::Display for Steps {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let step = 10u32.checked_pow(self.1.into()).unwrap_or(u32::MAX);
        let size = u32::from(self.0.unsigned_abs());
        let (whole, mut rest) = (size.checked_div(step).unwrap_or(0), size.checked_rem(step).unwrap_or(0));
        write!(f, "{}{whole}", if self.0 < 0 { "-" } else { "" })?;
        if rest == 0 {
            return Ok(());
        }
        let mut width = usize::from(self.1);
        while rest % 10 == 0 && width > 1 {
            (rest, width) = (rest / 10, width - 1);
        }
        write!(f, ".{rest:0width$}")
    }
}

impl fmt::Display for MapError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use MapError as M;
        match self {
            M::Concepts { found: 0, .. } => write!(f, "the map has no concept"),
            M::Concepts { found, room } => write!(f, "{found} concepts, and there is room for {room}"),
            M::Edges { found, room } => write!(f, "{found} edges, and there is room for {room}"),
            M::Inputs { found, room } => write!(f, "{found} inputs, and there is room for {room}"),
            M::DuplicateConcept { concept } => write!(f, "concept {concept} is named twice"),
            M::Decimals { found } => write!(f, "decimals = {found} is outside 0 ..= 4"),
            M::EdgeConcept { edge, concept, concepts } => {
                write!(f, "edge {edge} names concept {concept}, and there are {concepts}")
            }
            M::Weight { from, to, weight, decimals } => {
                write!(f, "W[{from}][{to}] = {} is outside [-1, 1]", Steps(*weight, *decimals))
            }
            M::DuplicateEdge { from, to } => write!(f, "edge {from} -> {to} is given twice"),
            M::Lambda => write!(f, "lambda = 0 makes every concept constant"),
            M::Threshold { concept: None, value, decimals } => {
                write!(f, "threshold = {} is outside [-1, 1]", Steps(*value, *decimals))
            }
            M::Threshold { concept: Some(concept), value, decimals } => {
                write!(f, "threshold of {concept} = {} is outside [-1, 1]", Steps(*value, *decimals))
            }
            M::ThresholdConcept { concept, concepts } => {
                write!(f, "a threshold names concept {concept}, and there are {concepts}")
            }
            M::DuplicateThreshold { concept } => write!(f, "the threshold of {concept} is given twice"),
            M::TooLarge { concept } => {
                write!(f, "the causes of {concept} sum to more than 32 bits hold: use fewer decimals")
            }
            M::InputConcept { input, concept, concepts } => {
                write!(f, "input {input} names concept {concept}, and there are {concepts}")
            }
            M::DrivenInput { concept } => write!(f, "concept {concept} is an input and has an incoming edge"),
            M::InputRange { concept, low, high } => {
                write!(f, "input {concept}: low = {low} is not below high = {high}")
            }
            M::InputValue { concept, value, decimals } => {
                write!(f, "input {concept}: {} is outside [-1, 1]", Steps(*value, *decimals))
            }
            M::NoIntention => write!(f, "no concept is named kindness, threat or attack"),
            M::Fraction { parameter, thousandths } => {
                write!(f, "{parameter} = {thousandths} thousandths is above 1")
            }
            M::NoSteps => write!(f, "steps = 0: an inference needs at least one"),
        }
    }
}

impl core::error::Error for MapError {}
