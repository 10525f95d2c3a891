//! The stage, which turns codes into an image.

use super::config::ConditionConfig;
use super::state::ConditionState;
use crate::baseline::feedback::Feedback;
use crate::baseline::progress::Tare;
use crate::baseline::touched::Touched;
use crate::calibrate::calibration::TaxelCalibration;
use crate::calibrate::dispatch::calibrate;
use crate::calibrate::sampled::Sampled;
use crate::calibrate::terms::LimitTerms;
use crate::filter::kinds::Filter;
use crate::filter::points::Points;
use crate::fold::{FoldState, consecutive};
use crate::format::Invalid;
use crate::garment::Layout;
use crate::image::images::Images;
use crate::image::slices::areas_of;
use crate::image::view::Image;
use core::ops::Range;

/// Turns codes into pressure; see the [module](super).
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct Condition {
    config: ConditionConfig,
}

impl ConditionConfig {
    /// Checks the settings.
    pub fn build(&self) -> Result<Condition, Invalid> {
        if self.floor == 0 {
            return Err(Invalid {
                parameter: "condition.floor",
                must: "must be at least 1 count, or all noise is a touch",
            });
        }
        Ok(Condition { config: *self })
    }
}

impl Condition {
    /// Processes one frame.
    ///
    /// `feedback` comes from the previous frame's contacts ([`Feedback::new`] if there are none). During a
    /// tare, including its last frame, the image is zero.
    pub fn process<'a, const TAXELS: usize, const CONTACTS: usize>(
        &self,
        state: &'a mut ConditionState<TAXELS>,
        layout: &Layout,
        sampled: &Sampled<'_>,
        feedback: &Feedback<CONTACTS>,
    ) -> Image<'a> {
        let Sampled { codes, falling, panels, .. } = *sampled;
        let ConditionState { calibration, images, points, tracking, folds } = state;
        if tracking.tare_frame(calibration, images, layout, codes, panels) {
            points.forget();
            if tracking.progress.tare() == Tare::Done && folds.table().is_some() {
                // The garment at rest is not bent.
                folds.begin(sampled.now, true);
                renew(folds, calibration, None, None);
                folds.each(|taxel, expected| calibration.relieve(taxel, expected, falling));
            }
        } else {
            let terms = LimitTerms::new(self.config.floor, falling);
            let renewed = calibration.set_limits(terms);
            if folds.table().is_some() {
                folds.begin(sampled.now, renewed);
                let asked = asked(folds, feedback);
                let touched = (!asked.is_empty()).then(|| Touched::of(layout, feedback, 1, &asked));
                let touched = touched.as_ref().filter(|touched| !touched.is_empty);
                renew(folds, calibration, touched, Some(terms));
            }
            self.perceive(calibration, images, points, folds, layout, sampled);
            if self.config.track_baseline {
                if folds.compares() && tracking.progress.tared {
                    learn(folds, calibration, images, layout, sampled, feedback);
                }
                tracking.follow_drift((calibration, images), layout, sampled, feedback, (folds, terms));
            }
        }
        self.image(state, layout)
    }

    /// Returns the last image again.
    pub fn image<'a, const TAXELS: usize>(
        &self,
        state: &'a ConditionState<TAXELS>,
        layout: &Layout,
    ) -> Image<'a> {
        state.images.image(layout, self.config.filter == Filter::Off)
    }

    /// Computes the image of a frame.
    fn perceive<const TAXELS: usize>(
        &self,
        calibration: &TaxelCalibration<TAXELS>,
        images: &mut Images<TAXELS>,
        points: &mut Points,
        folds: &FoldState,
        layout: &Layout,
        sampled: &Sampled<'_>,
    ) {
        let Sampled { codes, falling, panels, .. } = *sampled;
        let filter = self.config.filter;
        points.begin();
        let before = images.clear(layout, codes.len(), filter.overwrites_rows());
        for (panel, area) in areas_of(layout, panels) {
            images.active |= u8::from(calibrate(calibration, images, area, codes, falling)) << panel;
        }
        if let Some(before) = before {
            images.clear_left(layout, &before);
        }
        if images.active != 0 {
            folds.subtract(&mut images.calibrated, calibration.margin_of_unity().is_some());
        }
        for (_, area) in areas_of(layout, images.active) {
            filter.apply(images, points, area);
        }
    }
}

