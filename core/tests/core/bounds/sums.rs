//! Sums and the centroid: exact, and rounded once.

use crate::bounds::images::{self, moments};
use crate::bounds::table::bound;
use crate::plain::Plain;
use taxel_core::condition::{Image, Rows};
use taxel_core::contact::{ContactConfig, ContactState};
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Layout};

#[test]
fn sums_are_exact() {
    let stated = bound("sums, J m, A, B, C", "sums_are_exact");
    assert_eq!((stated.absolute, stated.relative), (0.0, 0.0));
    let mut count = 0;
    for taxels in images::all() {
        assert!(Plain::of(&taxels).agrees(&moments(&taxels)), "{taxels:?}");
        count += 1;
    }
    println!("{count} images");
    assert!(count > 35_000);
}

/// Through the whole stage, because the centroid is rounded there: every image that is one contact.
#[test]
fn centroid_is_rounded_once() {
    let stated = bound("centroid", "centroid_is_rounded_once");
    let layout = Layout::build(&Garment::mat(), 2048, u16::MAX).unwrap();
    let config = ContactConfig { low: 1, high: 1, ..ContactConfig::default() };
    let stage = config.build().unwrap();
    let mut state: Box<ContactState<64, 1024>> = Box::default();
    let mut values = vec![0u16; 2048];
    let (mut count, mut worst) = (0, 0f64);
    let small = images::four_taxels().chain(images::blobs(3000)).chain(images::lines());
    for taxels in images::rectangles().step_by(7).chain(small).chain(images::textures(50)) {
        values.fill(0);
        taxels.iter().for_each(|(x, y, f)| values[(y * 32 + x) as usize] = *f);
        state.reset();
        let image = Image { values: &values, rows: &Rows::of(&layout, &values) };
        let touches = stage.process(&mut state, &layout, &image, Micros(0));
        let [contact] = touches.present else { continue };
        let plain = Plain::of(&taxels);
        for (have, sum) in [(contact.x, plain.sx), (contact.y, plain.sy)] {
            // (have / 2^16 - sum / m), exactly: a fraction of 2^16 m.
            let off = i128::from(have.0) * plain.m - (sum << 16);
            worst = worst.max(off.abs() as f64 / plain.m as f64 / 65536.0);
            assert!(2 * off.abs() <= plain.m, "{taxels:?}");
        }
        count += 1;
    }
    println!("{count} contacts, largest error {worst:.3e} taxel");
    assert!(count > 10_000 && stated.absolute == 2f64.powi(-17) && stated.relative == 0.0);
}
