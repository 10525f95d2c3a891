//! Pressure around a taxel but not on it is no fault of that taxel; if the taxel is dead, it is reported
//! soon.

use super::watched::{TARE, WatchedBoard};
use taxel_core::format::Code;
use taxel_core::health::TaxelHealth;

const COLUMNS: usize = 16;
/// Row and column of the central taxel, on the chest.
const MIDDLE: (usize, usize) = (16, 8);
const REST: u16 = 90;
const FRAMES: u32 = 100;

/// Codes of a frame: noise of 3 counts rms at rest, and the same with 900 counts more under pressure.
fn codes(rng: &mut fastrand::Rng, is_pressed: impl Fn(usize) -> bool) -> Vec<Code> {
    let mut noise = || ((0..4).map(|_| rng.f64() - 0.5).sum::<f64>() * 3f64.sqrt() * 3.0).round() as i16;
    (0..2048)
        .map(|t| Code((REST + if is_pressed(t) { 900 } else { 0 }).saturating_add_signed(noise())))
        .collect()
}

/// A taxel of the chest by its distance from the middle, in rows and columns.
fn from_middle(taxel: usize) -> Option<(usize, usize)> {
    let (row, column) = (taxel / COLUMNS, taxel % COLUMNS);
    (taxel < 32 * COLUMNS).then(|| (row.abs_diff(MIDDLE.0), column.abs_diff(MIDDLE.1)))
}

/// Faults found, with the frame after the tare, if these taxels are pressed for a while.
fn found(
    watched: &mut WatchedBoard,
    frames: u32,
    is_pressed: impl Fn(usize) -> bool,
) -> Vec<(usize, u32, TaxelHealth)> {
    let mut rng = fastrand::Rng::with_seed(5);
    watched.tare();
    let found = watched.show(u32::from(TARE) + frames, |frame| {
        codes(&mut rng, |taxel| frame >= u32::from(TARE) && is_pressed(taxel))
    });
    found.into_iter().map(|(taxel, (frame, health))| (taxel, frame - u32::from(TARE), health)).collect()
}

/// Eight taxels around one; a round wall of two taxels; a square frame around nine; a slit, open at one end.
#[test]
fn a_ring_accuses_no_taxel() {
    let thin = |(y, x): (usize, usize)| y.max(x) == 1;
    let round = |(y, x): (usize, usize)| y * y + x * x > 0 && y * y + x * x <= 6;
    let wide = |(y, x): (usize, usize)| y.max(x) == 2;
    let cup = |(y, x): (usize, usize)| (9..=16).contains(&(y * y + x * x));
    for (name, ring) in [
        ("thin", &thin as &dyn Fn((usize, usize)) -> bool),
        ("round", &round),
        ("wide", &wide),
        ("cup", &cup),
    ] {
        let found = found(&mut WatchedBoard::new(), 3 * FRAMES, |taxel| from_middle(taxel).is_some_and(ring));
        assert!(found.is_empty(), "{name}: {found:?}");
    }
}

/// Three rows and columns around it, then two: an object that presses those would press it, too.
#[test]
fn a_dead_taxel_under_what_presses_all_around_is_reported_within_100_frames() {
    for (height, width) in [(2, 2), (2, 3), (5, 5)] {
        let box_around = |(y, x): (usize, usize)| y <= height && x <= width && y + x > 0;
        let found =
            found(&mut WatchedBoard::new(), FRAMES + 11, |taxel| from_middle(taxel).is_some_and(box_around));
        let [(taxel, frame, TaxelHealth::Dead)] = found[..] else { panic!("{found:?}") };
        assert_eq!(taxel, MIDDLE.0 * COLUMNS + MIDDLE.1);
        assert!(frame < FRAMES, "frame {frame}");
    }
}

/// At an edge of the garment, and in its corner.
#[test]
fn a_dead_taxel_at_the_edge_is_reported_within_100_frames() {
    for (row, column) in [(0, 8), (16, 0), (0, 0), (31, 15)] {
        let pressed = |taxel: usize| {
            let (y, x) = ((taxel / COLUMNS).abs_diff(row), (taxel % COLUMNS).abs_diff(column));
            taxel < 32 * COLUMNS && y.max(x) <= 3 && y + x > 0
        };
        let found = found(&mut WatchedBoard::new(), FRAMES + 11, pressed);
        let [(taxel, frame, TaxelHealth::Dead)] = found[..] else { panic!("{found:?}") };
        assert_eq!((taxel / COLUMNS, taxel % COLUMNS), (row, column));
        assert!(frame < FRAMES, "frame {frame}");
    }
}

/// A thick ring looks like a cover over a dead taxel, until that taxel is pressed itself.
#[test]
fn a_dead_taxel_that_answers_is_taken_back() {
    let mut watched = WatchedBoard::new();
    let middle = MIDDLE.0 * COLUMNS + MIDDLE.1;
    let thick = |(y, x): (usize, usize)| y.max(x) <= 3 && y + x > 0;
    assert_eq!(found(&mut watched, FRAMES + 11, |taxel| from_middle(taxel).is_some_and(thick)).len(), 1);
    assert_eq!(watched.board.state().condition.gain()[middle], 0);
    let mut rng = fastrand::Rng::with_seed(6);
    watched.show(4, |_| codes(&mut rng, |taxel| taxel == middle));
    assert_eq!(watched.board.health_of(middle), TaxelHealth::Good);
    assert_eq!(watched.board.state().condition.gain()[middle], 4096);
}
