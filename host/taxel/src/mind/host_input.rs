//! Values that others send a robot by name, and the positions of its joints, as lines.

use crate::error::{Result, UsageError};
#[cfg(feature = "schema")]
use crate::json::schema::{self, TypeIs};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use taxel_core::format::Q15;

/// Topic of what is reported in a recording, below `/taxel/`; also the type of its messages.
pub const HOST_INPUT: &str = "host_input";
/// Their schema, as [`host_input_schema`] derives it.
pub const HOST_INPUT_SCHEMA: &str = include_str!("../../schemas/messages/host_input.json");

/// A line of JSON:
///
/// `{"host_input": {"vision": 0.8}, "age_ms": 40}` or `{"positions": {"left_elbow": 0.5}}`
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HostInputLine {
    /// Values by name, -1 to 1.
    #[serde(default)]
    pub host_input: BTreeMap<String, f64>,
    /// Positions of joints by name, rad or m.
    #[serde(default)]
    pub positions: BTreeMap<String, f64>,
    /// Age of all of them, ms.
    #[serde(default)]
    pub age_ms: u32,
}

impl HostInputLine {
    /// Reads a line. Error if it is no such object.
    pub fn parse(line: &str) -> Result<HostInputLine> {
        serde_json::from_str(line).map_err(|error| {
            error!(
                UsageError::Argument,
                "no host input: {error}: {{\"host_input\": {{\"vision\": 0.8}}, \"age_ms\": 40}} is a line"
            )
        })
    }

    /// Host time of what is reported at a time of the host, us.
    pub fn from_us(&self, host_us: u64) -> u64 {
        host_us.saturating_sub(1000 * u64::from(self.age_ms))
    }

    /// Positions of joints by name, rad or m.
    pub fn joints(&self) -> impl Iterator<Item = (&str, f64)> + Clone {
        self.positions.iter().map(|(joint, at)| (joint.as_str(), *at))
    }
}

/// Input that others have sent the robot.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = TypeIs("host_input")))]
#[serde(tag = "type", rename = "host_input")]
pub struct HostInputMessage<'a> {
    /// Host time at which it was sent, us since 1970.
    pub host_time_us: u64,
    /// Values by name, -1 to 1.
    pub host_input: &'a BTreeMap<String, f64>,
    /// Positions of joints by name, rad or m.
    pub positions: &'a BTreeMap<String, f64>,
    /// Age of all of them then, ms.
    pub age_ms: u32,
}

impl<'a> HostInputMessage<'a> {
    /// The message of what was reported at a host time.
    pub fn of(line: &'a HostInputLine, host_time_us: u64) -> HostInputMessage<'a> {
        let HostInputLine { host_input, positions, age_ms } = line;
        HostInputMessage { host_time_us, host_input, positions, age_ms: *age_ms }
    }
}

/// The schema as the struct gives it: as programs for recordings want it, and as it is.
#[cfg(feature = "schema")]
pub fn host_input_schema() -> [serde_json::Value; 2] {
    [schema::plain::<HostInputMessage<'static>>(), schema::of::<HostInputMessage<'static>>()]
}

/// A value of -1 to 1 in units of 2^-15. Error, with its name, if it is outside.
pub fn fraction(name: &str, value: f64) -> Result<Q15> {
    require!((-1.0..=1.0).contains(&value), UsageError::Argument, "{name} is {value}, and must be -1 to 1");
    Ok(Q15((value * f64::from(Q15::ONE.0)).round() as i32))
}
