//! Motion away from what presses.

use super::rig::{LIFTED, Rig};
use taxel::mind::Mover;
use taxel::motion::{MotionDeed, TouchAction};
use taxel_core::intent::Leading;

#[test]
fn a_hard_press_is_left_along_its_normal_by_the_joints_above() {
    let mut rig = Rig::armed("people", &LIFTED);
    rig.touches = vec![rig.touch(1, "left_forearm", [0.03, 0.0, -0.15], [1.0, 0.2, 0.0], 40.0)];
    for _ in 0..30 {
        let command = rig.cycle();
        assert_eq!((command.deed, command.speed), (MotionDeed::Retreat, Some(0.0)));
        let (_, normal) = rig.in_base(&rig.touches[0]);
        let velocity = rig.velocity(&rig.touches[0], &command.velocities);
        assert!(velocity.angle_between(-normal).to_degrees() < 15.0, "{velocity} {normal}");
        assert_eq!((command.causes[0].action, command.causes[0].row), (TouchAction::Retreat, None));
        for (joint, velocity) in rig.control.robot().free().iter().zip(&command.velocities) {
            let name = &rig.control.robot().joints()[*joint].name;
            assert!(!name.starts_with("right") || *velocity == 0.0, "{name}");
        }
    }
    assert!(rig.most.iter().all(|share| *share <= 1.0 + 1e-9), "{:?}", rig.most);
    // It goes on for 0.3 s after the touch, then brakes, waits, and leaves the robot to itself.
    rig.touches.clear();
    assert!(rig.run(0.25).moves());
    assert!(!rig.run(0.3).moves());
    assert_eq!(rig.cycle().deed, MotionDeed::Resume);
    assert_eq!(rig.run(0.4).speed, Some(0.0), "it waits for a second");
    assert_eq!(rig.run(1.5).deed, MotionDeed::Free);
}

#[test]
fn a_blow_is_left_once_it_is_understood() {
    let mut rig = Rig::armed("people", &LIFTED);
    rig.touches = vec![rig.touch(1, "left_forearm", [0.03, 0.0, -0.15], [1.0, 0.0, 0.0], 18.0)];
    rig.run(0.05);
    rig.touches.clear();
    assert!(!rig.run(0.2).moves());
    rig.leading = Leading::Attack;
    let command = rig.run(0.02);
    assert!(command.moves() && command.deed == MotionDeed::Retreat && command.causes[0].row == Some(0));
    // Once, however long the word is held.
    assert!(!rig.run(0.45).moves());
}

#[test]
fn where_no_direction_is_free_it_does_what_it_can() {
    // The torso only turns about the vertical: a press on its side turns it, one along the radius does nothing.
    let mut rig = Rig::armed("people", &[]);
    rig.touches = vec![rig.touch(1, "torso", [0.06, 0.08, 0.2], [1.0, 0.3, 0.0], 40.0)];
    let command = rig.run(0.2);
    let (_, normal) = rig.in_base(&rig.touches[0]);
    assert!(command.moves() && rig.velocity(&rig.touches[0], &command.velocities).dot(normal) < 0.0);
    let mut rig = Rig::armed("people", &[]);
    rig.touches = vec![rig.touch(1, "base_link", [0.0, 0.0, 0.1], [1.0, 0.0, 0.0], 40.0)];
    assert!(!rig.run(0.2).moves());
}

#[test]
fn no_joint_passes_its_limits() {
    // Pushed towards the elbow's limit for as long as it likes.
    let mut rig = Rig::armed("people", &[("left_elbow", 0.3), ("left_shoulder_pitch", 0.5)]);
    rig.old_us = 20_000;
    for normal in [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]] {
        rig.touches = vec![rig.touch(1, "left_forearm", [0.0, 0.0, -0.2], normal, 45.0)];
        for _ in 0..600 {
            rig.cycle();
            rig.control.robot().check(&rig.positions).unwrap();
        }
    }
    assert!(rig.most[0] <= 1.0 + 1e-9, "{:?}", rig.most);
}

#[test]
fn a_joint_that_may_not_move_does_not() {
    let mut rig =
        Rig::armed("name = \"x\"\n[joint.left_elbow]\nmoves = false\n[[when]]\ndo = \"retreat\"\n", &LIFTED);
    rig.touches = vec![rig.touch(1, "left_forearm", [0.03, 0.0, -0.15], [1.0, 0.0, 0.0], 5.0)];
    let command = rig.run(0.2);
    let elbow = rig
        .control
        .robot()
        .free()
        .iter()
        .position(|joint| rig.control.robot().joints()[*joint].name == "left_elbow");
    assert!(command.moves() && command.velocities[elbow.unwrap()] == 0.0);
}

#[test]
fn links_that_are_kept_apart_do_not_meet() {
    let apart = "name = \"x\"\n[[when]]\ndo = \"retreat\"\n[[apart]]\nlinks = [\"left_forearm\", \"torso\"]\nmetres = 0.12\n";
    let lowest = |behaviour: &str| {
        let mut rig = Rig::armed(behaviour, &[("left_shoulder_roll", 0.5), ("left_elbow", 0.4)]);
        rig.touches = vec![rig.touch(1, "left_forearm", [0.0, 0.03, -0.2], [0.0, 1.0, 0.0], 20.0)];
        let mut lowest = f64::MAX;
        for _ in 0..800 {
            rig.cycle();
            // The torso's line is the z axis.
            let pose = rig.control.robot().poses(&rig.positions).of(rig.touches[0].link, 0).unwrap();
            let hand = pose.point(taxel::body::DVec3::new(0.0, 0.0, -0.26));
            lowest = lowest.min(hand.truncate().length()).min(pose.at.truncate().length());
        }
        lowest
    };
    assert!(lowest("name = \"x\"\n[[when]]\ndo = \"retreat\"\n") < 0.1);
    assert!(lowest(apart) > 0.115, "{}", lowest(apart));
}

#[test]
fn what_it_bumps_into_stops_it_and_what_it_brushes_slows_it() {
    let mut rig = Rig::armed("people", &LIFTED);
    rig.touches = vec![rig.touch(1, "left_forearm", [0.03, 0.0, -0.15], [1.0, 0.0, 0.0], 5.0)];
    rig.touches[0].mover = Mover::Own;
    let command = rig.cycle();
    assert_eq!((command.deed, command.speed), (MotionDeed::Slow, Some(0.3)));
    rig.touches[0].newtons = 20.0;
    let command = rig.cycle();
    assert_eq!((command.deed, command.speed), (MotionDeed::Stop, Some(0.0)));
    assert!(!command.moves());
}
