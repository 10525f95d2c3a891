//! Commands to a robot, as messages that controllers take.

use super::cdr::Cdr;

/// Three numbers of a vector, then three of another.
type TwoVectors = [[f64; 3]; 2];

/// `control_msgs/msg/JointJog`: velocities of joints by name, rad/s or m/s, that hold for so many seconds.
pub fn joint_jog(us: u64, base: &str, names: &[&str], velocities: &[f64], seconds: f64) -> Vec<u8> {
    let named = Cdr::default().time(us).text(base).list(names, |cdr, name| cdr.text(name));
    named.u32(0).list(velocities, |cdr, velocity| cdr.f64(*velocity)).f64(seconds).finish()
}

/// `geometry_msgs/msg/TwistStamped`: m/s and rad/s; or `WrenchStamped`: N and N m. In the frame `base`.
pub fn two_vectors(us: u64, base: &str, vectors: TwoVectors) -> Vec<u8> {
    Cdr::default().time(us).text(base).f64s(vectors.concat()).finish()
}

/// `control_msgs/msg/SpeedScalingFactor`: 1 is full speed, 0 a pause.
pub fn speed_scaling(factor: f64) -> Vec<u8> {
    Cdr::default().f64(factor).finish()
}

/// `std_msgs/msg/Float64MultiArray` without a layout, as forward controllers take it.
pub fn velocities(velocities: &[f64]) -> Vec<u8> {
    Cdr::default().u32(0).u32(0).list(velocities, |cdr, velocity| cdr.f64(*velocity)).finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jog_has_names_no_displacements_velocities_and_a_duration() {
        let jog = joint_jog(1_500_000, "b", &["j"], &[0.5], 0.1);
        let expected = [
            &[0, 1, 0, 0][..],
            &[1, 0, 0, 0, 0, 101, 205, 29, 2, 0, 0, 0, b'b', 0, 0, 0],
            &[1, 0, 0, 0, 2, 0, 0, 0, b'j', 0, 0, 0],
            &[0, 0, 0, 0],
            &[1, 0, 0, 0, 0, 0, 0, 0],
            &0.5f64.to_le_bytes(),
            &0.1f64.to_le_bytes(),
        ];
        // A float64 is aligned to 8 bytes: the list's length ends at 36, and 4 are left free.
        assert_eq!(jog, expected.concat());
    }
}
