//! Compares the descriptor with floats and definitions, and tests the recognition by a gallery.

extern crate std;

use super::*;
use crate::format::{Q15, name};
use heapless::Vec as Few;
use std::vec::Vec;

/// A patch of random domes, with holes, from a small generator.
fn patch(seed: u32, columns: usize, rows: usize, peak: u32) -> Vec<u16> {
    let mut state = seed.wrapping_mul(2_654_435_761) | 1;
    let mut next = |n: u32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) % n
    };
    let domes: Vec<[i64; 3]> = (0..1 + next(3))
        .map(|_| {
            [
                next(columns as u32).into(),
                next(rows as u32).into(),
                i64::from(2 + next(columns as u32 / 2 + 1)),
            ]
        })
        .collect();
    let value = |at: usize| {
        let (x, y) = ((at % columns) as i64, (at / columns) as i64);
        let height =
            |[cx, cy, r]: &[i64; 3]| (1000 - 1000 * ((x - cx).pow(2) + (y - cy).pow(2)) / (r * r)).max(0);
        domes.iter().map(height).max().unwrap_or(0) as u32
    };
    (0..columns * rows).map(|at| if next(12) == 0 { 0 } else { (value(at) * peak / 1000) as u16 }).collect()
}

/// Taxels with their places.
fn taxels(values: &[u16], columns: usize) -> Vec<(f64, f64, f64)> {
    let place = |(at, f): (usize, &u16)| ((at % columns) as f64, (at / columns) as f64, f64::from(*f));
    values.iter().enumerate().filter(|(_, f)| **f > 0).map(place).collect()
}

/// Sum of a term over taxels.
fn sum(taxels: &[(f64, f64, f64)], term: impl Fn(f64, f64, f64) -> f64) -> f64 {
    taxels.iter().map(|(x, y, f)| term(*x, *y, *f)).sum()
}

/// Mass, centroid, J, and anisotropy of taxels.
fn central(taxels: &[(f64, f64, f64)]) -> (f64, f64, f64, f64, f64) {
    let m = sum(taxels, |_, _, f| f);
    let (cx, cy) = (sum(taxels, |x, _, f| x * f) / m, sum(taxels, |_, y, f| y * f) / m);
    let a = sum(taxels, |x, _, f| (x - cx).powi(2) * f);
    let b = sum(taxels, |_, y, f| (y - cy).powi(2) * f);
    let c = sum(taxels, |x, y, f| (x - cx) * (y - cy) * f);
    let share = if a + b > 0.0 { (a - b).hypot(2.0 * c) / (a + b) } else { 0.0 };
    (m, cx, cy, a + b, share)
}

/// The measures as the table of [`descriptor`] defines them, in its steps.
fn reference(values: &[u16], columns: usize) -> [f64; MEASURES] {
    let touched = taxels(values, columns);
    let covered: Vec<_> = touched.iter().map(|(x, y, _)| (*x, *y, 1.0)).collect();
    let (m, cx, cy, j, share) = central(&touched);
    let (a, ax, ay, ja, share_area) = central(&covered);
    let peak = touched.iter().map(|t| t.2).fold(0.0, f64::max);
    let s2 = sum(&touched, |_, _, f| f * f);
    let narrow = (j - m / 6.0).max(m / 12.0);
    let nmi = |j: f64| j.sqrt() / m;
    // sum z^n r^k f
    let harmonic = |n: i32, k: i32| {
        let part = |turn: f64| {
            sum(&touched, |x, y, f| {
                let (r, angle) = ((x - cx).hypot(y - cy), (y - cy).atan2(x - cx));
                r.powi(n + k) * (f64::from(n) * angle - turn).cos() * f
            })
        };
        part(0.0).hypot(part(std::f64::consts::FRAC_PI_2))
    };
    let r4 = sum(&touched, |x, y, f| ((x - cx).powi(2) + (y - cy).powi(2)).powi(2) * f);
    let at = |x: f64, y: f64| {
        let inside = x >= 0.0 && y >= 0.0 && x < columns as f64;
        let value = values.get(y as usize * columns + x as usize).filter(|_| inside);
        value.map_or(0.0, |f| f64::from(*f))
    };
    let beside =
        |x: f64, y: f64| [(x - 1.0, y), (x + 1.0, y), (x, y - 1.0), (x, y + 1.0)].map(|(x, y)| at(x, y));
    let count = |low: f64| touched.iter().filter(|t| t.2 >= low).count() as f64;
    let sides = |low: f64| {
        let high = touched.iter().filter(|t| t.2 >= low);
        high.map(|(x, y, _)| beside(*x, *y).iter().filter(|f| **f < low).count()).sum::<usize>() as f64
    };
    let rim: Vec<_> = touched.iter().filter(|(x, y, _)| beside(*x, *y).contains(&0.0)).collect();
    let sobel = |x: f64, y: f64| {
        let line = |dx: f64, dy: f64| {
            at(x + dx + dy, y + dy + dx) + 2.0 * at(x + dx, y + dy) + at(x + dx - dy, y + dy - dx)
        };
        (line(1.0, 0.0) - line(-1.0, 0.0)).hypot(line(0.0, 1.0) - line(0.0, -1.0))
    };
    let slope = rim.iter().map(|(x, y, _)| sobel(*x, *y) / 8.0).sum::<f64>() / rim.len() as f64 / peak;
    let falls = sum(&touched, |x, y, f| beside(x, y).iter().map(|g| (f - g).max(0.0)).sum());
    let around =
        |x: f64, y: f64| (0..9).map(move |i| (x + f64::from(i % 3) - 1.0, y + f64::from(i / 3) - 1.0));
    let summits = touched.iter().filter(|(x, y, f)| around(*x, *y).all(|(x, y)| at(x, y) <= *f)).count();
    let euler = euler(values, columns);
    let log = |x: f64| x.log2() * 1024.0;
    let ratio = |x: f64| x.min(7.9999) * 4096.0;
    let by = |x: f64, size: f64| if j > 0.0 { ratio(x / size) } else { 0.0 };
    [
        log(nmi(j.max(m / 12.0)) * (s2 / m).sqrt()),
        log(nmi(narrow) * (s2 / m).sqrt()),
        log(nmi(narrow) * peak.sqrt()),
        log((ja - a / 6.0).max(a / 12.0).sqrt() / a),
        ratio(share),
        ratio(share_area),
        if j > 0.0 { log(m * r4 / j / j) } else { 0.0 },
        by(harmonic(1, 2), m * (j / m).powf(1.5)),
        by(harmonic(3, 0), (m * r4.powi(3)).powf(0.25)),
        by(harmonic(4, 0), r4),
        by((ax - cx).hypot(ay - cy), (j / m).sqrt()),
        log(m / a / peak),
        log(s2 / m / peak),
        log(m),
        log(a),
        log(count(peak / 2.0) / a),
        log(count(peak * 0.75) / a),
        log(sides(0.5) / a.sqrt()),
        log(sides(peak / 2.0) / count(peak / 2.0).sqrt()),
        log(slope + 1.0 / 64.0),
        log(rim.len() as f64 / a),
        log(falls / m),
        log(1.0 + summits as f64),
        f64::from(euler.signum()) * log(1.0 + f64::from(euler.abs())),
    ]
}

