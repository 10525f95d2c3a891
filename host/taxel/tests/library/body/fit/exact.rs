//! Exact touches.

use super::displaced::{cases, displaced_at_random, known, read, read_again, surface_of, worst};
use crate::random::Noise;
use proptest::prelude::*;
use taxel::body::fit::FeltTouch;
use taxel::body::{DVec3, PatchOffset};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Exact touches give the exact placing, whatever a twentieth of them says, and whatever the offsets were before.
    #[test]
    fn the_placing_of_exact_touches_is_exact(seed in any::<u64>(), kind in 0..6usize) {
        let mut random = Noise(seed | 1);
        let case = &cases()[kind];
        let layout = case.layout();
        let patches = case.patches();
        let offsets: Vec<PatchOffset> = (0..patches).map(|_| displaced_at_random(&mut random)).collect();
        let truly = read_again(case, &offsets);
        let mut touches = Vec::new();
        for panel in 0..patches {
            let area = &layout.areas()[panel];
            for number in 0..20 {
                let [x, y] = [area.columns, area.rows].map(|count| random.below(u64::from(count)) as f64);
                let felt = FeltTouch { panel: panel as u8, x, y };
                let mut at = truly.at(&layout, panel as u8, x, y).unwrap().at;
                if number == 7 {
                    at += DVec3::new(0.05, 0.04, -0.06);
                }
                touches.push(known(&truly, &layout, felt, at));
            }
        }
        let before: Vec<PatchOffset> = (0..patches).map(|_| displaced_at_random(&mut random)).collect();
        let run = format!("exact-{seed}");
        let read = read(case, &run, &before);
        let fit = read.fit(&case.garment, &layout, &touches).unwrap();
        let found = surface_of(&fit, case);
        for (number, panel) in fit.panels.iter().enumerate() {
            prop_assert!(worst(&found, &truly, &layout, number) < 2e-5, "{}: {panel:?}", case.name);
            let left_out: Vec<usize> = panel.touches.iter().filter(|touch| !touch.is_kept).map(|touch| touch.number % 20).collect();
            prop_assert_eq!(left_out, [7]);
            prop_assert!(panel.rms() < 1e-5 && panel.shift_sd[0] < 1e-5 && panel.turn_sd.unwrap() < 0.01);
        }
    }
}
