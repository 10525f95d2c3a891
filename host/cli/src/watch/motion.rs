//! Parses what bounds the motion of joints from the command line.

use anyhow::{Context, Result, bail};
use taxel::body::posture::Motion;

/// Parses `NAME=VALUE,...`: greatest accelerations `angular` (rad/s^2) and `linear` (m/s^2), the greatest
/// `angular_velocity` (rad/s) of joints that turn on and on, and errors of readings, `angular_error` (rad) and
/// `linear_error` (m). What is left out has its default.
pub fn motion(text: &str) -> Result<Motion> {
    let mut motion = Motion::default();
    for part in text.split(',').map(str::trim) {
        let (name, value) = part.split_once('=').with_context(|| format!("{part:?}: expected NAME=VALUE"))?;
        let place = match name.trim() {
            "angular" => &mut motion.angular,
            "linear" => &mut motion.linear,
            "angular_velocity" => &mut motion.angular_velocity,
            "angular_error" => &mut motion.angular_error,
            "linear_error" => &mut motion.linear_error,
            other => bail!(
                "{other:?} is none of angular, linear, angular_velocity, angular_error and linear_error"
            ),
        };
        let number = value.trim().parse().ok().filter(|number: &f64| number.is_finite() && *number >= 0.0);
        *place = number.with_context(|| format!("{name}: {value:?} is not a number of 0 or more"))?;
    }
    Ok(motion)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_out_has_its_default() {
        let told = motion("angular=12.5, linear_error=0.001").unwrap();
        assert_eq!(told, Motion { angular: 12.5, linear_error: 0.001, ..Motion::default() });
    }

    #[test]
    fn what_is_no_motion_is_refused_in_one_sentence() {
        for (text, why) in [
            ("", "\"\": expected NAME=VALUE"),
            ("angular", "\"angular\": expected NAME=VALUE"),
            (
                "speed=1",
                "\"speed\" is none of angular, linear, angular_velocity, angular_error and linear_error",
            ),
            ("linear=-1", "linear: \"-1\" is not a number of 0 or more"),
            ("linear=inf", "linear: \"inf\" is not a number of 0 or more"),
        ] {
            assert_eq!(motion(text).unwrap_err().to_string(), why);
        }
    }
}