/// Parts (joined over corners) minus holes (joined over sides), by flood fill.
fn euler(values: &[u16], columns: usize) -> i32 {
    let (wide, high) = (columns + 2, values.len() / columns + 2);
    let mut left: Vec<u8> = (0..wide * high)
        .map(|at| {
            let (x, y) = (at % wide, at / wide);
            let inside = x > 0 && y > 0 && x <= columns && y < high - 1;
            u8::from(inside && values[(y - 1) * columns + x - 1] > 0)
        })
        .collect();
    // 0 and 1 are not filled yet, 2 is.
    let (mut parts, mut holes) = (0, -1);
    for start in 0..left.len() {
        let kind = left[start];
        match kind {
            0 => holes += 1,
            1 => parts += 1,
            _ => continue,
        }
        let mut open = std::vec![start];
        while let Some(at) = open.pop() {
            if left[at] != kind {
                continue;
            }
            left[at] = 2;
            let (x, y) = ((at % wide) as i32, (at / wide) as i32);
            for (dx, dy) in (0..9).map(|i| (i % 3 - 1, i / 3 - 1)) {
                let near = kind == 1 || dx == 0 || dy == 0;
                let (x, y) = (x + dx, y + dy);
                if near && x >= 0 && y >= 0 && x < wide as i32 && y < high as i32 {
                    open.push(y as usize * wide + x as usize);
                }
            }
        }
    }
    parts - holes
}

/// Steps that a measure may be off: two for logarithms of exact sums; a Sobel magnitude loses up to an eighth
/// of a count; measures with rounded coordinates are 1/32 off for a small touch in a patch of 64 columns.
fn bound(measure: &str) -> f64 {
    match measure {
        "anisotropy" | "anisotropy_area" | "offset" => 1.0,
        "slope" => 40.0,
        "kurtosis" => 12.0,
        "lean" | "three" | "four" => 128.0,
        _ => 2.0,
    }
}

#[test]
fn measures_are_those_of_the_table() {
    let sizes = [(1, 1), (3, 2), (5, 7), (9, 4), (16, 16), (28, 20), (64, 32)];
    let mut worst = [0.0f64; MEASURES];
    for seed in 0..210 {
        let (columns, rows) = sizes[seed as usize % sizes.len()];
        let values = patch(seed, columns, rows, [255, 4095, 300][seed as usize / 7 % 3]);
        if values.iter().all(|value| *value == 0) {
            continue;
        }
        let have = descriptor(&Patch::new(&values, columns));
        let want = reference(&values, columns);
        for i in 0..MEASURES {
            let error = (f64::from(have[i]) - want[i]).abs();
            worst[i] = worst[i].max(error);
            let measure = MEASURE_NAMES[i];
            assert!(
                error <= bound(measure),
                "{measure}: {} instead of {}, {columns} x {rows}, {seed}",
                have[i],
                want[i]
            );
        }
    }
    std::println!("{worst:.1?}");
}

