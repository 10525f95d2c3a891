//! Fuzzy memberships of inputs: their forms in a map file, and the ramps of the board that they become.
//!
//! | form | activation |
//! |---|---|
//! | `rise = [a, b]` | `at[0]` up to a, `at[1]` from b on |
//! | `fall = [a, b]` | `at[1]` up to a, `at[0]` from b on |
//! | `triangle = [a, b, c]` | `at[0]` outside a ..= c, `at[1]` at b |
//! | `trapezoid = [a, b, c, d]` | `at[0]` outside a ..= d, `at[1]` in b ..= c |
//!
//! `at` defaults to `[0, 1]`; activations are linear between the points. Points are in the unit of the
//! source. Triangle and trapezoid become two inputs of the board, whose activations add up.

use super::robot_source::{RobotInput, RobotSource};
use super::steps::steps;
use crate::error::{MapFileError, Result};
use serde::{Deserialize, Serialize};
use taxel_core::intent::{Leading, MapInput, Source};

/// An input of a map file: exactly one of the four forms.
#[derive(Debug, Default, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InputFile {
    /// Name of the concept.
    pub concept: String,
    /// Source of the value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<Source>,
    /// Source of the value that only a robot of several boards knows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robot: Option<RobotSource>,
    /// With `robot`: age from which a value no longer counts, ms; never if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timeout_ms: Option<u32>,
    /// With `robot`: value that counts then, and while there is none; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub default: Option<i32>,
    /// Increases from the first point to the second.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rise: Option<[i32; 2]>,
    /// Decreases from the first point to the second.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fall: Option<[i32; 2]>,
    /// Greatest at the second of three points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub triangle: Option<[i32; 3]>,
    /// Greatest between the second and the third of four points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub trapezoid: Option<[i32; 4]>,
    /// Activation without and with full membership.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<[f64; 2]>,
    /// Note of the author.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub note: String,
}

/// A ramp: its two points, and its two activations in decimal steps.
type Ramp = ([i32; 2], [i16; 2]);

impl InputFile {
    /// One or two ramps for the concept with number `concept`, activations in steps of 10^-`decimals`. What
    /// only a robot knows is fed by the host, into this slot.
    pub fn inputs(&self, concept: u8, decimals: u32, slot: u8) -> Result<Vec<MapInput>> {
        let name = &self.concept;
        let source = match (self.source, &self.robot) {
            (Some(source), None) => source,
            (None, Some(_)) => Source::Host(slot),
            (None, None) => fail!(MapFileError::Malformed, "input {name}: source is missing"),
            (Some(_), Some(_)) => {
                fail!(MapFileError::Malformed, "input {name}: give either source or robot")
            }
        };
        if self.robot == Some(RobotSource::Intent(Leading::None)) {
            fail!(MapFileError::Malformed, "input {name}: no board's intention is none");
        }
        if self.robot.is_none() && (self.timeout_ms.is_some() || self.default.is_some()) {
            fail!(
                MapFileError::Malformed,
                "input {name}: timeout_ms and default are for what a robot knows (robot)"
            );
        }
        let ramps = self.ramps(decimals)?;
        let input =
            |([low, high], [at_low, at_high]): Ramp| MapInput { concept, source, low, high, at_low, at_high };
        Ok(ramps.into_iter().map(input).collect())
    }

    /// Returns what it hears of a robot, if it does.
    pub fn of_robot(&self) -> Option<RobotInput> {
        Some(RobotInput {
            concept: self.concept.clone(),
            source: self.robot.clone()?,
            timeout_ms: self.timeout_ms,
            default: self.default.unwrap_or(0),
        })
    }

    fn ramps(&self, decimals: u32) -> Result<Vec<Ramp>> {
        let InputFile { rise, fall, triangle, trapezoid, .. } = self;
        let name = &self.concept;
        let [out, full] = self.at.unwrap_or([0.0, 1.0]);
        let at = |value| steps(value, decimals, || format!("input {name}: at"));
        let (out, full) = (at(out)?, at(full)?);
        let hill = |[a, b, c, d]: [i32; 4]| {
            if i32::from(full).abs_diff(out.into()) > 10u32.pow(decimals) {
                fail!(
                    MapFileError::Malformed,
                    "input {name}: the two activations of a triangle or trapezoid differ by more than 1"
                );
            }
            Ok(vec![([a, b], [out, full]), ([c, d], [0, out - full])])
        };
        let ramps = match (rise, fall, triangle, trapezoid) {
            (Some(points), None, None, None) => vec![(*points, [out, full])],
            (None, Some(points), None, None) => vec![(*points, [full, out])],
            (None, None, Some([a, b, c]), None) => hill([*a, *b, *b, *c])?,
            (None, None, None, Some(points)) => hill(*points)?,
            _ => fail!(
                MapFileError::Malformed,
                "input {name}: give exactly one of rise, fall, triangle and trapezoid"
            ),
        };
        let falls = |points: &[i32]| points.windows(2).any(|pair| pair[0] > pair[1]);
        let points: Vec<i32> = ramps.iter().flat_map(|(points, _)| *points).collect();
        if falls(&points) || ramps.iter().any(|([low, high], _)| low == high) {
            fail!(MapFileError::Malformed, "input {name}: the points {points:?} do not rise");
        }
        Ok(ramps)
    }

    /// Form of the ramps of one concept, in steps of 10^-`decimals`; two ramps that form a hill become one
    /// input.
    pub fn of(concept: &str, inputs: &[&MapInput], decimals: u8) -> Vec<InputFile> {
        let step = 10f64.powi(decimals.into());
        let decimal = |steps: i16| f64::from(steps) / step;
        let at = |out, full| Some([decimal(out), decimal(full)]).filter(|at| *at != [0.0, 1.0]);
        let blank =
            |source| InputFile { concept: concept.into(), source: Some(source), ..InputFile::default() };
        match inputs {
            [up, down]
                if up.source == down.source
                    && up.high <= down.low
                    && down.at_low == 0
                    && i32::from(down.at_high) == i32::from(up.at_low) - i32::from(up.at_high) =>
            {
                let form = blank(up.source);
                let at = at(up.at_low, up.at_high);
                vec![match up.high == down.low {
                    true => InputFile { triangle: Some([up.low, up.high, down.high]), at, ..form },
                    false => {
                        InputFile { trapezoid: Some([up.low, up.high, down.low, down.high]), at, ..form }
                    }
                }]
            }
            ramps => (ramps.iter())
                .map(|i| InputFile {
                    rise: Some([i.low, i.high]),
                    at: at(i.at_low, i.at_high),
                    ..blank(i.source)
                })
                .collect(),
        }
    }
}
