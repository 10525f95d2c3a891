//! Reads and checks scripts. Errors are one sentence that names the key.

use super::error::ScriptError;
use super::script::{Joint, Script};
use super::touch::Touch;
use super::trace::Trace;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// Latest time in a script, s.
const LONGEST_S: f64 = 86_400.0;
/// Largest footprint, mm.
const LARGEST_MM: f64 = 1_000.0;
/// Greatest force, N.
const MOST_N: f64 = 10_000.0;
/// Places on a panel, taxels or mm.
const PLACES: RangeInclusive<f64> = -1e5..=1e5;
/// Largest count: far above a converter's range, small enough for an `f32`.
const MOST_COUNTS: f64 = 1e6;

impl FromStr for Script {
    type Err = ScriptError;

    /// Reads and checks a script; without a name in the text it has none.
    fn from_str(text: &str) -> Result<Script, ScriptError> {
        let script: Script = toml::from_str(text)?;
        script.check()?;
        Ok(script)
    }
}

impl Script {
    /// Checks every number; errors name the key.
    pub fn check(&self) -> Result<(), ScriptError> {
        within("duration_s", self.duration_s, 0.0..=LONGEST_S)?;
        let idle = &self.idle;
        within("idle.base_code", idle.base_code, 0.0..=MOST_COUNTS)?;
        within("idle.spread_counts", idle.spread_counts, 0.0..=MOST_COUNTS)?;
        within("idle.noise_counts", idle.noise_counts, 0.0..=MOST_COUNTS)?;
        within("idle.drift_counts_per_s", idle.drift_counts_per_s, -MOST_COUNTS..=MOST_COUNTS)?;
        within("faults.from_s", self.faults.from_s, 0.0..=LONGEST_S)?;
        within("wiring.source_kohm", self.wiring.source_kohm, 0.0..=1e6)?;
        within("wiring.line_pf", self.wiring.line_pf, 0.0..=1e6)?;
        within("wiring.crosstalk", self.wiring.crosstalk, 0.0..=1.0)?;
        within("converter.noise_counts", self.converter.noise_counts, 0.0..=MOST_COUNTS)?;
        within("sensor.gain_spread", self.sensor.gain_spread, 0.0..=0.2)?;
        within("sensor.hysteresis", self.sensor.hysteresis, 0.0..=1.0)?;
        within("sensor.noise", self.sensor.noise, 0.0..=1.0)?;
        within("sensor.half_n", self.sensor.half_n, 0.0..=10_000.0)?;
        for (index, touch) in self.touches.iter().enumerate() {
            check_touch(touch).map_err(|error| error.inside(format_args!("touch {}", index + 1)))?;
        }
        for (index, trace) in self.traces.iter().enumerate() {
            check_trace(trace).map_err(|error| error.inside(format_args!("trace {}", index + 1)))?;
        }
        for (index, joint) in self.joints.iter().enumerate() {
            check_joint(joint).map_err(|error| error.inside(format_args!("joint {}", index + 1)))?;
        }
        Ok(())
    }
}

fn check_touch(touch: &Touch) -> Result<(), ScriptError> {
    within("force_n", touch.force_n, 0.0..=MOST_N)?;
    for (key, point) in [("at", touch.at), ("at_mm", touch.at_mm)] {
        for value in point.into_iter().flatten() {
            within(key, value, PLACES)?;
        }
    }
    if touch.at.is_some() == touch.at_mm.is_some() {
        return Err(ScriptError::value("at", "give either `at` or `at_mm`"));
    }
    for size in touch.size() {
        within("size_mm", size, 1.0..=LARGEST_MM)?;
    }
    within("angle_deg", touch.angle_deg, -360.0..=360.0)?;
    within("start_s", touch.start_s, 0.0..=LONGEST_S)?;
    within("rise_s", touch.rise_s, 0.0..=LONGEST_S)?;
    within("hold_s", touch.hold_s, 0.0..=LONGEST_S)?;
    within("fall_s", touch.fall_s, 0.0..=LONGEST_S)?;
    for value in touch.velocity {
        within("velocity", value, -1e4..=1e4)?;
    }
    if touch.levels.is_empty() {
        return Err(ScriptError::value("levels", "`levels` must name at least one level"));
    }
    for level in &touch.levels {
        within("levels", *level, 0.0..=1.0)?;
    }
    if touch.repeat < 1 {
        return Err(ScriptError::value("repeat", "`repeat` must be at least 1"));
    }
    if let Some(period) = touch.period_s {
        within("period_s", period, 0.0..=LONGEST_S)?;
        let once = touch.once_s();
        if period < once {
            let text = format!("`period_s` must be at least the length of one touch, {once} s");
            return Err(ScriptError::value("period_s", text));
        }
    }
    within("repeat", touch.end_s(), 0.0..=LONGEST_S)
        .map_err(|error| error.inside("the last repetition ends too late"))
}

