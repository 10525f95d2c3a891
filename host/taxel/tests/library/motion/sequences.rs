//! Random sequences of faults and touches: nothing is commanded while it is disarmed, stopped, or what is known is old.

use super::rig::{LIFTED, Rig};
use crate::random::Noise;
use taxel::body::DVec3;
use taxel::mind::Mover;
use taxel::motion::{MotionFault, MotionInput, MotionPhase, MotionPosture};
use taxel_core::intent::Leading;

/// Sequences; `TAXEL_CAMPAIGN` asks for as many as the campaign has.
fn sequences() -> u64 {
    if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 100_000 } else { 1000 }
}

#[test]
fn nothing_is_commanded_while_disarmed_or_stale() {
    let (mut moved, mut faults) = (0u64, [0u64; MotionFault::ALL.len()]);
    let fresh = Rig::new("people", &LIFTED);
    for seed in 0..sequences() {
        let mut noise = Noise(seed);
        let mut rig = Rig::new("people", &LIFTED);
        rig.control = fresh.control.clone();
        // Whether somebody has armed it, as an independent judge knows it.
        let mut may_move = false;
        let (mut posture_us, mut heard, mut silent) = (rig.now_us, vec![Some(rig.now_us)], 0);
        for _ in 0..60 {
            let step = match noise.below(60) {
                0 => -(noise.below(20_000) as i64),
                1 => noise.below(400_000) as i64,
                _ => 3000 + noise.below(4000) as i64,
            };
            rig.now_us = rig.now_us.saturating_add_signed(step).max(1);
            if noise.below(25) > 0 {
                let at_us = rig.now_us - noise.below(6000).min(rig.now_us);
                // Stamps of one sender go forward, unless its clock is set.
                posture_us = if noise.below(50) == 0 { at_us } else { posture_us.max(at_us) };
            }
            match noise.below(80) {
                0 => heard[0] = None,
                1 => rig.boards[0].begun += 1,
                2 => heard[0] = Some(rig.now_us + noise.below(40_000)),
                3 => rig.boards[0].is_calibrated = noise.below(4) > 0,
                4..8 => rig.boards[0].is_calibrated = true,
                8 => silent = 1 + noise.below(9),
                _ if silent > 0 => silent -= 1,
                _ => heard[0] = Some(rig.now_us),
            }
            rig.boards[0].scanned_us = heard[0];
            let mut positions = rig.positions.clone();
            if noise.below(120) == 0 {
                positions[noise.below(4) as usize] = [f64::NAN, f64::INFINITY][noise.below(2) as usize];
            }
            rig.touches = touches(&mut noise, &rig);
            rig.leading =
                [Leading::None, Leading::Kindness, Leading::Threat, Leading::Attack][noise.below(4) as usize];
            let Rig { control, state, now_us, boards, touches, leading, .. } = &mut rig;
            let posture = MotionPosture { at_us: posture_us, positions: &positions };
            let input = MotionInput {
                now_us: *now_us,
                posture: (noise.below(100) > 0).then_some(posture),
                boards,
                touches,
                leading: *leading,
            };
            match noise.below(20) {
                0 => {
                    state.disarm();
                    may_move = false;
                }
                1..4 => may_move = control.arm(state, &input).is_ok() || may_move,
                _ => {}
            }
            let command = control.step(state, &input);
            let is_young = |us: u64, most_us: u64| *now_us >= us && *now_us - us <= most_us;
            let is_fresh = input.posture.is_some()
                && positions.iter().all(|position| position.is_finite())
                && (is_young(posture_us, 50_000) || posture_us > *now_us && posture_us - *now_us <= 10_000)
                && boards.iter().all(|board| board.scanned_us.is_some_and(|us| us + 20_000 >= *now_us));
            if command.fault.is_some() {
                may_move = false;
            }
            assert_eq!(may_move, command.phase == MotionPhase::Armed, "sequence {seed}");
            assert!(command.velocities.iter().all(|velocity| velocity.is_finite()));
            assert!(!command.moves() || (may_move && is_fresh), "sequence {seed}: {command:?}");
            assert!((command.phase == MotionPhase::Disarmed) == command.speed.is_none());
            assert!(may_move || command.speed.unwrap_or(0.0) == 0.0, "sequence {seed}");
            for (limit, velocity) in control.behaviour().joints.iter().zip(&command.velocities) {
                assert!(velocity.abs() <= limit.velocity + 1e-12, "sequence {seed}");
            }
            moved += u64::from(command.moves());
            for (position, velocity) in rig.positions.iter_mut().zip(&command.velocities) {
                *position += velocity * 0.005;
            }
        }
        for (number, fault) in MotionFault::ALL.into_iter().enumerate() {
            faults[number] += rig.state.count(fault);
        }
    }
    println!("{} sequences, {moved} cycles that move, faults {faults:?}", sequences());
    // It has judged something.
    assert!(moved > 5 * sequences() && faults.iter().all(|count| *count > 0), "{moved} {faults:?}");
}

fn touches(noise: &mut Noise, rig: &Rig) -> Vec<taxel::motion::MotionTouch> {
    let touches = (0..noise.below(4)).map(|number| {
        let link = ["left_forearm", "left_upper_arm", "torso", "right_forearm"][noise.below(4) as usize];
        let normal = DVec3::new(noise.normal(), noise.normal(), noise.normal()).normalize_or(DVec3::X);
        let at = [noise.range(-0.05, 0.05), noise.range(-0.05, 0.05), noise.range(-0.2, 0.2)];
        let newtons = if noise.below(300) == 0 { f64::NAN } else { noise.range(0.0, 60.0) };
        let mut touch = rig.touch(number, link, at, normal.to_array(), newtons);
        touch.mover = [Mover::Own, Mover::Other, Mover::Unsure][noise.below(3) as usize];
        touch
    });
    touches.collect()
}
