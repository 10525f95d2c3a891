//! Postures at the times of frames: between readings and after them, against motions that are known exactly.

use proptest::prelude::*;
use std::collections::VecDeque;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use std::time::Duration;
use taxel::body::DVec3;
use taxel::body::posture::{Estimate, Gap, JointHistory, Motion};
use taxel::body::robot::{Robot, parse};
use taxel_core::format::Micros;

/// An arm of 0.5 m whose joint turns, one that turns on and on, and one that slides.
const ARM: &str = r#"<robot name="arm">
  <link name="base"/><link name="upper"/><link name="lower"/><link name="tip"/>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="upper"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" velocity="5" effort="1"/>
  </joint>
  <joint name="spin" type="continuous">
    <parent link="upper"/><child link="lower"/><origin xyz="0.2 0 0"/><axis xyz="0 1 0"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="lower"/><child link="tip"/><origin xyz="0.2 0 0"/><limit lower="-1" upper="1" effort="1"/>
  </joint>
</robot>"#;

/// An arm of 0.5 m on one joint.
const PENDULUM: &str = r#"<robot name="pendulum">
  <link name="base"/><link name="arm"/>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="arm"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" velocity="5" effort="1"/>
  </joint>
</robot>"#;

fn arm() -> Arc<Robot> {
    Arc::new(parse("arm.urdf", ARM).unwrap())
}

fn history(motion: Motion) -> JointHistory {
    JointHistory::new(arm(), motion).unwrap()
}

/// A history of which the first joint alone is needed.
fn of_one(motion: Motion) -> JointHistory {
    let mut history = history(motion);
    history.need(&[0]);
    history
}

