//! What others know: values that somebody tells a robot by name, and the positions of its joints, as lines.

use crate::error::{Result, UsageError};
use serde::Deserialize;
use std::collections::BTreeMap;
use taxel_core::format::Q15;

/// A line of JSON:
///
/// `{"told": {"vision": 0.8}, "age_ms": 40}` or `{"positions": {"left_elbow": 0.5}}`
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ToldLine {
    /// Values by name, -1 to 1.
    #[serde(default)]
    pub told: BTreeMap<String, f64>,
    /// Positions of joints by name, rad or m.
    #[serde(default)]
    pub positions: BTreeMap<String, f64>,
    /// Age of all of them, ms.
    #[serde(default)]
    pub age_ms: u32,
}

impl ToldLine {
    /// Reads a line. Error if it is no such object.
    pub fn parse(line: &str) -> Result<ToldLine> {
        serde_json::from_str(line).map_err(|error| {
            error!(
                UsageError::Argument,
                "nothing is told: {error}: {{\"told\": {{\"vision\": 0.8}}, \"age_ms\": 40}} is a line"
            )
        })
    }
}

/// A value of -1 to 1 in units of 2^-15. Error, with its name, if it is outside.
pub fn fraction(name: &str, value: f64) -> Result<Q15> {
    require!((-1.0..=1.0).contains(&value), UsageError::Argument, "{name} is {value}, and must be -1 to 1");
    Ok(Q15((value * f64::from(Q15::ONE.0)).round() as i32))
}
