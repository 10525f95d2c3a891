//! Ratios of the fourth order against floats.

use crate::random::Noise;
use taxel_core::condition::{Image, Rows};
use taxel_core::contact::{ContactConfig, ContactState, Quartic};
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Layout};

/// Rows and columns.
const PANEL: [u16; 2] = [32, 64];

/// Ratios of the only contact of an image.
fn seen(layout: &Layout, values: &[u16]) -> Quartic {
    let mut state: Box<ContactState<1, 1024>> = Box::default();
    let image = Image { values, rows: &Rows::ALL };
    let stage = ContactConfig { low: 1, high: 1, ..ContactConfig::default() }.build().unwrap();
    let touches = stage.process(&mut state, layout, &image, Micros(0));
    touches.quartics[0]
}

/// By the definition, of all rows.
fn defined(values: &[u16]) -> [f64; 3] {
    let columns = usize::from(PANEL[1]);
    let place = |at: usize| ((at % columns) as f64, (at / columns) as f64);
    let taxels = values.iter().enumerate().map(|(at, f)| (place(at), f64::from(*f)));
    let sum = |of: &dyn Fn(f64, f64) -> f64| -> f64 { taxels.clone().map(|((x, y), f)| of(x, y) * f).sum() };
    let m = sum(&|_, _| 1.0);
    let (cx, cy) = (sum(&|x, _| x) / m, sum(&|_, y| y) / m);
    let r2 = |x: f64, y: f64| (x - cx).powi(2) + (y - cy).powi(2) + 1.0 / 6.0;
    let j = sum(&r2);
    // The angle of z, so many times, with the fourth power of its length.
    let turned = |times: f64| {
        let part = |of: fn(f64) -> f64| {
            sum(&|x, y| of((y - cy).atan2(x - cx) * times) * (x - cx).hypot(y - cy).powi(4))
        };
        part(f64::cos).hypot(part(f64::sin))
    };
    [sum(&|x, y| r2(x, y).powi(2)), turned(2.0), turned(4.0)].map(|sum| 512.0 * m * sum / (j * j))
}

fn ratios(quartic: Quartic) -> [i16; 3] {
    let Quartic { kurtosis, two, four } = quartic;
    [kurtosis, two, four]
}

/// A patch of random pressure that is one contact, somewhere on the panel.
fn patch(noise: &mut Noise, side: u64) -> Vec<u16> {
    let [rows, columns] = PANEL.map(u64::from);
    let (width, height) = (1 + noise.below(side), 1 + noise.below(side));
    let (left, top) = (noise.below(columns - width + 1), noise.below(rows - height + 1));
    let peak = [255, 4095, 65_535][noise.below(3) as usize];
    let mut values = vec![0; (rows * columns) as usize];
    // At least a quarter of the peak, so that no taxel is apart.
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        values[((top + y) * columns + left + x) as usize] =
            (peak / 4 + noise.below(peak - peak / 4 + 1)) as u16;
    }
    values
}

#[test]
fn ratios_are_those_of_the_definition() {
    let layout = Layout::build(&Garment::recorded(PANEL[0], PANEL[1]), 2048, u16::MAX).unwrap();
    let patches = if crate::is_campaign() { 2000 } else { 500 };
    for (side, bound) in [(4, 10.0), (16, 30.0), (32, 50.0)] {
        let mut noise = Noise(side);
        let mut worst = [0.0f64; 3];
        for _ in 0..patches {
            let values = patch(&mut noise, side);
            let have = ratios(seen(&layout, &values));
            for (worst, (have, want)) in worst.iter_mut().zip(have.into_iter().zip(defined(&values))) {
                *worst = worst.max((f64::from(have) - want).abs());
            }
        }
        println!("ratios of up to {side} x {side} taxels: {worst:.1?} steps off");
        assert!(worst.iter().all(|worst| *worst <= bound), "{side}: {worst:?}");
    }
}

#[test]
fn a_rectangle_has_corners_and_a_disc_has_none() {
    let layout = Layout::build(&Garment::recorded(PANEL[0], PANEL[1]), 2048, u16::MAX).unwrap();
    let form = |inside: &dyn Fn(i32, i32) -> bool| {
        let values: Vec<u16> =
            (0..2048).map(|i| if inside(i % 64 - 32, i / 64 - 16) { 1000 } else { 0 }).collect();
        ratios(seen(&layout, &values)).map(|ratio| f64::from(ratio) / 512.0)
    };
    let near = |have: [f64; 3], want: [f64; 3]| {
        assert!(have.iter().zip(want).all(|(have, want)| (have - want).abs() < 0.03), "{have:?} {want:?}");
    };
    near(form(&|x, y| x.abs() <= 9 && y.abs() <= 9), [1.4, 0.0, 0.6]);
    near(form(&|x, y| x.abs() + y.abs() <= 13), [1.4, 0.0, 0.6]);
    near(form(&|x, y| x * x + y * y <= 90), [4.0 / 3.0, 0.0, 0.0]);
    near(form(&|x, y| (196..225).contains(&(x * x + y * y))), [1.0, 0.0, 0.0]);
    near(form(&|_, y| y == 3), [1.8, 1.8, 1.8]);
    // Of a single taxel, only its own width counts.
    near(form(&|x, y| x == 3 && y == -2), [1.0, 0.0, 0.0]);
}

#[test]
fn a_turned_contact_has_the_same_ratios() {
    let layout = Layout::build(&Garment::recorded(PANEL[0], PANEL[1]), 2048, u16::MAX).unwrap();
    let mut noise = Noise(7);
    for _ in 0..500 {
        let side = 8;
        let held: Vec<u16> = (0..side * side).map(|_| 500 + noise.below(3000) as u16).collect();
        let at = |of: &dyn Fn(usize, usize) -> usize| {
            let mut values = vec![0; 2048];
            for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
                values[(y + 9) * 64 + x + 17] = held[of(x, y)];
            }
            ratios(seen(&layout, &values))
        };
        let upright = at(&|x, y| y * side + x);
        let turned = [at(&|x, y| x * side + side - 1 - y), at(&|x, y| y * side + side - 1 - x)];
        for (a, b) in turned.iter().flatten().zip(upright.iter().cycle()) {
            assert!(a.abs_diff(*b) <= 6, "{upright:?} {turned:?}");
        }
    }
}

/// The groups of a row are added one by one; what lies between them belongs to another contact.
#[test]
fn a_row_of_several_groups_counts_only_its_own() {
    let layout = Layout::build(&Garment::recorded(PANEL[0], PANEL[1]), 2048, u16::MAX).unwrap();
    let values: Vec<u16> = (0..2048)
        .map(|i| (i % 64, i / 64))
        .map(|(x, y)| {
            let comb = (20..29).contains(&x) && (y == 12 || (y < 12 && y > 5 && x % 4 == 0));
            if comb { 800 + 10 * x as u16 } else { 0 }
        })
        .collect();
    let have = ratios(seen(&layout, &values));
    for (have, want) in have.into_iter().zip(defined(&values)) {
        assert!((f64::from(have) - want).abs() <= 8.0, "{have} {want}");
    }
}