/// A number below 1 that follows from its arguments.
fn random(seed: u64, number: u64) -> f64 {
    let mixed = (seed ^ number.wrapping_mul(0x9E37_79B9_7F4A_7C15)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((mixed ^ (mixed >> 32)) >> 11) as f64 / (1u64 << 53) as f64
}

/// A sum of waves: amplitude, frequency (Hz) and phase.
#[derive(Debug, Clone)]
struct Waves(Vec<(f64, f64, f64)>);

impl Waves {
    fn at(&self, time_us: u64) -> f64 {
        let seconds = time_us as f64 * 1e-6;
        self.0.iter().map(|(size, hz, phase)| size * (TAU * hz * seconds + phase).sin()).sum()
    }

    /// An upper bound of its velocity.
    fn velocity(&self) -> f64 {
        self.0.iter().map(|(size, hz, _)| size * TAU * hz).sum()
    }

    /// An upper bound of its acceleration.
    fn acceleration(&self) -> f64 {
        self.0.iter().map(|(size, hz, _)| size * (TAU * hz).powi(2)).sum()
    }
}

/// Motion of 1 Hz with 1 rad/s at most.
fn swing() -> Waves {
    Waves(vec![(1.0 / TAU, 1.0, 0.3)])
}

/// The pendulum, and its joints without a reading.
fn pendulum(waves: &Waves) -> (Arc<Robot>, JointHistory) {
    let robot = Arc::new(parse("pendulum.urdf", PENDULUM).unwrap());
    let motion = Motion { angular: waves.acceleration(), ..Motion::default() };
    (robot.clone(), JointHistory::new(robot, motion).unwrap())
}

/// How far the pendulum's end is off, and its bound, m.
fn off(robot: &Robot, estimate: &Estimate, truth: f64) -> (f64, f64) {
    let [seen, truth] = [estimate.posture[0], truth]
        .map(|angle| robot.poses(&[angle]).of(1, 0).unwrap().point(DVec3::new(0.0, 0.0, -0.5)));
    (seen.distance(truth), robot.displacement((1, 0), 0.5, &estimate.posture, &estimate.errors))
}

/// Place of the arm's end, 0.5 m from the first joint where it is stretched.
fn end(robot: &Robot, posture: &[f64]) -> DVec3 {
    let tip = robot.link("tip").unwrap();
    robot.poses(posture).of(tip, 0).unwrap().point(DVec3::new(0.1, 0.0, 0.0))
}

/// Bound of its error, m.
fn bound(robot: &Robot, estimate: &Estimate) -> f64 {
    robot.displacement((3, 0), 0.1, &estimate.posture, &estimate.errors)
}

/// All joints as far as they have come: readings every 20 ms, each up to 40 ms late, so that they overtake each
/// other.
fn arrivals(waves: &Waves, seed: u64, until_us: u64) -> Vec<(u64, u64, f64)> {
    let reading = |number: u64| {
        let at = number * 20_000;
        (at + (random(seed, number) * 40_000.0) as u64, at, waves.at(at))
    };
    let mut all: Vec<(u64, u64, f64)> = (0..until_us / 20_000).map(reading).collect();
    all.sort_by_key(|(arrives, ..)| *arrives);
    all
}

/// The bar of the aligned stream: joints at 50 Hz up to 40 ms late, frames at 195 Hz, 1 rad/s at 1 Hz, 0.5 m.
#[test]
fn the_aligned_stream_is_within_a_millimetre() {
    let waves = swing();
    let (mut worst, mut longest, mut answered, mut overtaken) = (0.0f64, 0, 0, 0);
    for seed in 0..5 {
        let (robot, mut history) = pendulum(&waves);
        let mut newest = 0;
        let mut frames: VecDeque<u64> = (2..1900).map(|number| number * 1_000_000 / 195).collect();
        for (now, at, angle) in arrivals(&waves, seed, 10_000_000) {
            overtaken += u32::from(at < newest);
            newest = newest.max(at);
            history.take(Micros(at), [("turn", angle)]).unwrap();
            // Frames that are scanned wait, each for those before it.
            while let Some(frame) = frames.front().copied().filter(|frame| *frame <= now) {
                let estimate = match history.aligned(Micros(frame), Micros(now)) {
                    Ok(estimate) => estimate,
                    Err(gap) => {
                        let waited = Duration::from_micros(now - frame);
                        assert_eq!(gap, Gap::Waits { joint: 0, waited });
                        break;
                    }
                };
                let (off, bound) = off(&robot, &estimate, waves.at(frame));
                assert!(off <= bound + 1e-12 && estimate.age == Duration::ZERO, "{frame}: {off} > {bound}");
                (worst, longest) = (worst.max(off), longest.max(now - frame));
                answered += 1;
                frames.pop_front();
            }
        }
    }
    println!("aligned: at most {:.3} mm, {longest} us late, {overtaken} readings overtaken", worst * 1e3);
    assert!(worst < 1e-3 && longest <= 80_000 && answered > 9_000 && overtaken > 100, "{answered}");
}

/// The live stream under the same conditions: it answers at once, and its bound is never exceeded.
#[test]
fn the_live_stream_states_a_bound_that_holds() {
    let waves = swing();
    let (mut worst, mut widest, mut oldest) = (0.0f64, 0.0f64, Duration::ZERO);
    for seed in 0..5 {
        let (robot, mut history) = pendulum(&waves);
        let mut arrivals = arrivals(&waves, seed, 10_000_000).into_iter().peekable();
        for frame in (20..1900u64).map(|number| number * 1_000_000 / 195) {
            while let Some((_, at, angle)) = arrivals.next_if(|(arrives, ..)| *arrives <= frame) {
                history.take(Micros(at), [("turn", angle)]).unwrap();
            }
            let estimate = history.live(Micros(frame)).unwrap();
            let (off, bound) = off(&robot, &estimate, waves.at(frame));
            assert!(off <= bound + 1e-12, "{frame}: {off} > {bound}");
            (worst, widest, oldest) = (worst.max(off), widest.max(bound), oldest.max(estimate.age));
        }
    }
    println!(
        "live: at most {:.2} mm, bound at most {:.2} mm, age at most {oldest:?}",
        worst * 1e3,
        widest * 1e3
    );
    assert!(oldest <= Duration::from_millis(60) && widest < 15e-3 && worst > widest / 4.0);
}

/// Waves within these sizes and frequencies.
fn waves(size: f64, hz: f64) -> impl Strategy<Value = Waves> {
    prop::collection::vec((0.0..size / 3.0, 0.05..hz, 0.0..TAU), 1..4).prop_map(Waves)
}

/// How readings come: time between two (us), the greatest delay (us) and the greatest error (rad or m).
fn readings() -> impl Strategy<Value = (u64, u64, f64, u64)> {
    (1_000u64..60_000, 0u64..300_000, prop::sample::select(vec![0.0, 1e-4, 5e-3]), any::<u64>())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(500) })]

    /// Three joints of any motion, readings at any pace, delayed, out of order and inexact: neither a position
    /// nor the tip is ever off by more than is said.
    #[test]
    fn no_bound_is_ever_exceeded(
        turn in waves(2.5, 3.0),
        spin in waves(6.0, 1.0),
        slide in waves(0.9, 2.0),
        (pace, delay, error, seed) in readings(),
    ) {
        let motion = Motion {
            angular: turn.acceleration().max(spin.acceleration()),
            linear: slide.acceleration(),
            angular_velocity: spin.velocity(),
            angular_error: error,
            linear_error: error,
        };
        let (robot, mut history) = (arm(), history(motion));
        let joints = [("turn", &turn), ("spin", &spin), ("slide", &slide)];
        let mut arrivals = Vec::new();
        for (joint, (name, waves)) in joints.iter().enumerate() {
            for number in 0..60u64 {
                let own = |what: u64| random(seed, number * 16 + joint as u64 * 4 + what);
                let at = number * pace + (own(0) * pace as f64) as u64;
                let noisy = waves.at(at) + (2.0 * own(1) - 1.0) * error;
                // A joint that turns on and on shows an angle within a turn.
                let shown = if *name == "spin" { (noisy + PI).rem_euclid(TAU) - PI } else { noisy };
                arrivals.push((at + (own(2) * delay as f64) as u64, at, *name, shown));
            }
        }
        arrivals.sort_by_key(|(arrives, ..)| *arrives);
        let mut answers = 0;
        for (now, at, name, shown) in arrivals {
            history.take(Micros(at), [(name, shown)]).unwrap();
            let back = (random(seed ^ 1, now) * 2.0 * pace as f64) as u64;
            for frame in [now, now.saturating_sub(back), now + back] {
                let known = [history.live(Micros(frame)), history.aligned(Micros(frame), Micros(now))];
                for estimate in known.into_iter().flatten() {
                    answers += 1;
                    let truth = joints.map(|(_, waves)| waves.at(frame));
                    for (joint, exact) in truth.iter().enumerate() {
                        let mut off = estimate.posture[joint] - exact;
                        if joint == 1 {
                            off -= TAU * (off / TAU).round();
                        }
                        let bound = estimate.errors[joint];
                        prop_assert!(off.abs() <= bound + 1e-9, "joint {joint} at {frame}: {off} > {bound}");
                    }
                    let off = end(&robot, &estimate.posture).distance(end(&robot, &truth));
                    let bound = bound(&robot, &estimate);
                    prop_assert!(off <= bound + 1e-9, "at {frame}: {off} > {bound}");
                }
            }
        }
        prop_assert!(answers > 100);
    }

    /// In which order readings come is of no importance once all are there.
    #[test]
    fn late_readings_are_put_in_their_place(
        order in Just((0..40u64).collect::<Vec<_>>()).prop_shuffle(),
        frame in 0u64..800_000,
    ) {
        let waves = swing();
        let [mut sorted, mut shuffled] = [(); 2].map(|()| of_one(Motion::default()));
        for (number, other) in (0..40u64).zip(order) {
            for (history, number) in [(&mut sorted, number), (&mut shuffled, other)] {
                history.take(Micros(number * 20_000), [("turn", waves.at(number * 20_000))]).unwrap();
            }
        }
        let now = Micros(1_000_000);
        prop_assert_eq!(sorted.aligned(Micros(frame), now), shuffled.aligned(Micros(frame), now));
        prop_assert_eq!(sorted.live(Micros(frame)), shuffled.live(Micros(frame)));
    }
}

