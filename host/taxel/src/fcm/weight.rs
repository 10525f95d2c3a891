//! A causality value as written: a number or a linguistic term.

use super::terms::{self, Triangle};
use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// A weight of a map file.
#[derive(Debug, Clone, PartialEq)]
pub enum Weight {
    /// A number; -1 ..= 1 once the map is checked.
    Number(f64),
    /// A term of the [table](super::terms), such as `strong +`.
    Term(String),
}

impl Weight {
    /// Number of the weight.
    pub fn value(&self) -> f64 {
        match self {
            Weight::Number(value) => *value,
            // Terms are checked when they are read.
            Weight::Term(term) => terms::weight_of(term).unwrap_or_default().to_f64(),
        }
    }

    /// Fuzzy set of the weight.
    pub fn set(&self) -> Triangle {
        match self {
            Weight::Number(value) => Triangle::of_number(*value),
            Weight::Term(term) => Triangle::of_term(term).unwrap_or(Triangle::of_number(0.0)),
        }
    }
}

impl fmt::Display for Weight {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Weight::Number(value) => value.fmt(f),
            Weight::Term(term) => term.fmt(f),
        }
    }
}

impl Serialize for Weight {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Weight::Number(value) => serializer.serialize_f64(*value),
            Weight::Term(term) => serializer.serialize_str(term),
        }
    }
}

impl<'de> Deserialize<'de> for Weight {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Weight, D::Error> {
        deserializer.deserialize_any(WeightVisitor)
    }
}

/// Not derived as untagged: such an error would not say what is wrong.
struct WeightVisitor;

impl Visitor<'_> for WeightVisitor {
    type Value = Weight;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a number in -1 ..= 1 or a term ({})", terms::list())
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Weight, E> {
        Ok(Weight::Number(value))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Weight, E> {
        Ok(Weight::Number(value as f64))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Weight, E> {
        Ok(Weight::Number(value as f64))
    }

    fn visit_str<E: Error>(self, term: &str) -> Result<Weight, E> {
        let known = terms::weight_of(term).map(|_| Weight::Term(term.trim().into()));
        known.ok_or_else(|| E::custom(format!("{term:?} is not a weight: expected {}", terms::list())))
    }
}
