//! Speed over the surface, which is a length without a root.

use crate::bounds::exact::Real;
use crate::bounds::nmi::contact;
use crate::bounds::table::bound;
use crate::random::Noise;
use taxel_core::body::Placed;
use taxel_core::format::Fixed16;
use taxel_core::garment::{Garment, Layout, PITCH_UM};
use taxel_core::shape::Shape;

fn reported(pitch_um: [u32; 2], vx: i32, vy: i32) -> u32 {
    let mut garment = Garment::recorded(1, 1);
    garment.panels[0].pitch_um = pitch_um;
    let layout = Layout::build(&garment, 1, u16::MAX).unwrap();
    let mut contact = contact();
    (contact.vx, contact.vy) = (Fixed16(vx), Fixed16(vy));
    Placed::new(&layout, contact, Shape::default()).speed(&layout)
}

#[test]
fn speed_is_within_its_bound() {
    let stated = bound("speed over the surface", "speed_is_within_its_bound");
    let mut noise = Noise(12);
    let mut worst = 0f64;
    for round in 0..20_000u32 {
        let pitch = [[10_000, 10_000], [12_000, 10_000], [2_000, 8_000], [30_000, 7_500]][round as usize % 4];
        let [vx, vy] = [(); 2].map(|()| (noise.below(1 << 32) as u32 as i32) >> noise.below(32));
        let along = |v: i32, pitch: u32| Real::ratio(i64::from(v) * i64::from(pitch / 100), 65_536);
        let (x, y) = (along(vx, pitch[0]), along(vy, pitch[1]));
        let want = (x.clone() * x + y.clone() * y).sqrt();
        let error = (Real::whole(reported(pitch, vx, vy)) - want.clone()).to_f64();
        let want = want.to_f64();
        assert!(error <= stated.at(want) && error >= -stated.absolute, "{error} of {want}");
        worst = worst.max((error - stated.absolute) / want.max(1.0));
    }
    println!("20000 speeds, largest error {:.2} % and {} of 0.1 mm/s", 100.0 * worst, stated.absolute);
}

#[test]
fn speed_outside_its_range_is_held() {
    // A velocity at its end, over the largest pitch and over the smallest.
    let [least, most] = PITCH_UM;
    for pitch in [least, most] {
        let end = (pitch / 100) << 15;
        assert_eq!(reported([pitch; 2], i32::MIN, i32::MIN), end + end / 2);
    }
    assert_eq!(reported([most; 2], i32::MIN, i32::MIN), 98_304_000);
    assert_eq!(reported([0, 0], 1 << 16, 0), 100, "10 mm are assumed");
}
