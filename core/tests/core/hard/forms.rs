//! Contacts of every form on one panel: nothing, everything, combs, spirals.

use crate::hard::rig::{ContactRig, taxels};
use crate::plain::Plain;
use taxel_core::contact::{Contact, Moments, Phase};
use taxel_core::format::Q15;
use taxel_core::garment::{Garment, Place, Rect};

#[test]
fn no_taxel() {
    let mut rig = ContactRig::mat();
    let frame = rig.frame();
    assert!(frame.present.is_empty() && frame.released.is_empty());
    // Below the high threshold nothing begins: 90 and 30 of noise on 120 mm2 are 75 and 30 on a mat's
    // 100 mm2.
    rig.fill([3, 5], [3, 5], 104);
    assert!(rig.frame().present.is_empty());
}

#[test]
fn one_taxel() {
    let mut rig = ContactRig::mat();
    let contact = rig.set(0, 20, 7, 1000).only();
    assert_eq!((contact.id, contact.phase, contact.panel), (1, Phase::Onset, 0));
    assert_eq!((contact.total, contact.peak, contact.area, contact.perimeter), (1000, 1000, 1, 1));
    assert_eq!(contact.peak_at, Place { panel: 0, row: 20, column: 7 });
    assert_eq!(contact.bounds, Rect { panel: 0, top: 20, bottom: 20, left: 7, right: 7 });
    assert_eq!((contact.x, contact.y), (taxels(7.0), taxels(20.0)));
    assert_eq!((contact.azimuth, contact.anisotropy.0, contact.breadth), (None, 0, 100));
    assert_eq!(contact.edge, 0, "symmetric");
    // Weaker than high, it is still the same contact; below half of its pressure it is gone, and reported once.
    let contact = rig.set(0, 20, 7, 68).only();
    assert_eq!((contact.id, contact.phase, contact.peak_total), (1, Phase::Held, 1000));
    let frame = rig.set(0, 20, 7, 67).frame();
    assert_eq!((frame.present.len(), frame.released.len()), (0, 1));
    let gone = &frame.released[0];
    assert_eq!((gone.id, gone.phase, gone.total, gone.peak_total), (1, Phase::Released, 0, 1000));
    assert_eq!(gone.duration_ms, 10);
    assert!(rig.frame().released.is_empty());
    assert_eq!(rig.set(0, 20, 7, 1000).only().id, 2);
}

#[test]
fn two_taxels() {
    let mut rig = ContactRig::mat();
    let contact = rig.set(0, 20, 7, 1000).set(0, 21, 8, 500).only();
    assert_eq!((contact.area, contact.x, contact.y), (2, taxels(7.0 + 1.0 / 3.0), taxels(20.0 + 1.0 / 3.0)));
    let azimuth = contact.azimuth.unwrap().to_radians().to_degrees();
    assert!((azimuth - 45.0).abs() < 1e-3);
    // Apart by one: two contacts.
    rig.clear().set(0, 20, 7, 1000).set(0, 22, 7, 500);
    assert_eq!(rig.frame().present.len(), 2);
}

#[test]
fn corners() {
    let mut rig = ContactRig::mat();
    for (row, column) in [(0, 0), (0, 31), (63, 0), (63, 31)] {
        rig.set(0, row, column, 4095);
    }
    let frame = rig.frame();
    let at: Vec<_> = frame.present.iter().map(|c| (c.y.to_f64(), c.x.to_f64())).collect();
    assert_eq!(at, [(0.0, 0.0), (0.0, 31.0), (63.0, 0.0), (63.0, 31.0)]);
}

#[test]
fn all_saturated() {
    for value in [4095, u16::MAX] {
        let mut rig = ContactRig::mat();
        let contact = rig.draw(|_, _| true, value).only();
        assert_eq!(contact.total, 2048 * u32::from(value));
        assert_eq!((contact.area, contact.perimeter), (2048, 2 * 64 + 2 * 30));
        assert_eq!((contact.x, contact.y), (taxels(15.5), taxels(31.5)));
        assert_eq!(contact.azimuth.map(|a| a.0), Some((1 << 30) - 1), "along y, to the last step");
        // 32 taxels of 10 mm, exactly: the pixel is part of the strip.
        assert_eq!(contact.breadth, 3200);
        let moments = rig.frame().moments[0];
        assert_eq!(moments, Moments::of_image(&rig.values, 32));
        let f = u128::from(value);
        assert_eq!(u128::from(moments.jm()), f * f * 2048 * 2048 * (64 * 64 + 32 * 32 - 2) / 12);
    }
}

