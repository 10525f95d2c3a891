//! Calibration and baseline: rounded to the nearest count, exactly.

use crate::bounds::table::bound;
use crate::random::Noise;
use taxel_core::capacity::TAXELS;
use taxel_core::condition::{Condition, ConditionConfig, ConditionState, Feedback, Filter, Sampled, UNITY};
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Layout};

struct CalibrationRig {
    stage: Condition,
    layout: Layout,
    state: Box<ConditionState<TAXELS>>,
}

impl CalibrationRig {
    fn new() -> CalibrationRig {
        let config = ConditionConfig { floor: 1, filter: Filter::Off, track_baseline: false };
        let layout = Layout::build(&Garment::recorded(64, 32), TAXELS, u16::MAX).unwrap();
        let mut state: Box<ConditionState<TAXELS>> = Box::default();
        state.reset(&layout, Code(0));
        CalibrationRig { stage: config.build().unwrap(), layout, state }
    }

    fn frame(&mut self, codes: &[Code], falling: bool) -> &[u16] {
        let none = Feedback::<1>::new();
        let sampled = Sampled { codes, falling, panels: 1, now: Micros(0) };
        self.stage.process(&mut self.state, &self.layout, &sampled, &none).values
    }
}

/// Every difference of two 16-bit codes at gains from nothing to 16.
#[test]
fn calibration_is_rounded_to_nearest() {
    let stated = bound("pressure of a taxel", "calibration_is_rounded_to_nearest");
    let mut rig = CalibrationRig::new();
    let (mut count, mut worst) = (0u32, 0f64);
    let gains =
        [0, 1, 2, 1000, 2047, 2048, 2049, 4095, UNITY, 4097, 6144, 8192, 12_345, 32_768, 61_440, u16::MAX];
    for (gain, falling) in gains.into_iter().flat_map(|gain| [(gain, false), (gain, true)]) {
        for taxel in 0..TAXELS {
            rig.state.set_gain(taxel, gain);
            rig.state.set_baseline(taxel, Code(if falling { u16::MAX } else { 0 }));
        }
        for start in (0..=u16::MAX).step_by(TAXELS) {
            let differences = start..=start + (TAXELS - 1) as u16;
            let code = |d: u16| Code(if falling { u16::MAX - d } else { d });
            let codes: Vec<Code> = differences.clone().map(code).collect();
            for (have, d) in rig.frame(&codes, falling).iter().zip(differences) {
                let product = i64::from(d) * i64::from(gain);
                count += 1;
                if *have == u16::MAX {
                    assert!(product >= (i64::from(u16::MAX) << 12) - 2048, "{d} {gain}");
                    continue;
                }
                let off = (i64::from(*have) << 12) - product;
                worst = worst.max(off.unsigned_abs() as f64 / 4096.0);
                assert!((-2047..=2048).contains(&off), "halves upwards: {d} {gain}");
            }
        }
    }
    println!("{count} values, largest error {worst} counts");
    assert_eq!((worst, stated.absolute, stated.relative), (0.5, 0.5, 0.0));
}

/// Below the baseline is no pressure, not a large one.
#[test]
fn codes_outside_their_range_saturate() {
    let mut rig = CalibrationRig::new();
    for taxel in 0..TAXELS {
        rig.state.set_baseline(taxel, Code(1000));
        rig.state.set_gain(taxel, if taxel % 2 == 0 { UNITY } else { u16::MAX });
    }
    let all = |code| vec![Code(code); TAXELS];
    for (code, falling, want) in [
        (0, false, [0, 0]),
        (999, false, [0, 0]),
        (1000, false, [0, 0]),
        (1001, false, [1, 16]),
        (u16::MAX, false, [64_535, u16::MAX]),
        (u16::MAX, true, [0, 0]),
        (999, true, [1, 16]),
        (0, true, [1000, 16_000]),
    ] {
        assert_eq!(rig.frame(&all(code), falling)[..2], want, "{code} {falling}");
    }
    // More codes than taxels, and none.
    assert_eq!(rig.frame(&vec![Code(1001); 4000], false).len(), TAXELS);
    assert!(rig.frame(&[], false).iter().all(|value| *value == 0));
}

/// Every length of tare up to 64 frames, and long ones, over noise of any depth.
#[test]
fn a_baseline_is_the_mean_rounded_to_nearest() {
    let stated = bound("baseline", "a_baseline_is_the_mean_rounded_to_nearest");
    let mut noise = Noise(6);
    let (mut count, mut worst) = (0, 0f64);
    for frames in (1..=64).chain([100, 195, 999, 1000]) {
        let mut rig = CalibrationRig::new();
        let mut sums = vec![0i64; TAXELS];
        rig.state.tare(frames);
        for _ in 0..frames {
            let depth = |taxel: usize| 1 + (1u64 << (taxel % 17)) - 1;
            let codes: Vec<Code> = (0..TAXELS).map(|taxel| Code(noise.below(depth(taxel)) as u16)).collect();
            sums.iter_mut().zip(&codes).for_each(|(sum, code)| *sum += i64::from(code.0));
            assert!(rig.frame(&codes, false).iter().all(|value| *value == 0));
        }
        let frames = i64::from(frames);
        for (have, sum) in rig.state.baseline().expect("the tare is over").iter().zip(sums) {
            let off = 2 * (i64::from(*have) * frames - sum);
            worst = worst.max(off.unsigned_abs() as f64 / (2 * frames) as f64);
            assert!(off > -frames && off <= frames, "halves upwards: {sum} / {frames}");
            count += 1;
        }
    }
    println!("{count} baselines, largest error {worst} counts");
    assert_eq!((worst, stated.absolute, stated.relative), (0.5, 0.5, 0.0));
}
