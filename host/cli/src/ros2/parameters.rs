//! Parameters of the node.

use ros2_client::{NodeOptions, ParameterValue};
use taxel::ros2::parameters::{CONCEPT_TIMEOUT_MS, IMAGE_HZ, SOURCE, TARE_FRAMES};

/// Values at the start.
#[derive(Debug, Clone)]
pub struct RosParameters {
    /// Short name of the source; it cannot be set.
    pub source: String,
    /// Images, points and forces of a panel per second; 0: none.
    pub image_hz: f64,
}

impl RosParameters {
    /// Declares them.
    pub fn declare(&self, options: NodeOptions) -> NodeOptions {
        let source = self.source.clone();
        options
            .declare_parameter(SOURCE, ParameterValue::String(self.source.clone()))
            .declare_parameter(IMAGE_HZ, ParameterValue::Double(self.image_hz))
            .declare_parameter(TARE_FRAMES, ParameterValue::Integer(64))
            .declare_parameter(CONCEPT_TIMEOUT_MS, ParameterValue::Integer(2000))
            .parameter_validator(Box::new(move |name, value| check(name, value, &source)))
    }
}

/// Checks a value. The node checks types and unknown names itself.
fn check(name: &str, value: &ParameterValue, source: &str) -> Result<(), String> {
    let (is_good, must) = match (name, value) {
        (_, ParameterValue::NotSet) => (false, "cannot be removed"),
        (SOURCE, ParameterValue::String(text)) => (text == source, "cannot be set: start another node"),
        (IMAGE_HZ, ParameterValue::Double(hz)) => ((0.0..=1000.0).contains(hz), "must be 0 to 1000"),
        (TARE_FRAMES, ParameterValue::Integer(frames)) => ((1..=4096).contains(frames), "must be 1 to 4096"),
        (CONCEPT_TIMEOUT_MS, ParameterValue::Integer(ms)) => {
            ((0..=i64::from(u32::MAX)).contains(ms), "must be 0 (until the next value) to 4294967295")
        }
        _ => (true, ""),
    };
    if is_good { Ok(()) } else { Err(format!("{name} {must}")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_parameter_cannot_be_is_reported() {
        let checked = |name: &str, value| check(name, &value, "sim:pat");
        assert_eq!(checked(IMAGE_HZ, ParameterValue::Double(30.0)), Ok(()));
        assert_eq!(
            checked(IMAGE_HZ, ParameterValue::Double(f64::NAN)),
            Err("image_hz must be 0 to 1000".into())
        );
        assert_eq!(
            checked(TARE_FRAMES, ParameterValue::Integer(0)),
            Err("tare_frames must be 1 to 4096".into())
        );
        assert_eq!(checked(SOURCE, ParameterValue::String("sim:pat".into())), Ok(()));
        assert!(
            checked(SOURCE, ParameterValue::String("usb".into())).unwrap_err().contains("start another node")
        );
        assert_eq!(checked(IMAGE_HZ, ParameterValue::NotSet), Err("image_hz cannot be removed".into()));
    }
}
