//! Errors of contacts against the exact moments of the pressing discs, computed from their definition.

use serde_json::{Value, json};
use taxel_core::body::Placed;
use taxel_suite::pattern::{Disc, TouchPattern};

/// Error of one quantity.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub struct Error {
    /// Largest.
    pub largest: f64,
    squares: f64,
    count: u32,
}

impl Error {
    /// Adds the error of a value.
    pub fn add(&mut self, off: f64) {
        self.largest = self.largest.max(off.abs());
        self.squares += off * off;
        self.count += 1;
    }

    /// Root mean square.
    pub fn rms(&self) -> f64 {
        (self.squares / f64::from(self.count.max(1))).sqrt()
    }

    /// JSON form.
    pub fn json(&self) -> Value {
        json!({ "largest": self.largest, "rms": self.rms() })
    }
}

/// Place and NMI of a disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exact {
    /// Column of the centroid.
    pub x: f64,
    /// Row of the centroid.
    pub y: f64,
    /// `sqrt(J) / m sqrt(sum f^2 / m)`.
    pub nmi: f64,
}

impl Exact {
    /// Computes from the definition, in integers up to the last step.
    pub fn of(disc: Disc) -> Exact {
        let [mut m, mut sx, mut sy, mut second, mut squares] = [0i128; 5];
        for (column, row) in (-8..40).flat_map(|column| (-8..40).map(move |row| (column, row))) {
            let value = i128::from(disc.pressure(column, row));
            let (x, y) = (i128::from(column), i128::from(row));
            m += value;
            sx += x * value;
            sy += y * value;
            second += (x * x + y * y) * value;
            squares += value * value;
        }
        let inertia = (m * second - sx * sx - sy * sy) as f64 / m as f64;
        let mean = squares as f64 / m as f64;
        Exact { x: sx as f64 / m as f64, y: sy as f64 / m as f64, nmi: (inertia * mean).sqrt() / m as f64 }
    }
}

/// Errors of many contacts.
#[derive(Debug, Default, Clone)]
pub struct Truth {
    place: Error,
    nmi: Error,
}

impl Truth {
    /// Compares the contacts of a frame with its discs; a disc without a contact on its panel counts as an
    /// error of one taxel.
    pub fn compare(&mut self, pattern: TouchPattern, frame: u32, contacts: &[Placed]) {
        for disc in pattern.discs(frame) {
            let exact = Exact::of(disc);
            let off = |placed: &Placed| {
                (placed.contact.x.to_f64() - exact.x).hypot(placed.contact.y.to_f64() - exact.y)
            };
            let there = contacts.iter().filter(|c| usize::from(c.contact.panel) == disc.panel);
            match there.min_by(|a, b| off(a).total_cmp(&off(b))) {
                Some(placed) => {
                    self.place.add(off(placed));
                    self.nmi.add(placed.shape.nmi_s2.to_f64() / exact.nmi - 1.0);
                }
                None => self.place.add(1.0),
            }
        }
    }

    /// Errors of the centroid, in taxels, and of the NMI, relative; none without comparisons.
    pub fn errors(&self) -> Option<[Error; 2]> {
        (self.place.count > 0).then_some([self.place, self.nmi])
    }
}