/// Positions of the three joints.
fn all(turn: f64, spin: f64, slide: f64) -> [(&'static str, f64); 3] {
    [("turn", turn), ("spin", spin), ("slide", slide)]
}

#[test]
fn a_posture_waits_for_every_joint_and_says_for_how_long() {
    let mut history = history(Motion::default());
    let waits = |joint, ms| Err(Gap::Waits { joint, waited: Duration::from_millis(ms) });
    let [at, now] = [10_000, 25_000].map(Micros);
    assert_eq!(history.aligned(at, now), waits(0, 15));
    history.take(Micros(0), all(0.0, 0.0, 0.0)).unwrap();
    history.take(Micros(20_000), [("turn", 0.2), ("slide", 0.1)]).unwrap();
    assert_eq!(history.aligned(at, now), waits(1, 15));
    // A frame from the future has not waited.
    assert_eq!(history.aligned(Micros(99_000), now), waits(0, 0));
    history.take(Micros(40_000), [("spin", 0.4)]).unwrap();
    let estimate = history.aligned(at, now).unwrap();
    assert_eq!(estimate.posture, [0.1, 0.1, 0.05]);
    // At a reading nothing is uncertain but the reading.
    assert_eq!(history.aligned(Micros(0), now).unwrap().errors, [0.0; 3]);
    // Half of 20 rad/s^2 times 10 ms times 10 ms, and 30 ms; 5 m/s^2.
    let exact = [0.001, 0.003, 0.00025];
    assert!(estimate.errors.iter().zip(exact).all(|(error, exact)| (error - exact).abs() < 1e-12));
    history.forget();
    assert_eq!(history.aligned(at, now), waits(0, 15));
}

#[test]
fn what_is_no_longer_kept_never_comes() {
    let mut history = of_one(Motion::default());
    for number in 0..5_000u64 {
        history.take(Micros(number * 1000), [("turn", 0.0)]).unwrap();
    }
    let first = (5_000 - 512) * 1000;
    let now = Micros(5_000_000);
    assert!(history.aligned(Micros(first), now).is_ok());
    assert_eq!(history.aligned(Micros(first - 1), now), Err(Gap::Gone { joint: 0 }));
    assert_eq!(history.live(Micros(first - 1)), Err(Gap::Gone { joint: 0 }));
    // One that is older than all that are kept does not push them out.
    history.take(Micros(5), [("turn", 1.0)]).unwrap();
    assert_eq!(history.aligned(Micros(first - 1), now), Err(Gap::Gone { joint: 0 }));
    assert!(history.aligned(Micros(first), now).is_ok());
}

#[test]
fn the_live_posture_needs_a_velocity_and_states_its_age() {
    let mut history = history(Motion { angular: 10.0, linear: 1.0, ..Motion::default() });
    assert_eq!(history.live(Micros(0)), Err(Gap::Unmoved { joint: 0 }));
    history.take(Micros(100_000), all(0.0, 0.0, 0.0)).unwrap();
    assert_eq!(history.live(Micros(110_000)), Err(Gap::Unmoved { joint: 0 }));
    history.take(Micros(120_000), all(0.02, 0.0, 0.0)).unwrap();
    history.take(Micros(130_000), [("spin", 0.0), ("slide", 0.01)]).unwrap();
    let estimate = history.live(Micros(140_000)).unwrap();
    assert_eq!(estimate.age, Duration::from_millis(20));
    let near = |a: &[f64], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
    assert!(near(&estimate.posture, [0.04, 0.0, 0.02]), "{estimate:?}");
    // a / 2 * t * (h + t): 5 * 20 ms * 40 ms, 5 * 10 ms * 20 ms, 0.5 * 10 ms * 20 ms.
    assert!(near(&estimate.errors, [0.004, 0.001, 0.0001]), "{estimate:?}");
}

/// Beyond the velocity and the limits of the joint nothing is guessed, and after 0.2 s it stands: the bound is
/// that of the straight line all the same.
#[test]
fn what_is_guessed_has_limits() {
    let live = |first: f64, second: f64, after_us: u64| {
        let mut history = of_one(Motion { angular: 0.0, ..Motion::default() });
        history.take(Micros(0), [("turn", first)]).unwrap();
        history.take(Micros(20_000), [("turn", second)]).unwrap();
        let estimate = history.live(Micros(20_000 + after_us)).unwrap();
        (estimate.posture[0], estimate.errors[0])
    };
    let near = |(a, b): (f64, f64), (c, d): (f64, f64)| (a - c).abs() < 1e-9 && (b - d).abs() < 1e-9;
    assert!(near(live(0.0, 0.02, 10_000), (0.03, 0.0)));
    // 10 rad/s, where the file says 5.
    assert!(near(live(0.0, 0.2, 10_000), (0.25, 0.05)));
    // 4 rad/s into the stop at 3 rad.
    assert!(near(live(2.88, 2.96, 20_000), (3.0, 0.04)));
    // It has been read beyond the stop, by less than a fiftieth of 6 rad.
    assert!(near(live(3.06, 3.08, 20_000), (3.08, 0.02)));
    assert!(near(live(0.0, 0.02, 500_000), (0.22, 0.3)));
}

#[test]
fn a_joint_that_turns_on_and_on_takes_the_shorter_way() {
    let mut history = history(Motion::default());
    history.need(&[1]);
    history.take(Micros(0), [("spin", 3.1)]).unwrap();
    history.take(Micros(20_000), [("spin", -3.1)]).unwrap();
    let middle = history.aligned(Micros(10_000), Micros(20_000)).unwrap().posture[1];
    assert!((middle - PI).abs() < 1e-9, "{middle}");
    // A whole turn more is no motion.
    history.forget();
    for (time, angle) in [(0, 0.1), (20_000, 0.1 + TAU), (40_000, 0.1 - 3.0 * TAU)] {
        history.take(Micros(time), [("spin", angle)]).unwrap();
    }
    for us in [5_000, 25_000, 39_000] {
        let angle = history.aligned(Micros(us), Micros(us)).unwrap().posture[1];
        assert!(((angle - 0.1) / TAU - ((angle - 0.1) / TAU).round()).abs() < 1e-9, "{angle}");
    }
    let live = history.live(Micros(50_000)).unwrap().posture[1];
    assert!((live - 0.1 + 3.0 * TAU).abs() < 1e-9, "{live}");
}

/// At 10 rad/s, 0.32 s are more than half a turn: nobody knows which way it went, and the bound says so.
#[test]
fn a_joint_that_may_have_turned_by_half_a_turn_is_near_a_reading() {
    let mut history = history(Motion { angular_velocity: 10.0, ..Motion::default() });
    history.need(&[1]);
    for (time, angle) in [(0, 0.0), (320_000, 1.0)] {
        history.take(Micros(time), [("spin", angle)]).unwrap();
    }
    let near = |estimate: Estimate, position: f64, error: f64| {
        let [a, b] = [estimate.posture[1], estimate.errors[1]];
        assert!(a == position && (b - error).abs() < 1e-12, "{a} {b}");
    };
    let now = Micros(400_000);
    near(history.aligned(Micros(10_000), now).unwrap(), 0.0, 0.1);
    near(history.aligned(Micros(300_000), now).unwrap(), 1.0, 0.2);
    near(history.live(Micros(330_000)).unwrap(), 1.0, 0.1);
    near(history.live(Micros(9_000_000)).unwrap(), 1.0, PI);
    history.take(Micros(310_000), [("spin", 1.0)]).unwrap();
    near(history.live(Micros(330_000)).unwrap(), 1.0, 20.0 / 2.0 * 0.01 * 0.02);
}

#[test]
fn readings_that_cannot_be_are_refused_and_nothing_of_them_is_taken() {
    let mut history = history(Motion::default());
    let mut why = |positions: &[(&'static str, f64)]| {
        history.take(Micros(0), positions.iter().copied()).unwrap_err().to_string()
    };
    assert_eq!(
        why(&[("turn", 0.0), ("slid", 0.0)]),
        "arm.urdf: there is no joint \"slid\": did you mean \"slide\"? Known are turn, spin, slide"
    );
    assert_eq!(
        why(&[("turn", 0.0), ("spin", f64::NAN)]),
        "arm.urdf, line 6, joint \"spin\": its position must be a number, not NaN"
    );
    assert_eq!(
        why(&[("spin", 0.0), ("slide", 1.05)]),
        "arm.urdf, line 9, joint \"slide\": 1.05 m is out of its range, -1 m to 1 m"
    );
    history.take(Micros(20_000), all(0.0, 0.0, 1.03)).unwrap();
    assert_eq!(history.live(Micros(20_000)).unwrap().posture[2], 1.03);
    assert_eq!(history.live(Micros(10_000)), Err(Gap::Gone { joint: 0 }), "no reading of 0 us was taken");
    let motion = |angular| JointHistory::new(arm(), Motion { angular, ..Motion::default() });
    let error = motion(-1.0).unwrap_err().to_string();
    assert_eq!(error, "`angular` of the motion must be 0 or more, not -1");
    assert!(motion(f64::INFINITY).is_err() && motion(0.0).is_ok());
}

/// Nobody sends the joints that are not needed: they rest, and nothing is known of them.
#[test]
fn joints_that_are_not_needed_are_not_waited_for() {
    let robot = arm();
    let mut history = of_one(Motion::default());
    history.take(Micros(0), [("turn", 0.0)]).unwrap();
    history.take(Micros(20_000), [("turn", 0.1)]).unwrap();
    let estimate = history.aligned(Micros(10_000), Micros(20_000)).unwrap();
    assert_eq!((estimate.posture[1], estimate.errors[1]), (0.0, f64::INFINITY));
    let [upper, tip] =
        [1, 3].map(|link| robot.displacement((link, 0), 0.1, &estimate.posture, &estimate.errors));
    assert!(upper < 2e-4 && tip == f64::INFINITY, "{upper} {tip}");
    // At a reading one joint is exact, and the way of another not known.
    let exact = history.aligned(Micros(0), Micros(0)).unwrap();
    assert_eq!(robot.displacement((3, 0), 0.1, &exact.posture, &exact.errors), f64::INFINITY);
    // Fixed joints and those that mimic are sent by everybody, and passed over.
    let text = ARM
        .replace("<origin xyz=\"0.2 0 0\"/><limit", "<origin xyz=\"0.2 0 0\"/><mimic joint=\"turn\"/><limit");
    let mut history =
        JointHistory::new(Arc::new(parse("m.urdf", &text).unwrap()), Motion::default()).unwrap();
    history.take(Micros(0), all(0.1, 0.2, 77.0)).unwrap();
    assert_eq!(history.aligned(Micros(0), Micros(0)).unwrap().posture, [0.1, 0.2]);
}