#[test]
fn comb_spiral_diagonal_ring() {
    // Teeth that meet only in the last row.
    let contact = ContactRig::mat().draw(|x, y| x % 2 == 0 || y == 63, 300).only();
    assert_eq!(contact.area, 16 * 64 + 16);
    // Teeth upwards and downwards, not touching.
    let mut rig = ContactRig::mat();
    rig.draw(|x, y| (x % 4 == 0 && y < 62) || y == 0, 300).draw(|x, y| (x % 4 == 2 && y > 1) || y == 63, 301);
    assert_eq!(rig.frame().present.len(), 2);
    // A square spiral, one taxel wide.
    let mut rig = ContactRig::mat();
    let area = draw_spiral(&mut rig);
    let contact = rig.only();
    assert_eq!(contact.area, area);
    assert_eq!(contact.perimeter, area);
    // Diagonals, which hang together by corners only.
    let down = ContactRig::mat().draw(|x, y| x == y, 300).only();
    let up = ContactRig::mat().draw(|x, y| x + y == 31, 300).only();
    let degrees = |c: &Contact| c.azimuth.unwrap().to_radians().to_degrees();
    assert!((degrees(&down) - 45.0).abs() < 1e-3 && (degrees(&up) + 45.0).abs() < 1e-3);
    assert_eq!((down.area, down.anisotropy.0, up.area), (32, 32768, 32));
    // A ring: the centroid lies where nothing touches, and there is no direction.
    let mut rig = ContactRig::mat();
    rig.draw(|x, y| (8..12).contains(&((x - 15).pow(2) + (y - 30).pow(2)).isqrt()), 300);
    let ring = rig.only();
    assert_eq!((ring.x, ring.y, ring.azimuth), (taxels(15.0), taxels(30.0), None));
    // Inside it a dot of its own.
    assert_eq!(rig.set(0, 30, 15, 900).frame().present.len(), 2);
}

/// Draws a spiral with one free taxel between its turns; its number of taxels.
fn draw_spiral(rig: &mut ContactRig) -> u16 {
    let (mut x, mut y, mut dx, mut dy) = (0i32, 0i32, 1i32, 0i32);
    let mut cells = vec![[false; 32]; 64];
    let free = |cells: &Vec<[bool; 32]>, x: i32, y: i32| {
        !(0..32).contains(&x) || !(0..64).contains(&y) || !cells[y as usize][x as usize]
    };
    let mut area = 0;
    let mut turned = 0;
    while turned < 2 {
        if !cells[y as usize][x as usize] {
            cells[y as usize][x as usize] = true;
            rig.set(0, y as u16, x as u16, 300);
            area += 1;
        }
        let (nx, ny) = (x + dx, y + dy);
        let on = (0..32).contains(&nx) && (0..64).contains(&ny) && free(&cells, nx, ny);
        if on && free(&cells, nx + dx, ny + dy) {
            (x, y, turned) = (nx, ny, 0);
        } else {
            (dx, dy) = (-dy, dx);
            turned += 1;
        }
    }
    area
}

