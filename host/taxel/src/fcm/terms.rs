//! Linguistic weights: fuzzy sets of causality values over -1 ..= 1.
//!
//! | term | triangle (from, peak, to) | stands for |
//! |---|---|---|
//! | none | -0.25, 0, 0.25 | 0 |
//! | weak | 0, 0.25, 0.5 | 0.25 |
//! | medium | 0.25, 0.5, 0.75 | 0.5 |
//! | strong | 0.5, 0.75, 1 | 0.75 |
//! | very strong | 0.75, 1, 1 | 0.92 |
//!
//! A sign follows: `strong +` increases, `strong -` decreases (the mirrored triangle). Memberships of
//! neighbours add up to 1. A term stands for the centroid of its set, in hundredths. The set of a number is a
//! triangle of the same width around it, cut at -1 and 1.

use super::decimal::Decimal;

/// Terms by rising strength, with their triangles.
const TERMS: [(&str, [f64; 3]); 5] = [
    ("none", [-0.25, 0.0, 0.25]),
    ("weak", [0.0, 0.25, 0.5]),
    ("medium", [0.25, 0.5, 0.75]),
    ("strong", [0.5, 0.75, 1.0]),
    ("very strong", [0.75, 1.0, 1.0]),
];

/// Half the base of a number's triangle; the same as for terms.
const HALF: f64 = 0.25;

/// A fuzzy set: 0 up to `from`, 1 at `peak`, 0 from `to` on, linear between; vertical where two of them are
/// equal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle {
    /// Left end.
    pub from: f64,
    /// Value with membership 1.
    pub peak: f64,
    /// Right end.
    pub to: f64,
}

impl Triangle {
    /// Set of a term with its sign; none if there is no such term. `none` has no sign, all others need one.
    pub(crate) fn of_term(text: &str) -> Option<Triangle> {
        let text = text.trim();
        let (word, sign) = match text.strip_suffix('+').or_else(|| text.strip_suffix('-')) {
            Some(word) => (word.trim_end(), if text.ends_with('-') { -1.0 } else { 1.0 }),
            None => (text, 0.0),
        };
        let (at, (_, [from, peak, to])) = TERMS.iter().enumerate().find(|(_, (name, _))| *name == word)?;
        if (at == 0) != (sign == 0.0) {
            return None;
        }
        let (from, to) = if sign < 0.0 { (-to, -from) } else { (*from, *to) };
        Some(Triangle { from, peak: if sign < 0.0 { -peak } else { *peak }, to })
    }

    /// Set of a number in -1 ..= 1.
    pub fn of_number(value: f64) -> Triangle {
        Triangle { from: (value - HALF).max(-1.0), peak: value, to: (value + HALF).min(1.0) }
    }

    /// Area under the set.
    pub fn area(self) -> f64 {
        (self.to - self.from) / 2.0
    }

    /// Centroid of the area.
    pub fn centroid(self) -> f64 {
        (self.from + self.peak + self.to) / 3.0
    }

    /// Membership of a value.
    pub fn membership(self, x: f64) -> f64 {
        if x < self.from || x > self.to {
            0.0
        } else if x < self.peak {
            (x - self.from) / (self.peak - self.from)
        } else if x > self.peak {
            (self.to - x) / (self.to - self.peak)
        } else {
            1.0
        }
    }
}

/// Weight of a term.
pub(crate) fn weight_of(term: &str) -> Option<Decimal> {
    Triangle::of_term(term).map(|set| hundredths(set.centroid()))
}

/// A number in hundredths, halves rounded away from zero.
pub fn hundredths(value: f64) -> Decimal {
    Decimal::from_f64((value * 100.0).round() / 100.0).unwrap_or_default()
}

/// The terms in words.
pub fn list() -> String {
    let words: Vec<&str> = TERMS[1..].iter().map(|(name, _)| *name).collect();
    format!("none, or {} followed by + or -", words.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_stand_for_their_centroids() {
        for (term, weight) in [
            ("none", "0"),
            ("weak +", "0.25"),
            ("medium -", "-0.5"),
            ("strong+", "0.75"),
            ("very strong +", "0.92"),
            (" very strong - ", "-0.92"),
        ] {
            assert_eq!(weight_of(term).unwrap().to_string(), weight, "{term}");
        }
        for term in ["", "strong", "none +", "+", "stronger -", "0.5"] {
            assert_eq!(weight_of(term), None, "{term}");
        }
    }

    #[test]
    fn memberships_of_neighbours_add_up_to_one() {
        let sets: Vec<Triangle> = ["none", "weak +", "medium +", "strong +", "very strong +"]
            .into_iter()
            .chain(["weak -", "medium -", "strong -", "very strong -"])
            .map(|term| Triangle::of_term(term).unwrap())
            .collect();
        for at in -100..=100 {
            let sum: f64 = sets.iter().map(|set| set.membership(f64::from(at) / 100.0)).sum();
            assert!((sum - 1.0).abs() < 1e-12, "{at}: {sum}");
        }
    }
}
