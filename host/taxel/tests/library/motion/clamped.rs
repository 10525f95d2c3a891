//! Two touches that oppose each other, and the energy that commands may give.

use super::rig::{CYCLE_US, LIFTED, Rig};
use taxel::mind::Mover;
use taxel::motion::MotionDeed;

#[test]
fn an_arm_between_two_things_stands_still_and_says_so() {
    let mut rig = Rig::armed("people", &LIFTED);
    let front = rig.touch(1, "left_forearm", [0.03, 0.0, -0.15], [1.0, 0.0, 0.0], 40.0);
    let back = rig.touch(2, "left_forearm", [-0.03, 0.0, -0.15], [-1.0, 0.0, 0.0], 10.0);
    rig.touches = vec![front.clone()];
    assert!(rig.run(0.1).moves());
    rig.touches = vec![front.clone(), back];
    // At once: there is no positive work on either from the first cycle on.
    let command = rig.cycle();
    assert!(!command.moves() && command.deed == MotionDeed::Clamped && command.speed == Some(0.0));
    assert!(!rig.run(1.0).moves());
    // One of them lets go: after 0.3 s it moves away from the other.
    rig.touches = vec![front];
    assert!(!rig.run(0.25).moves());
    assert!(rig.run(0.2).moves());
}

#[test]
fn a_hand_in_the_crook_of_an_arm_is_clamped() {
    let mut rig = Rig::armed("people", &[("left_elbow", 2.5)]);
    let inside = |rig: &Rig, touch, link, at| rig.touch(touch, link, at, [1.0, 0.0, 0.0], 8.0);
    rig.touches = vec![
        inside(&rig, 1, "left_upper_arm", [0.036, 0.0, -0.25]),
        inside(&rig, 2, "left_forearm", [0.03, 0.0, -0.08]),
    ];
    // The robot itself has closed it.
    rig.touches.iter_mut().for_each(|touch| touch.mover = Mover::Own);
    assert_eq!(rig.cycle().deed, MotionDeed::Clamped);
}

#[test]
fn what_the_robot_does_to_itself_is_not_clamped() {
    let mut rig = Rig::armed("people", &[("left_elbow", 2.5)]);
    let inside = rig.touch(1, "left_upper_arm", [0.036, 0.0, -0.25], [1.0, 0.0, 0.0], 8.0);
    let (at, normal) = rig.in_base(&inside);
    let pose = rig
        .control
        .robot()
        .poses(&rig.positions)
        .of(rig.touch(2, "left_forearm", [0.0; 3], [1.0, 0.0, 0.0], 0.0).link, 0)
        .unwrap()
        .inverse();
    let (at, normal) = (pose.point(at), pose.direction(-normal));
    let other = rig.touch(2, "left_forearm", at.to_array(), normal.to_array(), 8.0);
    rig.touches = vec![inside, other];
    rig.touches.iter_mut().for_each(|touch| touch.mover = Mover::Own);
    assert_eq!(rig.cycle().deed, MotionDeed::Slow);
    rig.touches[0].mover = Mover::Other;
    assert_eq!(rig.cycle().deed, MotionDeed::Clamped);
}

#[test]
fn the_tank_bounds_the_work_on_what_touches() {
    // A press on the forearm is left through one on the upper arm, which is not opposed to it.
    let behaviour =
        "name = \"x\"\ntank_j = 0.2\nclamp.cosine = -1\n[[when]]\npart = [\"forearm\"]\ndo = \"retreat\"\n";
    let mut rig = Rig::armed(behaviour, &LIFTED);
    let (mut given, mut absorbed, mut emptied) = (0.0, 0.0, false);
    for cycle in 0..400 {
        rig.touches = vec![
            rig.touch(1, "left_forearm", [0.03, 0.0, -0.2], [1.0, 0.0, 0.0], 3.0),
            rig.touch(2, "left_upper_arm", [-0.04, 0.0, -0.3], [-1.0, 0.3, 0.0], 30.0 + f64::from(cycle % 7)),
        ];
        let powers: Vec<(f64, f64)> = {
            let command = rig.cycle();
            emptied |= command.share < 1.0;
            let each = rig.touches.iter().map(|touch| {
                let (_, normal) = rig.in_base(touch);
                let power = touch.newtons * normal.dot(rig.velocity(touch, &command.velocities));
                (power.max(0.0), (-power).max(0.0))
            });
            each.collect()
        };
        let seconds = CYCLE_US as f64 * 1e-6;
        given += powers.iter().map(|it| it.0 * seconds).sum::<f64>();
        absorbed += powers.iter().map(|it| it.1 * seconds).sum::<f64>();
    }
    assert!(emptied, "given {given}, absorbed {absorbed}");
    // Postures change within a cycle: a hundredth of it is not accounted for.
    assert!(given <= 1.01 * (0.2 + absorbed), "{given} {absorbed}");
}
