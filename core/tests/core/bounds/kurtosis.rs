//! Moments of the fourth order against floats.

use crate::bounds::images::Noise;
use taxel_core::condition::{Image, Rows};
use taxel_core::contact::{Contact, ContactConfig, ContactState, Kurtosis};
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Layout, Seam, SeamEdge, Side};

/// Rows and columns.
const PANEL: [u16; 2] = [32, 64];

/// The only contact of an image, with its kurtosis.
fn seen(layout: &Layout, values: &[u16]) -> (Contact, Kurtosis) {
    let mut state: Box<ContactState<1, 1024>> = Box::default();
    let image = Image { values, rows: &Rows::ALL };
    let stage = ContactConfig { low: 1, high: 1, ..ContactConfig::default() }.build().unwrap();
    let touches = stage.process(&mut state, layout, &image, Micros(0));
    (touches.present[0].clone(), touches.kurtosis[0])
}

/// By the definition, with the direction that the contact was found to have.
fn defined(values: &[u16], contact: &Contact) -> [f64; 3] {
    let angle =
        contact.azimuth.map_or(0.0, |turn| f64::from(turn.0) / f64::from(1u32 << 31) * std::f64::consts::PI);
    let (s, c) = angle.sin_cos();
    let columns = usize::from(PANEL[1]);
    let taxels = values
        .iter()
        .enumerate()
        .map(|(at, f)| ((at % columns) as f64, (at / columns) as f64, f64::from(*f)));
    let mean = |of: &dyn Fn(f64, f64) -> f64| {
        let weighed = |(sum, mass): (f64, f64), (x, y, f): (f64, f64, f64)| (sum + of(x, y) * f, mass + f);
        let (sum, mass) = taxels.clone().fold((0.0, 0.0), weighed);
        sum / mass
    };
    let (cx, cy) = (mean(&|x, _| x), mean(&|_, y| y));
    let a = |x: f64, y: f64| ((x - cx) * c + (y - cy) * s).powi(2) + 1.0 / 12.0;
    let b = |x: f64, y: f64| ((y - cy) * c - (x - cx) * s).powi(2) + 1.0 / 12.0;
    let (ea, eb) = (mean(&a), mean(&b));
    let log = |fourth: f64, square: f64| 1024.0 * (fourth / square).log2();
    [
        log(mean(&|x, y| a(x, y).powi(2)), ea * ea),
        log(mean(&|x, y| b(x, y).powi(2)), eb * eb),
        log(mean(&|x, y| a(x, y) * b(x, y)), ea * eb),
    ]
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
fn kurtosis_is_that_of_the_definition() {
    let layout = Layout::build(&Garment::recorded(PANEL[0], PANEL[1]), 2048, u16::MAX).unwrap();
    for side in [4, 16, 32] {
        let mut noise = Noise(side);
        let mut worst = 0.0f64;
        for _ in 0..2000 {
            let values = patch(&mut noise, side);
            let (contact, Kurtosis { along, across, mixed }) = seen(&layout, &values);
            let want = defined(&values, &contact);
            for (have, want) in [along, across, mixed].into_iter().zip(want) {
                worst = worst.max((f64::from(have) - want).abs());
            }
        }
        println!("kurtosis of up to {side} x {side} taxels: {worst:.1} steps off");
        assert!(worst <= 10.0, "{side}: {worst}");
    }
}

#[test]
fn a_rectangle_has_corners_and_an_ellipse_has_none() {
    let layout = Layout::build(&Garment::recorded(PANEL[0], PANEL[1]), 2048, u16::MAX).unwrap();
    let form = |inside: &dyn Fn(i32, i32) -> bool| {
        let values: Vec<u16> =
            (0..2048).map(|i| if inside(i % 64 - 32, i / 64 - 16) { 1000 } else { 0 }).collect();
        let Kurtosis { along, across, mixed } = seen(&layout, &values).1;
        [along, across, mixed].map(|log| (f64::from(log) / 1024.0).exp2())
    };
    let near = |have: [f64; 3], want: [f64; 3]| {
        assert!(have.iter().zip(want).all(|(have, want)| (have - want).abs() < 0.05), "{have:?} {want:?}");
    };
    near(form(&|x, y| x.abs() <= 20 && y.abs() <= 8), [1.8, 1.8, 1.0]);
    near(form(&|x, y| x * x + 4 * y * y <= 576), [2.0, 2.0, 2.0 / 3.0]);
    // A single taxel is a square of its own width, of which only the variance counts.
    near(form(&|x, y| x == 3 && y == -2), [1.0; 3]);
}

/// Whatever lies beyond the seam, what is on the home panel decides, about its own centre.
#[test]
fn across_a_seam_the_home_panel_counts() {
    let mut garment = Garment::recorded(16, 16);
    let mut second = garment.panels[0].clone();
    second.name = taxel_core::format::name("second");
    garment.panels.push(second).unwrap();
    let [a, b] = [(0, Side::Bottom), (1, Side::Top)].map(|(panel, side)| SeamEdge { panel, side, start: 0 });
    garment.seams.push(Seam { a, b, length: 16, reversed: false }).unwrap();
    let sewn = Layout::build(&garment, 2048, u16::MAX).unwrap();
    let [mut whole, mut alone] = [vec![0u16; 512], vec![0u16; 512]];
    for at in (0..512).filter(|at| (3..9).contains(&(at % 16)) && (4..18).contains(&(at / 16))) {
        whole[at] = 1000 + 50 * (at % 7) as u16;
        alone[at] = if at < 256 { whole[at] } else { 0 };
    }
    let ((crossing, whole), (_, alone)) = (seen(&sewn, &whole), seen(&sewn, &alone));
    assert_eq!((crossing.panel, crossing.area), (0, 6 * 14));
    for (a, b) in [(whole.along, alone.along), (whole.across, alone.across), (whole.mixed, alone.mixed)] {
        assert!(a.abs_diff(b) <= 10, "{a} {b}");
    }
}
