//! What is known of how joints move and how they are read.

use crate::error::{Result, UsageError};

/// What bounds the errors of postures: how joints move, and how exactly they are read.
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
