//! Images that are hard on moments.

use crate::random::Noise;
use std::ops::RangeInclusive;
use taxel_core::contact::Moments;

/// Columns of the panel that most images lie on; it has 64 rows.
pub const COLUMNS: usize = 32;
const ROWS: usize = 64;

/// Taxels of one touch: x, y, counts.
pub type TouchTaxels = Vec<(u32, u32, u16)>;

/// The core's sums: of each run of taxels that follow each other in a row.
pub fn moments(taxels: &TouchTaxels) -> Moments {
    let mut sum = Moments::default();
    for run in taxels.chunk_by(|a, b| a.1 == b.1 && a.0 + 1 == b.0) {
        let values: Vec<u16> = run.iter().map(|taxel| taxel.2).collect();
        sum.add(&Moments::of_run(run[0].0, run[0].1, &values));
    }
    sum
}

fn filled(columns: RangeInclusive<u32>, rows: RangeInclusive<u32>, value: u16) -> TouchTaxels {
    rows.flat_map(|y| columns.clone().map(move |x| (x, y, value))).collect()
}

const LAST: (u32, u32) = (COLUMNS as u32 - 1, ROWS as u32 - 1);
const FULL: [u16; 3] = [1, 4095, u16::MAX];

/// Every rectangle of even pressure in the far corner, squares and lines among them, at 1 count, 12 and 16
/// bits.
pub fn rectangles() -> impl Iterator<Item = TouchTaxels> {
    let sizes = (1..=LAST.0 + 1).flat_map(|w| (1..=LAST.1 + 1).map(move |h| (w, h)));
    sizes.flat_map(|(w, h)| FULL.map(|value| filled(LAST.0 + 1 - w..=LAST.0, LAST.1 + 1 - h..=LAST.1, value)))
}

/// Every square of even pressure in the far corner with one taxel that is a count less: almost without
/// direction.
pub fn almost_isotropic() -> impl Iterator<Item = TouchTaxels> {
    let squares = (2..=32u32).flat_map(|side| FULL.into_iter().skip(1).map(move |value| (side, value)));
    squares.flat_map(|(side, value)| {
        let square = filled(LAST.0 + 1 - side..=LAST.0, LAST.1 + 1 - side..=LAST.1, value);
        [0, 1, square.len() / 2, square.len() - 1].map(|index| {
            let mut square = square.clone();
            square[index].2 -= 1;
            square
        })
    })
}

/// All 2 x 2 touches with values of 0 to 7 in the far corner, and the same next to full scale.
pub fn four_taxels() -> impl Iterator<Item = TouchTaxels> {
    (1u16..4096).flat_map(|code| {
        let taxels = |base: u16| {
            let value = |index: u32| match code >> (3 * index) & 7 {
                0 => 0,
                some => base + some,
            };
            (0..4).map(|i| (LAST.0 - 1 + i % 2, LAST.1 - 1 + i / 2, value(i))).collect::<TouchTaxels>()
        };
        [taxels(0), taxels(4088), taxels(65528)]
    })
}

/// A taxel of 1 and one of anything, at every distance.
pub fn pairs() -> impl Iterator<Item = TouchTaxels> {
    let places = (0..=LAST.1).flat_map(|y| (0..=LAST.0).map(move |x| (x, y)));
    places.skip(1).flat_map(|(x, y)| [1, 2, 4095, u16::MAX].map(|f| vec![(0, 0, 1), (x, y, f)]))
}

/// Random blobs of 2 to 25 taxels anywhere, from faint to full.
pub fn blobs(count: usize) -> impl Iterator<Item = TouchTaxels> {
    let mut noise = Noise(3);
    (0..count).map(move |_| {
        let (w, h) = (1 + noise.below(5) as u32, 1 + noise.below(5) as u32);
        let left = noise.below(u64::from(LAST.0 + 2 - w)) as u32;
        let top = noise.below(u64::from(LAST.1 + 2 - h)) as u32;
        let full = [3, 300, 4095, 65535][noise.below(4) as usize];
        let mut blob = filled(left..=left + w - 1, top..=top + h - 1, 0);
        blob.iter_mut().for_each(|taxel| taxel.2 = 1 + noise.below(full) as u16);
        blob
    })
}

/// The whole panel under a random texture of 11 bits above a threshold, and of 16 bits.
pub fn textures(count: usize) -> impl Iterator<Item = TouchTaxels> {
    let mut noise = Noise(4);
    (0..count).map(move |index| {
        let mut panel = filled(0..=LAST.0, 0..=LAST.1, 0);
        let (base, full) = if index % 2 == 0 { (120, 2048) } else { (0, 65536) };
        panel.iter_mut().for_each(|taxel| taxel.2 = base + noise.below(full) as u16);
        panel
    })
}

/// Lines one taxel wide at every slope through the panel.
pub fn lines() -> impl Iterator<Item = TouchTaxels> {
    let ends = (0..=LAST.0).map(|x| (x, LAST.1)).chain((0..=LAST.1).map(|y| (LAST.0, y)));
    ends.flat_map(|(x, y)| {
        let steps = x.max(y).max(1);
        FULL.map(|value| (0..=steps).map(|i| (x * i / steps, y * i / steps, value)).collect::<TouchTaxels>())
    })
}

/// Strips of even pressure at every angle, cut at the borders.
pub fn strips() -> impl Iterator<Item = TouchTaxels> {
    (0..500u32).map(|step| {
        let (s, c) = (f64::from(step) * 0.0137).sin_cos();
        let half = 1.0 + f64::from(step % 17) * 0.3;
        let mut panel = filled(0..=LAST.0, 0..=LAST.1, 1000);
        panel.retain(|(x, y, _)| {
            let (x, y) = (f64::from(*x) - 15.0, f64::from(*y) - 31.0);
            (x * c + y * s).abs() < 28.0 && (y * c - x * s).abs() < half
        });
        panel
    })
}

/// Crosses that are isotropic on a cloth of 12 x 10 mm, or all but: 144 times the one arm against 100 times
/// the other.
pub fn crosses() -> impl Iterator<Item = TouchTaxels> {
    let sizes = (1..=15u32).flat_map(|arm| (1..=455u32).step_by(7).map(move |k| (arm, k)));
    sizes.flat_map(|(arm, k)| {
        [0, 1, 2].map(|more| {
            let (along_x, along_y) = ((100 * k + more) as u16, (144 * k) as u16);
            let arms = (1..=arm).flat_map(|i| {
                let x = [(16 - i, 40, along_x), (16 + i, 40, along_x)];
                x.into_iter().chain([(16, 40 - i, along_y), (16, 40 + i, along_y)])
            });
            arms.collect::<TouchTaxels>()
        })
    })
}

/// All of the above but the crosses.
pub fn all() -> impl Iterator<Item = TouchTaxels> {
    let small = four_taxels().chain(pairs()).chain(blobs(10_000)).chain(lines()).chain(strips());
    rectangles().chain(almost_isotropic()).chain(small).chain(textures(200))
}