fn check_trace(trace: &Trace) -> Result<(), ScriptError> {
    for size in trace.size() {
        within("size_mm", size, 1.0..=LARGEST_MM)?;
    }
    within("angle_deg", trace.angle_deg, -360.0..=360.0)?;
    for [t, x, y, force] in &trace.path {
        within("path", *t, 0.0..=LONGEST_S)?;
        within("path", *x, PLACES)?;
        within("path", *y, PLACES)?;
        within("path", *force, 0.0..=MOST_N)?;
    }
    let knots = trace.knots();
    if knots.is_empty() || !knots.is_sorted_by(|one, next| one.t_ns < next.t_ns) {
        return Err(ScriptError::value("path", "`path` must list [t, x, y, N] with ascending times"));
    }
    Ok(())
}

fn check_joint(joint: &Joint) -> Result<(), ScriptError> {
    within("from_deg", joint.from_deg, -360.0..=360.0)?;
    within("to_deg", joint.to_deg, -360.0..=360.0)?;
    within("start_s", joint.start_s, 0.0..=LONGEST_S)?;
    within("rise_s", joint.rise_s, 0.0..=LONGEST_S)?;
    within("hold_s", joint.hold_s, 0.0..=LONGEST_S)?;
    within("fall_s", joint.fall_s.unwrap_or(0.0), 0.0..=LONGEST_S)
}

/// Checks the range of a value; refuses NaN, too.
fn within(key: &'static str, value: f64, range: RangeInclusive<f64>) -> Result<(), ScriptError> {
    if !range.contains(&value) {
        let text = format!("`{key}` is {value}, it must be {} to {}", range.start(), range.end());
        return Err(ScriptError::value(key, text));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str) -> String {
        let message = format!("{:#}", text.parse::<Script>().unwrap_err());
        assert!(!message.contains('\n'), "{message}");
        message
    }

    const TOUCH: &str = "duration_s = 1\n[[touch]]\npanel = \"back\"\nshape = \"palm\"\nforce_n = 8\nat = [8, 16]\nstart_s = 0.2\n";

    #[test]
    fn a_short_script_gets_the_defaults() {
        let script: Script = TOUCH.parse().unwrap();
        assert_eq!((script.name.as_str(), script.garment.as_str()), ("", "reference"));
        assert_eq!((script.tare_frames, script.seed), (16, 1));
        assert_eq!(script.idle, Default::default());
        assert!(script.wiring.is_ideal());
        let touch = &script.touches[0];
        assert_eq!(touch.size(), [100.0, 85.0]);
        assert_eq!((touch.repeat, touch.once_s()), (1, 0.1));
        let again: Script = toml::from_str(&toml::to_string(&script).unwrap()).unwrap();
        assert_eq!(again, script);
    }

    #[test]
    fn settings_of_the_deployment_are_handed_on_as_they_are() {
        let script: Script =
            "duration_s = 1\n[scene]\nrate = 3\n[scene.contact]\nlow = 12\n".parse().unwrap();
        assert_eq!(script.scene["contact"]["low"].as_integer(), Some(12));
    }

    #[test]
    fn numbers_are_checked() {
        let of = |line: &str| error(&format!("{TOUCH}{line}\n"));
        assert_eq!(of("hold_s = -1"), "touch 1: `hold_s` is -1, it must be 0 to 86400");
        assert_eq!(of("hold_s = nan"), "touch 1: `hold_s` is NaN, it must be 0 to 86400");
        assert_eq!(of("size_mm = [20, 0]"), "touch 1: `size_mm` is 0, it must be 1 to 1000");
        assert_eq!(of("at_mm = [1, 2]"), "touch 1: give either `at` or `at_mm`");
        assert!(of("repeat = 2\nperiod_s = 0.01").contains("`period_s` must be at least"));
        assert!(of("repeat = 4000000000").contains("the last repetition ends too late"));
    }

    #[test]
    fn paths_are_checked() {
        let of = |path: &str| {
            error(&format!("duration_s = 1\n[[trace]]\npanel = \"back\"\nshape = \"palm\"\npath = {path}\n"))
        };
        let order = "trace 1: `path` must list [t, x, y, N] with ascending times";
        assert_eq!([of("[]"), of("[[1, 2, 3, 4], [1, 2, 3, 4]]")], [order, order]);
        assert_eq!(of("[[-1, 2, 3, 4]]"), "trace 1: `path` is -1, it must be 0 to 86400");
        assert_eq!(of("[[1, 2, nan, 4]]"), "trace 1: `path` is NaN, it must be -100000 to 100000");
        assert_eq!(of("[[1, 2, 3, 20000]]"), "trace 1: `path` is 20000, it must be 0 to 10000");
        let short = "duration_s = 1\n[[trace]]\npanel = \"back\"\nshape = \"palm\"\npath = [[1, 2, 3]]\n";
        assert!(short.parse::<Script>().unwrap_err().to_string().contains("invalid length 3"));
    }
}