/// Renews the taxels whose turn it is, and their limits, if there are terms of any.
#[inline(never)] // M0+: once, not for each caller
fn renew<const TAXELS: usize>(
    folds: &mut FoldState,
    calibration: &mut TaxelCalibration<TAXELS>,
    touched: Option<&Touched>,
    terms: Option<LimitTerms>,
) {
    folds.renew(touched.map(|touched| |taxels: &[u16; 4]| touched.bytes(taxels)), |taxels, levels| {
        if let Some(terms) = terms {
            calibration.set_levels(taxels, levels, terms);
        }
    });
}

/// Taxels beside a contact that may belong to it.
const BESIDE: u16 = 3;

/// Corrects what the folds are expected to press, where nothing touches.
fn learn<const TAXELS: usize, const CONTACTS: usize>(
    folds: &mut FoldState,
    calibration: &TaxelCalibration<TAXELS>,
    images: &Images<TAXELS>,
    layout: &Layout,
    sampled: &Sampled<'_>,
    feedback: &Feedback<CONTACTS>,
) {
    let touched = Touched::of(layout, feedback, BESIDE, &asked(folds, feedback));
    let is_on = |panel| sampled.panels >> panel & 1 == 1;
    let all_read = (0..layout.areas().len()).all(is_on);
    let Sampled { codes, falling, .. } = *sampled;
    // M0+: the place needs a division.
    let is_read = |taxel| all_read || layout.place(taxel).is_some_and(|place| is_on(place.panel.into()));
    folds.learn(|taxels| {
        if let Some(first) = consecutive(taxels).filter(|_| all_read) {
            let known = !touched.four(first) & 0xF;
            if known == 0 {
                return (0, [0; 4]);
            }
            if let Some([0, 0, 0, 0]) = images.calibrated.get(first..first + 4)
                && let Some(pressures) = calibration.pressures(first, codes, falling)
            {
                return (known, pressures);
            }
        }
        each_known(taxels, |taxel| {
            let is_quiet = images.calibrated.get(taxel) == Some(&0) && !touched.has(taxel);
            let code = codes.get(taxel).filter(|_| is_quiet && is_read(taxel))?;
            Some(calibration.pressure(taxel, *code, falling))
        })
    });
}

/// Taxels of which it is asked whether something touches them.
fn asked<const CONTACTS: usize>(folds: &FoldState, feedback: &Feedback<CONTACTS>) -> Range<usize> {
    if feedback.home.is_empty() { 0..0 } else { folds.turn() }
}

