//! Conditioning that leaves out what is quiet equals conditioning that does not, bit for bit.

use crate::dense::DenseCondition;
use crate::random::Noise;
use proptest::prelude::*;
use taxel_core::condition::{ConditionConfig, ConditionState, Feedback, Filter, Image, Pressed, Sampled};
use taxel_core::format::{Code, Micros, name};
use taxel_core::garment::{Absent, Garment, Layout, Rect};

const TAXELS: usize = 1024;
const FILTERS: [Filter; 5] =
    [Filter::Off, Filter::Conservative, Filter::Median, Filter::Square, Filter::Persistent];

/// Panels of the given sizes, with a hole in the first.
fn garment(sizes: &[(u16, u16)], hole: Option<(u16, u16)>) -> Garment {
    let mut garment = Garment::recorded(sizes[0].0, sizes[0].1);
    for (index, (rows, columns)) in sizes.iter().enumerate().skip(1) {
        let mut panel = Garment::recorded(*rows, *columns).panels[0].clone();
        panel.name = name(&format!("panel{index}"));
        garment.panels.push(panel).expect("few panels");
    }
    if let Some((row, column)) = hole {
        let (row, column) = (row % sizes[0].0, column % sizes[0].1);
        garment.absent.push(Absent { panel: 0, row, column, rows: 1, columns: 1 }).expect("one hole");
    }
    garment
}

/// Frames as they come: idle ones with noise, touches of any size, texture everywhere.
fn scene(noise: &mut Noise, rest: &[u16], falling: bool, full: u32) -> Vec<Code> {
    let share = [0, 0, 1, 10, 50, 95, 100][noise.below(7) as usize];
    let depth = [3, 60, full / 4, full][noise.below(4) as usize];
    let one = |rest: &u16| {
        let press = if noise.below(100) < share {
            noise.below(depth.into()) as i32
        } else {
            noise.below(5) as i32 - 2
        };
        let code = i32::from(*rest) + if falling { -press } else { press };
        Code(code.clamp(0, full as i32) as u16)
    };
    rest.iter().map(one).collect()
}

/// Every second frame most codes are those of the frame before: what stands out stays so.
fn stay(noise: &mut Noise, codes: &mut [Code], before: &[Code]) {
    if noise.below(2) == 1 {
        let same = codes.iter_mut().zip(before).filter(|_| noise.below(5) > 0);
        same.for_each(|(code, before)| *code = *before);
    }
}

/// The image, and that it says rightly what it leaves out.
fn check(layout: &Layout, image: &Image<'_>, want: &[u16]) -> Result<(), TestCaseError> {
    prop_assert_eq!(image.values, want);
    for area in layout.areas() {
        for row in 0..area.rows {
            let span = image.span(area, row);
            for column in (0..area.columns).filter(|column| !span.contains(column)) {
                prop_assert_eq!(want[usize::from(area.base + row * area.columns + column)], 0);
            }
            let next = image.rows.next(area.first_row + row..area.first_row + area.rows);
            prop_assert!(span.is_empty() || next == Some(area.first_row + row));
        }
    }
    Ok(())
}

fn sizes() -> impl Strategy<Value = Vec<(u16, u16)>> {
    let size = prop_oneof![
        Just((1, 1)),
        Just((1, 37)),
        Just((41, 1)),
        Just((2, 2)),
        Just((4, 16)),
        Just((16, 16)),
        Just((7, 40)),
        Just((260, 2)),
        (1u16..12, 1u16..20),
    ];
    proptest::collection::vec(size, 1..4).prop_filter("they fit", |sizes| {
        sizes.iter().map(|(rows, columns)| usize::from(rows * columns)).sum::<usize>() <= TAXELS
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn sparse_is_dense(
        sizes in sizes(),
        hole in proptest::option::of((0u16..300, 0u16..40)),
        falling: bool,
        wide: bool,
        filters in proptest::collection::vec(0usize..5, 3),
        floor in 1u16..200,
        seed: u64,
    ) {
        let mut noise = Noise(seed);
        let full = if wide { 65535 } else { 4095 };
        let layout = Layout::build(&garment(&sizes, hole), TAXELS, full as u16).expect("it fits");
        let rest = if falling { full as u16 - 100 } else { 100 };
        let mut state = ConditionState::<TAXELS>::new();
        state.reset(&layout, Code(rest));
        let mut dense = DenseCondition::new(&layout, ConditionConfig::default(), falling, rest);
        let mut feedback = Feedback::<4>::new();
        let mut before = Vec::new();
        let mut now = 0;
        for frame in 0..60 {
            let filter = FILTERS[filters[frame / 20]];
            dense.config = ConditionConfig { floor, filter, track_baseline: frame % 9 != 8 };
            let stage = dense.config.build().expect("settings in range");
            if frame % 13 == 3 {
                // Calibration changes under way; both ends of the scale come up.
                for _ in 0..20 {
                    let taxel = noise.below(layout.taxels() as u64) as usize;
                    let gain = [0, 1, 2000, 4096, 5000, 16384, 65535][noise.below(7) as usize];
                    let code = [0, 90, 110, full - 3, full][noise.below(5) as usize] as u16;
                    state.set_gain(taxel, gain);
                    dense.gain[taxel] = gain;
                    state.set_baseline(taxel, Code(code));
                    dense.rest[taxel] = code;
                }
                dense.tared = true;
                dense.forget();
            }
            let mut codes = scene(&mut noise, &dense.rest, falling, full);
            stay(&mut noise, &mut codes, &before);
            before.clone_from(&codes);
            if frame % 17 == 11 {
                codes.truncate(noise.below(layout.taxels() as u64) as usize);
            }
            let panels = if frame % 7 == 5 { noise.below(8) as u8 } else { 0xff };
            // As far apart as frames may be: from a fraction of a row's turn to more than all of them.
            now += [640, 5_128, 40_000, 900_000][noise.below(4) as usize];
            let sampled = Sampled { codes: &codes, falling, panels, now: Micros(now) };
            let image = stage.process(&mut state, &layout, &sampled, &feedback);
            let want = dense.process(&layout, &sampled, &feedback.home);
            check(&layout, &image, &want)?;
            prop_assert_eq!(&state.baseline().expect("no tare")[..layout.taxels()], &dense.rest);
            feedback.home.clear();
            let area = &layout.areas()[0];
            if noise.below(2) == 1 {
                let (top, left) = (noise.below(area.rows.into()) as u16, noise.below(area.columns.into()) as u16);
                let (bottom, right) = ((top + 2).min(area.rows - 1), (left + 2).min(area.columns - 1));
                let rect = Rect { panel: 0, top, bottom, left, right };
                let peak = [40, 400, 4000][noise.below(3) as usize];
                let _ = feedback.home.push(Pressed { rect, peak, slow: noise.below(3) == 0 });
            }
        }
    }
}
