//! Jacobians against differences of poses, on robots with joints of all kinds.

use crate::random::Noise;
use taxel::body::DVec3;
use taxel::body::robot;

const MIMICS: &str = r#"<robot name="r"><link name="base"/>
<joint name="lift" type="prismatic"><parent link="base"/><child link="a"/><origin xyz="0 0.1 0.2" rpy="0.3 0 0.1"/>
  <axis xyz="1 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint><link name="a"/>
<joint name="turn" type="continuous"><parent link="a"/><child link="b"/><origin xyz="0.3 0 0"/><axis xyz="0 0 1"/></joint>
<link name="b"/>
<joint name="follow" type="revolute"><parent link="b"/><child link="c"/><origin xyz="0 0.2 0" rpy="0 0.5 0"/>
  <axis xyz="0 1 0"/><limit lower="-9" upper="9" effort="1" velocity="1"/><mimic joint="turn" multiplier="-2" offset="0.1"/></joint>
<link name="c"/>
<joint name="beside" type="revolute"><parent link="a"/><child link="d"/><axis xyz="0 1 0"/>
  <limit lower="-9" upper="9" effort="1" velocity="1"/></joint><link name="d"/></robot>"#;

#[test]
fn a_jacobian_is_the_change_of_a_place_with_each_joint() {
    let mut noise = Noise(3);
    for robot in [robot::read("reference").unwrap(), robot::parse("mimics.urdf", MIMICS).unwrap()] {
        for _ in 0..50 {
            let posture: Vec<f64> = robot.free().iter().map(|_| noise.range(-0.9, 0.9)).collect();
            let at = DVec3::new(noise.range(-0.2, 0.2), noise.range(-0.2, 0.2), noise.range(-0.2, 0.2));
            for link in 0..robot.links().len() {
                let place = |posture: &[f64]| robot.poses(posture).of(link, 0).unwrap().point(at);
                let columns = robot.jacobian(&robot.poses(&posture), link, place(&posture));
                for (joint, column) in columns.iter().enumerate() {
                    let moved = |by: f64| {
                        let mut moved = posture.clone();
                        moved[joint] += by;
                        place(&moved)
                    };
                    let change = (moved(1e-5) - moved(-1e-5)) / 2e-5;
                    assert!(
                        (*column - change).length() < 1e-8,
                        "link {link}, joint {joint}: {column} {change}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_range_is_that_of_the_joints_that_mimic_too() {
    let robot = robot::parse("mimics.urdf", MIMICS).unwrap();
    let range = robot.range(1, 0.05).unwrap();
    assert!(
        (range.start() + 4.45 - 0.05).abs() < 1e-9 && (range.end() - 4.55 + 0.05).abs() < 1e-9,
        "{range:?}"
    );
    assert_eq!(robot.range(0, 3.0), Some(0.0..=0.0));
    assert_eq!(robot.range(2, 0.0), Some(-9.0..=9.0));
}
