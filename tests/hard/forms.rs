//! Contacts of every form on one panel: nothing, everything, combs, spirals.

use crate::rig::{Rig, taxels};
use taxel_core::contact::{Contact, Moments, Phase};
use taxel_core::garment::{Place, Rect};

#[test]
fn no_taxel() {
    let mut rig = Rig::mat();
    let frame = rig.frame();
    assert!(frame.present.is_empty() && frame.released.is_empty());
    // Below the high threshold nothing begins.
    rig.fill([3, 5], [3, 5], 119);
    assert!(rig.frame().present.is_empty());
}

#[test]
fn one_taxel() {
    let mut rig = Rig::mat();
    let contact = rig.set(0, 20, 7, 1000).only();
    assert_eq!((contact.id, contact.phase, contact.panel), (1, Phase::Onset, 0));
    assert_eq!((contact.total, contact.peak, contact.area, contact.perimeter), (1000, 1000, 1, 1));
    assert_eq!(contact.peak_at, Place { panel: 0, row: 20, column: 7 });
    assert_eq!(contact.bounds, Rect { panel: 0, top: 20, bottom: 20, left: 7, right: 7 });
    assert_eq!((contact.x, contact.y), (taxels(7.0), taxels(20.0)));
    assert_eq!((contact.azimuth, contact.anisotropy.0, contact.breadth), (None, 0, 100));
    assert_eq!(contact.edge, 0, "symmetric");
    // Weaker than high, it is still the same contact; below low it is gone, and told once.
    let contact = rig.set(0, 20, 7, 60).only();
    assert_eq!((contact.id, contact.phase, contact.peak_total), (1, Phase::Held, 1000));
    let frame = rig.set(0, 20, 7, 59).frame();
    assert_eq!((frame.present.len(), frame.released.len()), (0, 1));
    let gone = &frame.released[0];
    assert_eq!((gone.id, gone.phase, gone.total, gone.peak_total), (1, Phase::Released, 0, 1000));
    assert_eq!(gone.duration_ms, 10);
    assert!(rig.frame().released.is_empty());
    assert_eq!(rig.set(0, 20, 7, 1000).only().id, 2);
}

#[test]
fn two_taxels() {
    let mut rig = Rig::mat();
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
    let mut rig = Rig::mat();
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
        let mut rig = Rig::mat();
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
    let contact = Rig::mat().draw(|x, y| x % 2 == 0 || y == 63, 300).only();
    assert_eq!(contact.area, 16 * 64 + 16);
    // Teeth upwards and downwards, not touching.
    let mut rig = Rig::mat();
    rig.draw(|x, y| (x % 4 == 0 && y < 62) || y == 0, 300).draw(|x, y| (x % 4 == 2 && y > 1) || y == 63, 301);
    assert_eq!(rig.frame().present.len(), 2);
    // A square spiral, one taxel wide.
    let mut rig = Rig::mat();
    let area = draw_spiral(&mut rig);
    let contact = rig.only();
    assert_eq!(contact.area, area);
    assert_eq!(contact.perimeter, area);
    // Diagonals, which hang together by corners only.
    let down = Rig::mat().draw(|x, y| x == y, 300).only();
    let up = Rig::mat().draw(|x, y| x + y == 31, 300).only();
    let degrees = |c: &Contact| c.azimuth.unwrap().to_radians().to_degrees();
    assert!((degrees(&down) - 45.0).abs() < 1e-3 && (degrees(&up) + 45.0).abs() < 1e-3);
    assert_eq!((down.area, down.anisotropy.0, up.area), (32, 32768, 32));
    // A ring: the centroid lies where nothing touches, and there is no direction.
    let mut rig = Rig::mat();
    rig.draw(|x, y| (8..12).contains(&((x - 15).pow(2) + (y - 30).pow(2)).isqrt()), 300);
    let ring = rig.only();
    assert_eq!((ring.x, ring.y, ring.azimuth), (taxels(15.0), taxels(30.0), None));
    // Inside it a dot of its own.
    assert_eq!(rig.set(0, 30, 15, 900).frame().present.len(), 2);
}

/// Draws a spiral with one free taxel between its turns; its number of taxels.
fn draw_spiral(rig: &mut Rig) -> u16 {
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
