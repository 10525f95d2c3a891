//! Led by hand.

use super::rig::{LIFTED, Rig};
use taxel::motion::MotionDeed;
use taxel_core::intent::Leading;

#[test]
fn a_hand_leads_after_a_while_and_leaves_the_arm_at_rest() {
    let mut rig = Rig::armed("people", &LIFTED);
    rig.touches = vec![rig.touch(1, "left_forearm", [0.03, 0.0, -0.2], [1.0, 0.0, 0.0], 4.0)];
    let command = rig.run(0.29);
    // It waits for the hand, and stands still meanwhile.
    assert!(!command.moves() && command.speed == Some(0.0));
    let command = rig.run(1.4);
    assert_eq!(command.deed, MotionDeed::Yield);
    let velocity = rig.velocity(&rig.touches[0], &command.velocities);
    let (_, normal) = rig.in_base(&rig.touches[0]);
    // 4 N through a damping of 16 N s/m.
    assert!((0.2..=0.25).contains(&velocity.length()), "{}", velocity.length());
    // The mass lags behind the normal, which turns with the link.
    let lag = velocity.angle_between(-normal).to_degrees();
    assert!(lag < 15.0, "{lag} degrees");
    let touch = rig.touches.remove(0);
    let command = rig.run(0.2);
    let speed = rig.velocity(&touch, &command.velocities).length();
    assert!(speed < 0.005, "{speed} m/s after 0.2 s");
    assert!(!rig.run(0.2).moves());
    assert!(rig.most.iter().all(|share| *share <= 1.0 + 1e-9), "{:?}", rig.most);
}

#[test]
fn pats_do_not_move_it() {
    let mut rig = Rig::armed("people", &LIFTED);
    rig.leading = Leading::Kindness;
    for pat in 0..10 {
        // Also if a number is used again.
        rig.touches = vec![rig.touch(pat / 2, "left_forearm", [0.03, 0.0, -0.2], [1.0, 0.0, 0.0], 9.0)];
        assert!(!rig.run(0.2).moves());
        rig.touches.clear();
        assert!(!rig.run(0.2).moves());
    }
}

#[test]
fn a_retreat_goes_before_a_hand_that_leads() {
    let mut rig = Rig::armed("people", &LIFTED);
    let hand = rig.touch(1, "left_forearm", [0.0, 0.03, -0.2], [0.0, 1.0, 0.0], 6.0);
    rig.touches = vec![hand.clone()];
    assert_eq!(rig.run(0.5).deed, MotionDeed::Yield);
    let press = rig.touch(2, "left_forearm", [0.03, 0.0, -0.1], [1.0, 0.0, 0.0], 45.0);
    rig.touches = vec![hand, press];
    let command = rig.run(0.1);
    assert_eq!(command.deed, MotionDeed::Retreat);
    let (_, normal) = rig.in_base(&rig.touches[1]);
    let velocity = rig.velocity(&rig.touches[1], &command.velocities);
    assert!(velocity.angle_between(-normal).to_degrees() < 15.0, "{velocity} {normal}");
    assert!(velocity.length() > 0.2, "{velocity}");
}