/// Squares of every side and discs of every radius that the mat holds, anywhere: no direction, to the last
/// step.
#[test]
fn discs_and_squares_have_no_direction() {
    let mut rig = ContactRig::mat();
    for size in 1..=32i32 {
        for (left, top) in [(0, 0), (32 - size, 64 - size), ((32 - size) / 2, 7)] {
            let [column, row] = [left, top].map(|first| [first as u16, (first + size - 1) as u16]);
            rig.state.reset();
            let square = rig.clear().fill(row, column, 4095).only();
            assert_eq!((square.azimuth, square.anisotropy), (None, Q15(0)), "side {size}");
            let middle = |first: i32| (2 * first + size - 1) << 15;
            assert_eq!((square.x.0, square.y.0), (middle(left), middle(top)));
            // A strip as broad as itself.
            assert_eq!(square.breadth, 100 * size as u32);
            // Of the taxels within the radius, as a circle is drawn: alike under quarter turns.
            let (x0, y0) = (2 * left + size - 1, 2 * top + size - 1);
            rig.state.reset();
            let inside = |x: i32, y: i32| (2 * x - x0).pow(2) + (2 * y - y0).pow(2) <= size * size;
            let disc = rig.clear().draw(inside, 777).only();
            assert_eq!((disc.azimuth, disc.anisotropy), (None, Q15(0)), "diameter {size}");
            assert_eq!((disc.x.0, disc.y.0), (middle(left), middle(top)));
        }
    }
}

/// What is a square in taxels is none in millimetres: the azimuth is that of the taxels, the breadth that of
/// the cloth.
#[test]
fn unequal_pitch() {
    let mut garment = Garment::mat();
    for (pitch, size, breadth) in [
        ([12_000, 10_000], [6, 6], 600),
        ([10_000, 12_000], [6, 6], 600),
        // 5 x 12 mm across 6 x 10 mm: the variance along x is 144 * 24, that along y 100 * 35.
        ([12_000, 10_000], [5, 6], 600),
        ([12_000, 10_000], [7, 8], 800),
        ([30_000, 7_500], [2, 20], 600),
        ([0, 0], [3, 9], 300),
    ] {
        garment.panels[0].pitch_um = pitch;
        let mut rig = ContactRig::new(&garment);
        let [columns, rows] = size;
        let contact = rig.fill([10, 9 + rows], [4, 3 + columns], 1000).only();
        assert_eq!(contact.breadth, breadth, "{pitch:?} {size:?}");
        let (w, h) = (i32::from(columns), i32::from(rows));
        assert_eq!((contact.x.0, contact.y.0), ((7 + w) << 15, (19 + h) << 15), "in taxels");
        let (along_x, along_y) = ((w * w - 1) as u64, (h * h - 1) as u64);
        assert_eq!(contact.anisotropy, Q15::ratio(along_y - along_x, along_x + along_y));
    }
}

/// Forms that hang together by corners and corridors, at 16 bits and no two taxels alike: every sum, exactly.
#[test]
fn every_form_has_its_exact_sums() {
    type Form = fn(i32, i32) -> bool;
    let forms: [(&str, Form); 9] = [
        ("panel", |_, _| true),
        ("checkerboard", |x, y| (x + y) % 2 == 0),
        ("comb", |x, y| x % 2 == 0 || y == 63),
        ("comb on its side", |x, y| y % 2 == 0 || x == 31),
        ("staircase", |x, y| x == y || x == y + 1),
        ("diagonal", |x, y| x + y == 31),
        ("zigzag", |x, y| (y % 62 - 31).abs() == x),
        ("frame", |x, y| x == 0 || y == 0 || x == 31 || y == 63),
        ("nested frames", |x, y| x.min(31 - x).min(y).min(63 - y) % 2 == 0 || (x == 15 && y < 32)),
    ];
    for (name, inside) in forms {
        let mut rig = ContactRig::mat();
        let mut drawn = Vec::new();
        for (x, y) in (0..64).flat_map(|y| (0..32).map(move |x| (x, y))).filter(|(x, y)| inside(*x, *y)) {
            let value = u16::MAX - (x * 331 + y * 97) as u16;
            rig.set(0, y as u16, x as u16, value);
            drawn.push((x, y, value));
        }
        let plain = Plain::of(&drawn);
        let frame = rig.frame();
        assert_eq!(frame.present.len(), 1, "{name}");
        assert!(plain.agrees(&frame.moments[0]), "{name}");
        let contact = &frame.present[0];
        assert_eq!((u32::from(contact.area), contact.peak), (plain.area, plain.peak), "{name}");
        assert_eq!(i128::from(contact.total), plain.m, "{name}");
    }
}