/// Pressures of those of four taxels that have one, and a bit for each of these.
#[inline(never)] // few fours are apart
fn each_known(taxels: &[u16; 4], pressure_of: impl Fn(usize) -> Option<u16>) -> (u32, [u16; 4]) {
    let (mut known, mut pressures) = (0, [0; 4]);
    for (at, (taxel, to)) in taxels.iter().zip(&mut pressures).enumerate() {
        if let Some(pressure) = pressure_of(usize::from(*taxel)) {
            *to = pressure;
            known |= 1 << at;
        }
    }
    (known, pressures)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::{Tare, UNITY};
    use super::*;
    use crate::baseline::feedback::Pressed;
    use crate::format::{Code, Micros};
    use crate::garment::{Absent, Garment, Rect};
    use std::vec;
    use std::vec::Vec;

    type FullState = ConditionState<2048>;

    fn rig(config: ConditionConfig, rest: u16) -> (Condition, Layout, FullState) {
        let layout = Layout::build(&Garment::reference(), 2048, u16::MAX).unwrap();
        let mut state = FullState::new();
        state.reset(&layout, Code(rest));
        (config.build().unwrap(), layout, state)
    }

    fn frame(codes: &[Code], falling: bool, panels: u8) -> Sampled<'_> {
        Sampled { codes, falling, panels, now: Micros(0) }
    }

    fn plain() -> ConditionConfig {
        ConditionConfig { filter: Filter::Off, ..ConditionConfig::default() }
    }

    #[test]
    fn a_value_is_what_the_module_says() {
        let (condition, layout, mut state) = rig(ConditionConfig { floor: 1, ..plain() }, 0);
        let mut noise = 1u32;
        let mut next = || {
            noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
            noise >> 8
        };
        for round in 0..200u32 {
            for taxel in 0..2048 {
                let mode = next();
                state.set_gain(taxel, (next() >> (mode % 16)) as u16);
                state.set_baseline(taxel, Code((next() >> (mode / 16 % 16)) as u16));
            }
            // Without tracking, so that the reference needs no state.
            let floor = 1 + (next() % 300) as u16;
            let config = ConditionConfig { floor, track_baseline: false, ..plain() };
            let condition = if round == 0 { condition.clone() } else { config.build().unwrap() };
            let floor = condition.config.floor;
            let falling = round % 2 == 1;
            let codes: Vec<Code> = (0..2048).map(|_| Code(next() as u16)).collect();
            let rest: Vec<u16> = state.baseline().unwrap().to_vec();
            let gain: Vec<u16> = state.gain().to_vec();
            let image =
                condition.process(&mut state, &layout, &frame(&codes, falling, 0xff), &Feedback::<1>::new());
            for (taxel, value) in image.values.iter().enumerate() {
                let (code, rest) = (i64::from(codes[taxel].0), i64::from(rest[taxel]));
                let difference = if falling { rest - code } else { code - rest }.max(0);
                let want = ((difference * i64::from(gain[taxel]) + 2048) >> 12).min(65535);
                assert_eq!(i64::from(*value), if want < i64::from(floor) { 0 } else { want });
            }
        }
    }

    #[test]
    fn panels_off_short_codes_and_absent_taxels_read_as_zero() {
        let mut garment = Garment::reference();
        garment.absent.push(Absent { panel: 0, row: 0, column: 3, rows: 2, columns: 2 }).unwrap();
        let layout = Layout::build(&garment, 2048, u16::MAX).unwrap();
        let mut state = FullState::new();
        state.reset(&layout, Code(0));
        let condition = plain().build().unwrap();
        let none = Feedback::<4>::new();
        let all = vec![Code(1000); 3000];
        let sum = |image: Image| image.values.iter().map(|v| u32::from(*v)).sum::<u32>();
        let mut go = |codes: &[Code], panels| {
            sum(condition.process(&mut state, &layout, &frame(codes, false, panels), &none))
        };
        assert_eq!(go(&all, 0xf), 2044 * 1000);
        assert_eq!(go(&all, 0b0110), 1024 * 1000);
        assert_eq!(go(&all[..600], 0xf), 596 * 1000);
        assert_eq!(go(&[], 0xf), 0);
        assert_eq!(go(&all, 0), 0);
    }

    #[test]
    fn a_tare_takes_the_rounded_mean() {
        for falling in [false, true] {
            let (condition, layout, mut state) = rig(plain(), if falling { 4095 } else { 0 });
            let none = Feedback::<4>::new();
            state.tare(3);
            for (number, code) in [2000u16, 2001, 2004].into_iter().enumerate() {
                assert_eq!(state.tare_progress(), Tare::Running { left: 3 - number as u16 });
                let codes = vec![Code(code); 2048];
                let image = condition.process(&mut state, &layout, &frame(&codes, falling, 0b11), &none);
                assert!(image.rows.is_empty() && image.values.iter().all(|v| *v == 0));
                assert_eq!(image.values.len(), 2048);
            }
            assert_eq!(state.tare_progress(), Tare::Done);
            let rest = state.baseline().unwrap();
            assert_eq!((rest[0], rest[1023]), (2002, 2002));
            assert_eq!(rest[1024], if falling { 4095 } else { 0 }, "panels that are off keep theirs");
            let codes = vec![Code(if falling { 1002 } else { 3002 }); 2048];
            let image = condition.process(&mut state, &layout, &frame(&codes, falling, 0b11), &none);
            assert_eq!((image.values[0], image.values[1024]), (1000, 0));
            assert_eq!(state.tare_progress(), Tare::Idle);
        }
    }

    #[test]
    fn the_longest_tare_at_full_scale_is_exact() {
        let layout = Layout::build(&Garment::block(), 64, u16::MAX).unwrap();
        let mut state = ConditionState::<64>::new();
        state.reset(&layout, Code(0));
        let condition = plain().build().unwrap();
        state.tare(u16::MAX);
        for _ in 0..u16::MAX {
            let codes = [Code(u16::MAX); 64];
            condition.process(&mut state, &layout, &frame(&codes, false, 1), &Feedback::<1>::new());
        }
        assert_eq!(state.baseline().unwrap(), [u16::MAX; 64]);
    }

    #[test]
    fn drift_is_followed_but_no_contact_swallowed() {
        for period_us in [640, 5_128, 40_000] {
            let (condition, layout, mut state) = rig(ConditionConfig::default(), 0);
            let mut feedback = Feedback::<4>::new();
            let mut codes = vec![Code(10); 2048];
            let mut now = Micros(0);
            // For this number of turns of 0.7 s.
            let mut run = |state: &mut FullState, codes: &[Code], feedback: &Feedback<4>, turns: u64| {
                for _ in 0..turns * 700_000 / period_us {
                    now = Micros(now.0 + period_us);
                    let sampled = Sampled { codes, falling: false, panels: 0xf, now };
                    condition.process(state, &layout, &sampled, feedback);
                }
                state.baseline().unwrap().to_vec()
            };
            // Without a tare nothing drifts.
            assert_eq!(run(&mut state, &codes, &feedback, 3), [0; 2048]);
            state.tare(1);
            run(&mut state, &codes, &feedback, 1);
            // All taxels drift together, upwards and downwards.
            codes.fill(Code(30));
            assert_eq!(run(&mut state, &codes, &feedback, 2), [30; 2048]);
            codes.fill(Code(7));
            // Until the fast drift has ended long ago.
            assert_eq!(run(&mut state, &codes, &feedback, 40), [7; 2048]);
            // A held contact on the chest with a weak fringe: a block of 4 x 4 at 1000, around it 20 counts,
            // below the floor.
            for (row, column) in (9..15).flat_map(|row| (4..10).map(move |column| (row, column))) {
                let inner = (10..14).contains(&row) && (5..9).contains(&column);
                codes[row * 16 + column] = Code(if inner { 1007 } else { 27 });
            }
            let rect = Rect { panel: 0, top: 10, bottom: 13, left: 5, right: 8 };
            feedback.home.push(Pressed { rect, peak: 1000, slow: false }).unwrap();
            let rests = run(&mut state, &codes, &feedback, 30);
            assert!(rests.iter().zip(&codes).all(|(now, code)| *now == if code.0 == 27 { 27 } else { 7 }));
            // The rest drifts fast: the held contact goes with it, and so does its fringe.
            let drifted: Vec<Code> = codes.iter().map(|code| Code(code.0 + 12)).collect();
            for (codes, rest) in [(&drifted, 19), (&codes, 7)] {
                let rests = run(&mut state, codes, &feedback, 2);
                assert!(rests.iter().zip(codes).all(|(now, code)| *now == rest || code.0 == rest + 20));
                assert!((rest + 1..=rest + 20).contains(&rests[9 * 16 + 4]), "{}", rests[9 * 16 + 4]);
            }
            // Without the rectangle the fringe below the floor counts as drift; the contact does not.
            let rest = run(&mut state, &codes, &Feedback::new(), 30);
            assert_eq!((rest[10 * 16 + 5], rest[9 * 16 + 4], rest[0]), (7, 27, 7));
        }
    }

    /// The first eight taxels fold at an elbow, and press 200 counts, 60 more or less.
    #[cfg(feature = "folds")]
    fn folding(layout: &Layout) -> crate::fold::FoldTable<'static> {
        use crate::condition::tests::{single, stored};
        use crate::fold::{FoldCell, FoldTableParts};
        let parts = FoldTableParts {
            joints: &["elbow"],
            folds: &[single(1, 8)],
            taxels: &[0, 1, 2, 3, 4, 5, 6, 7],
            cells: &[FoldCell { mean: 50, spread: 15, days: 0 }; 8],
            unit: 4,
        };
        stored(&parts, layout)
    }

    #[cfg(feature = "folds")]
    #[test]
    fn drift_makes_no_touch_of_a_fold_whose_limit_lies_beyond_the_range() {
        use crate::fold::{JointAngle, Posture};
        let (condition, layout, mut state) = rig(plain(), 250);
        let joints = [crate::format::name("elbow")];
        state.use_folds(Some(folding(&layout)), &joints);
        let none = Feedback::<4>::new();
        let mut codes = vec![Code(250); 2048];
        state.tare(1);
        condition.process(&mut state, &layout, &frame(&codes, true, 0xf), &none);
        // It presses 240 counts, and all taxels drift.
        codes.fill(Code(270));
        codes[..8].fill(Code(30));
        for number in 1..600 {
            let now = Micros(number * 5_128);
            let posture = Posture { joints: [JointAngle::default()].into_iter().collect() };
            state.posture_mut().accept(&posture, &joints, now).unwrap();
            let sampled = Sampled { codes: &codes, falling: true, panels: 0xf, now };
            let image = condition.process(&mut state, &layout, &sampled, &none);
            assert!(image.values.iter().all(|value| *value == 0), "{number}: {:?}", &image.values[..8]);
        }
        assert_eq!(state.baseline().unwrap()[..9], [270; 9]);
    }

    #[test]
    fn settings_and_bounds() {
        let refused = ConditionConfig { floor: 0, ..plain() }.build().unwrap_err();
        assert_eq!(refused.parameter, "condition.floor");
        let (.., mut state) = rig(plain(), 0);
        assert!(state.set_gain(2047, UNITY) && !state.set_gain(2048, UNITY));
        assert!(state.set_baseline(2047, Code(1)) && !state.set_baseline(2048, Code(1)));
        state.tare(2);
        assert!(!state.set_baseline(0, Code(1)) && state.baseline().is_none());
        // The memory stated in the module's table.
        assert!(size_of::<FullState>() - size_of::<FoldState>() <= 10 * 2048 + 1360);
    }

    #[test]
    fn what_each_filter_keeps() {
        let layout = Layout::build(&Garment::block(), 64, u16::MAX).unwrap();
        let kept = |filter, taxels: &[(usize, u16)]| {
            let mut codes = [Code(0); 64];
            taxels.iter().for_each(|(taxel, code)| codes[*taxel] = Code(*code));
            let mut state = ConditionState::<64>::new();
            state.reset(&layout, Code(0));
            let condition = ConditionConfig { filter, ..ConditionConfig::default() }.build().unwrap();
            let sampled = Sampled { codes: &codes, falling: false, panels: 1, now: Micros(0) };
            let image = condition.process(&mut state, &layout, &sampled, &Feedback::<1>::new());
            image.values.iter().filter(|v| **v > 0).count()
        };
        let finger = [(20, 900), (21, 900), (36, 900), (37, 900)];
        let line: Vec<(usize, u16)> = (16..32).map(|taxel| (taxel, 500)).collect();
        let filters = [Filter::Conservative, Filter::Median, Filter::Square];
        assert_eq!(filters.map(|f| kept(f, &finger)), [4, 0, 4]);
        assert_eq!(filters.map(|f| kept(f, &line)), [16, 0, 16]);
        // An impulse is removed, on the border too; a gap is bridged.
        assert_eq!(kept(Filter::Conservative, &[(37, 4000)]), 0);
        assert_eq!(kept(Filter::Conservative, &[(0, 4000)]), 0);
        let gap: Vec<_> = (0..64).filter(|t| *t != 37).map(|taxel| (taxel, 500)).collect();
        assert_eq!(kept(Filter::Conservative, &gap), 64);
    }
}
