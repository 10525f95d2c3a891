//! Faults: nothing is commanded, the robot stands still, and it says why.

use super::rig::{LIFTED, Rig};
use taxel::motion::{MotionDeed, MotionFault, MotionPhase};

/// A robot that is moving, and after this has happened stands still because of this.
fn stops(because: MotionFault, happens: impl FnOnce(&mut Rig)) {
    let mut rig = Rig::armed("people", &LIFTED);
    rig.touches = vec![rig.touch(1, "left_forearm", [0.03, 0.0, -0.15], [1.0, 0.0, 0.0], 40.0)];
    assert!(rig.run(0.1).moves());
    rig.now_us += 5000;
    rig.boards[0].scanned_us = Some(rig.now_us);
    happens(&mut rig);
    let command = rig.look();
    assert_eq!(command.fault, Some(because));
    assert_eq!(
        (command.phase, command.deed, command.speed),
        (MotionPhase::Stopped, MotionDeed::Stop, Some(0.0))
    );
    assert!(!command.moves() && rig.state.count(because) == 1, "{because:?}");
    // Only arming it anew moves it again.
    rig.now_us = rig.now_us.max(2_000_000);
    (rig.old_us, rig.positions) = (0, rig.control.robot().posture(LIFTED).unwrap());
    rig.boards.truncate(1);
    (rig.boards[0].scanned_us, rig.boards[0].is_calibrated) = (Some(rig.now_us), true);
    rig.touches = vec![rig.touch(1, "left_forearm", [0.03, 0.0, -0.15], [1.0, 0.0, 0.0], 40.0)];
    for _ in 0..20 {
        assert!(!rig.cycle().moves());
    }
    rig.arm().unwrap();
    assert!(rig.run(0.1).moves());
    assert_eq!(MotionFault::ALL.map(|fault| rig.state.count(fault)).iter().sum::<u64>(), 1);
}

#[test]
fn a_posture_of_more_than_50_ms_stops_it() {
    stops(MotionFault::StalePosture, |rig| {
        // Joint states come no more.
        rig.old_us = 5000;
        for _ in 0..10 {
            assert!(rig.look().moves());
            rig.now_us += 5000;
            rig.old_us += 5000;
            rig.boards[0].scanned_us = Some(rig.now_us);
        }
    });
    let mut rig = Rig::armed("people", &LIFTED);
    rig.old_us = 4000;
    rig.cycle();
    rig.old_us = 8900;
    assert_eq!(rig.cycle().fault, None);
}

#[test]
fn what_is_not_a_number_stops_it() {
    stops(MotionFault::NotANumber, |rig| rig.positions[2] = f64::NAN);
    stops(MotionFault::NotANumber, |rig| rig.positions[0] = f64::INFINITY);
    stops(MotionFault::NotANumber, |rig| _ = rig.positions.pop());
    stops(MotionFault::NotANumber, |rig| rig.touches[0].newtons = f64::NAN);
    stops(MotionFault::NotANumber, |rig| rig.touches[0].at.x = f64::NAN);
    stops(MotionFault::NotANumber, |rig| rig.touches[0].normal *= 0.0);
}

#[test]
fn times_that_jump_stop_it() {
    stops(MotionFault::TimeJumps, |rig| rig.now_us -= 5001);
    stops(MotionFault::TimeJumps, |rig| rig.now_us -= 5000);
    stops(MotionFault::TimeJumps, |rig| rig.old_us = 10_000);
    stops(MotionFault::TimeJumps, |rig| rig.boards[0].scanned_us = Some(rig.now_us + 20_000));
    stops(MotionFault::TimeJumps, |rig| rig.boards[0].scanned_us = Some(rig.now_us - 15_000));
    stops(MotionFault::LateCycle, |rig| {
        rig.now_us += 50_000;
        rig.boards[0].scanned_us = Some(rig.now_us);
    });
}

#[test]
fn a_board_that_is_lost_or_another_stops_it() {
    stops(MotionFault::LostBoard, |rig| rig.boards[0].scanned_us = None);
    stops(MotionFault::OtherBoard, |rig| rig.boards[0].begun += 1);
    stops(MotionFault::Uncalibrated, |rig| rig.boards[0].is_calibrated = false);
    stops(MotionFault::OtherBoard, |rig| rig.boards.push(rig.boards[0]));
    let mut rig = Rig::armed("people", &LIFTED);
    rig.cycle();
    rig.boards.clear();
    assert_eq!(rig.cycle().fault, Some(MotionFault::OtherBoard));
}

#[test]
fn a_late_frame_stops_it_by_its_own_period() {
    stops(MotionFault::LateFrame, |rig| {
        // No scan since the last cycle but three.
        rig.now_us += 20_001 - 5000;
        rig.boards[0].scanned_us = Some(rig.now_us - 20_001);
    });
    // A slow garment may take three of its periods.
    let mut rig = Rig::armed("people", &LIFTED);
    rig.boards[0].period_us = 15_000;
    rig.cycle();
    rig.now_us += 44_000;
    assert_eq!(rig.look().fault, None);
    rig.now_us += 2_000;
    assert_eq!(rig.look().fault, Some(MotionFault::LateFrame));
}

#[test]
fn it_is_armed_only_while_all_is_well() {
    let mut rig = Rig::new("people", &LIFTED);
    rig.touches = vec![rig.touch(1, "left_forearm", [0.03, 0.0, -0.15], [1.0, 0.0, 0.0], 40.0)];
    for _ in 0..20 {
        let command = rig.cycle();
        assert!(!command.moves() && command.speed.is_none() && command.deed == MotionDeed::Nothing);
    }
    rig.old_us = 60_000;
    assert_eq!(rig.arm(), Err(MotionFault::StalePosture));
    assert!(!rig.cycle().moves());
    rig.old_us = 0;
    rig.boards[0].scanned_us = None;
    assert_eq!(rig.arm(), Err(MotionFault::LostBoard));
    rig.boards[0].scanned_us = Some(rig.now_us);
    assert_eq!(rig.arm(), Ok(()));
    assert!(rig.run(0.05).moves());
    rig.state.disarm();
    let command = rig.cycle();
    assert!(!command.moves() && command.speed.is_none() && rig.state.phase() == MotionPhase::Disarmed);
}