#[test]
fn a_touch_is_itself_wherever_and_however_it_is_turned() {
    let values = patch(4, 12, 9, 4095);
    let upright = descriptor(&Patch::new(&values, 12));
    let turned: Vec<u16> = (0..108).map(|at| values[(8 - at % 9) * 12 + at / 9]).collect();
    let mirrored: Vec<u16> = (0..108).map(|at| values[at / 12 * 12 + 11 - at % 12]).collect();
    for (other, columns) in [(turned, 9), (mirrored, 12)] {
        for (a, b) in descriptor(&Patch::new(&other, columns)).iter().zip(upright) {
            assert!(a.abs_diff(b) <= 40, "{a} {b}");
        }
    }
    // Empty margins change nothing but the rounding of coordinates.
    let framed: Vec<u16> = (0..13 * 14)
        .map(|at| {
            let (x, y) = (at % 14, at / 14);
            if (1..13).contains(&x) && (2..11).contains(&y) { values[(y - 2) * 12 + x - 1] } else { 0 }
        })
        .collect();
    for (a, b) in descriptor(&Patch::new(&framed, 14)).iter().zip(upright) {
        assert!(a.abs_diff(b) <= 40, "{a} {b}");
    }
}

#[test]
fn nothing_is_too_odd_to_be_described() {
    assert_eq!(descriptor(&Patch::new(&[], 0)), [0; MEASURES]);
    assert_eq!(descriptor(&Patch::new(&[0; 30], 7)), [0; MEASURES]);
    for (count, columns) in [(1, 1), (4096, 64), (4096, 1), (4096, 4096), (4095, 64), (2, 5000)] {
        for value in [1, 4095, u16::MAX] {
            let values = std::vec![value; count];
            let described = descriptor(&Patch::new(&values, columns));
            assert!(described[12].abs() <= 2, "even pressure: the mean is the peak");
        }
    }
}

fn gallery() -> Gallery<8> {
    let mut weights = Few::new();
    for measure in [13, 14] {
        let mut row = [0; MEASURES];
        row[measure] = 2;
        let _ = weights.push(row);
    }
    let exemplar = |class, x, y| {
        let mut at = Point::default();
        (at[0], at[1]) = (x, y);
        Exemplar { class, at }
    };
    let confidence = ConfidenceTable {
        shares: [8192, 16384, 32768],
        distances: [10, 20, 30],
        right: [[16384; 4], [20000; 4], [30000; 4], [32768; 4]],
    };
    let prototypes = [exemplar(0, 0, 0), exemplar(0, 100, 0), exemplar(1, 1000, 0), exemplar(1, 1100, 0)];
    Gallery {
        names: ["low", "high"].into_iter().map(name).collect(),
        space: Space { origin: [0; MEASURES], weights, shift: 1 },
        k: 3,
        reject: 400,
        confidence,
        prototypes: Few::from_slice(&prototypes).unwrap(),
    }
}

#[test]
fn the_nearer_neighbours_decide() {
    let gallery = gallery();
    assert!(gallery.check().is_ok());
    let at = |x| {
        let mut descriptor = [0; MEASURES];
        descriptor[13] = x;
        gallery.recognise(&descriptor)
    };
    let hit = at(0);
    assert_eq!((hit.class, hit.distance), (Some(0), 0));
    // 1/16 and 1/116 against 1/1016
    let share = (1.0 / 16.0 + 1.0 / 116.0) / (1.0 / 16.0 + 1.0 / 116.0 + 1.0 / 1016.0);
    assert!((hit.share.to_f64() - share).abs() < 1e-4, "{}", hit.share.to_f64());
    assert_eq!(hit.confidence, Q15(30000));
    assert_eq!(at(1040).class, Some(1));
    let far = at(1600);
    assert_eq!((far.class, far.confidence, far.distance), (None, Q15(0), 500));
    assert_eq!(at(-401).class, None);
    assert_eq!(at(-400).class, Some(0));
}

#[test]
fn a_wrong_gallery_is_refused() {
    let refused = |change: fn(&mut Gallery<8>)| {
        let mut gallery = gallery();
        change(&mut gallery);
        gallery.check().unwrap_err().parameter
    };
    assert_eq!(refused(|g| g.prototypes.clear()), "shapes.prototypes");
    assert_eq!(refused(|g| g.names.truncate(1)), "shapes.names");
    assert_eq!(refused(|g| g.space.weights.clear()), "shapes.space");
    assert_eq!(refused(|g| g.space.shift = 31), "shapes.space");
    assert_eq!(refused(|g| g.k = 0), "shapes.k");
    assert_eq!(refused(|g| g.reject = 0), "shapes.reject");
    assert_eq!(refused(|g| g.confidence.right[3][3] = 32769), "shapes.sureness");
    // Any gallery gives a result without a panic.
    let mut odd = gallery();
    odd.k = 255;
    odd.space.shift = 255;
    odd.prototypes.clear();
    assert_eq!(odd.recognise(&[i16::MIN; MEASURES]).class, None);
}
