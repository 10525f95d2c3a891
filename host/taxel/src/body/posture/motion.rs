//! Bounds on how joints move and how they are read.

use crate::error::{Result, UsageError};
use std::str::FromStr;

/// Bounds on the errors of postures: how joints move, and how exactly they are read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Greatest acceleration of joints that turn, rad/s^2.
    pub angular: f64,
    /// Greatest acceleration of joints that slide, m/s^2.
    pub linear: f64,
    /// Greatest velocity of joints that turn on and on, rad/s, where the URDF states none: they show no whole
    /// turns.
    pub angular_velocity: f64,
    /// Greatest error of an angle that is read, rad: that of the encoder, and of its time stamp times the
    /// velocity.
    pub angular_error: f64,
    /// Greatest error of a length that is read, m.
    pub linear_error: f64,
}

impl Default for Motion {
    /// An arm among people: 20 rad/s^2, 5 m/s^2 and 10 rad/s, read without an error.
    fn default() -> Motion {
        Motion { angular: 20.0, linear: 5.0, angular_velocity: 10.0, angular_error: 0.0, linear_error: 0.0 }
    }
}

impl Motion {
    /// Checks that each number is finite and not negative.
    pub(super) fn check(&self) -> Result<()> {
        let Motion { angular, linear, angular_velocity, angular_error, linear_error } = *self;
        let named = [
            ("angular", angular),
            ("linear", linear),
            ("angular_velocity", angular_velocity),
            ("angular_error", angular_error),
            ("linear_error", linear_error),
        ];
        for (name, number) in named {
            require!(
                number.is_finite() && number >= 0.0,
                UsageError::Argument,
                "`{name}` of the motion must be 0 or more, not {number}"
            );
        }
        Ok(())
    }
}

impl FromStr for Motion {
    type Err = UsageError;

    /// Reads `NAME=VALUE,...`, by the names of the fields. What is left out has its default.
    fn from_str(text: &str) -> Result<Motion, UsageError> {
        let mut motion = Motion::default();
        for part in text.split(',').map(str::trim) {
            let wrong = |what: &str| UsageError::Argument(format!("{part:?}{what}"));
            let (name, value) = part.split_once('=').ok_or_else(|| wrong(": expected NAME=VALUE"))?;
            let place = match name.trim() {
                "angular" => &mut motion.angular,
                "linear" => &mut motion.linear,
                "angular_velocity" => &mut motion.angular_velocity,
                "angular_error" => &mut motion.angular_error,
                "linear_error" => &mut motion.linear_error,
                _ => {
                    let known = "angular, linear, angular_velocity, angular_error or linear_error";
                    return Err(wrong(&format!(": the name must be {known}")));
                }
            };
            let number =
                value.trim().parse().ok().filter(|number: &f64| number.is_finite() && *number >= 0.0);
            *place = number.ok_or_else(|| wrong(": the value must be a number of 0 or more"))?;
        }
        Ok(motion)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_out_has_its_default() {
        let parsed: Motion = "angular=12.5, linear_error=0.001".parse().unwrap();
        assert_eq!(parsed, Motion { angular: 12.5, linear_error: 0.001, ..Motion::default() });
    }

    #[test]
    fn what_is_no_motion_is_refused_in_one_sentence() {
        let known = "angular, linear, angular_velocity, angular_error or linear_error";
        for (text, why) in [
            ("", "\"\": expected NAME=VALUE"),
            ("angular", "\"angular\": expected NAME=VALUE"),
            ("speed=1", &format!("\"speed=1\": the name must be {known}")),
            ("linear=-1", "\"linear=-1\": the value must be a number of 0 or more"),
            ("linear=inf", "\"linear=inf\": the value must be a number of 0 or more"),
        ] {
            assert_eq!(text.parse::<Motion>().unwrap_err().to_string(), why);
        }
    }
}
