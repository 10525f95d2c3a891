//! Checks whether a calibration still holds, and if not, why.

use super::file::Calibration;
use crate::text::date::days_between;
use std::collections::BTreeSet;
use std::fmt;

/// Tolerated movement of the garment at rest (median over taxels), as a share of the last knot's counts.
const REST: f64 = 0.02;
/// Tolerated share of taxels that have become faulty since.
const FAULTY_SHARE: f64 = 0.01;
/// Least significant error of a known press: share of it, and multiple of the calibration's own error.
const PRESS: (f64, f64) = (0.05, 3.0);

/// Tolerated change of the board's temperature, degrees. Fabrics differ in their response; a known press is a
/// better test.
const WARMTH: f64 = 10.0;

/// State of the garment now.
#[derive(Debug, Default, Clone, PartialEq)]
pub struct Seen {
    /// The calibration by the board's `Hello`.
    pub reported: String,
    /// Codes at rest by taxel number.
    pub rest: Vec<f64>,
    /// Faulty taxels.
    pub faulty: BTreeSet<u16>,
    /// Today, year-month-day.
    pub today: String,
    /// Days after which a calibration is old.
    pub days: u64,
    /// A known force, and its value by the calibration, N.
    pub press: Option<(f64, f64)>,
    /// Temperature of the board's converter, degrees; none if it has no thermometer.
    pub celsius: Option<f64>,
}

/// Reason to calibrate again.
#[derive(Debug, Clone, PartialEq)]
pub enum Reason {
    /// The board has no calibration.
    None,
    /// The board has another calibration, with this description.
    Another(String),
    /// The garment has the first number of taxels, the calibration the second.
    Garment(usize, usize),
    /// Movement of the garment at rest: counts, median over taxels, and share of the last knot's.
    Rest(f64, f64),
    /// Number of taxels that have become faulty.
    Faulty(usize),
    /// Age, days.
    Old(u64),
    /// Known force of a press, and its value by the calibration, N.
    Press(f64, f64),
    /// Temperature of the board at the calibration and now, degrees.
    Warmth(f64, f64),
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Reason::None => f.write_str("the board has no calibration: it was restarted without --save, or its garment or gains were changed"),
            Reason::Another(reported) => write!(f, "the board has another calibration ({reported})"),
            Reason::Garment(has, had) => write!(f, "the garment has {has} taxels, the calibration is of {had}"),
            Reason::Rest(counts, part) => write!(
                f,
                "the garment at rest has moved by {counts:.0} counts ({:.1} % of the heaviest weight): it was folded, used, warmed, \
                 or something lies on it",
                100.0 * part
            ),
            Reason::Faulty(count) => write!(f, "{count} taxels have become faulty since: `taxel health` lists them"),
            Reason::Old(days) => write!(f, "it is {days} days old"),
            Reason::Press(known, felt) => {
                write!(f, "{known:.2} N are felt as {felt:.2} N ({:+.1} %)", 100.0 * (felt / known - 1.0))
            }
            Reason::Warmth(then, now) => write!(
                f,
                "the board is at {now:.0} degrees, and was at {then:.0}: wait until it is there, or calibrate at the temperature of use"
            ),
        }
    }
}

/// Returns all reasons to calibrate again.
pub fn judge(calibration: &Calibration, seen: &Seen) -> Vec<Reason> {
    let mut reasons = Vec::new();
    if seen.reported.is_empty() {
        reasons.push(Reason::None);
    } else if !calibration.is_in_force(&seen.reported) {
        reasons.push(Reason::Another(seen.reported.clone()));
    }
    if seen.rest.len() != calibration.gains.len() {
        reasons.push(Reason::Garment(seen.rest.len(), calibration.gains.len()));
        return reasons;
    }
    let moved = moved(calibration, seen);
    let last = calibration.panels.iter().filter_map(|panel| panel.knots.knots().last());
    let range = last
        .map(|[x, _]| f64::from(*x) / f64::from(crate::files::calibrate::curve::PARTS))
        .fold(0.0, f64::max);
    if moved > (REST * range).max(2.0) {
        reasons.push(Reason::Rest(moved, moved / range.max(1.0)));
    }
    let faulty = seen.faulty.iter().filter(|taxel| !calibration.silent.contains(taxel)).count();
    if faulty as f64 > FAULTY_SHARE * calibration.gains.len() as f64 {
        reasons.push(Reason::Faulty(faulty));
    }
    match days_between(&calibration.date, &seen.today) {
        Some(days) if days > seen.days => reasons.push(Reason::Old(days)),
        _ => {}
    }
    if let Some((known, felt)) = seen.press
        && (felt / known - 1.0).abs() > PRESS.0.max(PRESS.1 * calibration.fit.error)
    {
        reasons.push(Reason::Press(known, felt));
    }
    if let (Some(then), Some(now)) = (calibration.celsius, seen.celsius)
        && (now - then).abs() > WARMTH
    {
        reasons.push(Reason::Warmth(then, now));
    }
    reasons
}

/// Median over the taxels of their movement at rest, counts.
fn moved(calibration: &Calibration, seen: &Seen) -> f64 {
    let well = |taxel: &usize| !seen.faulty.contains(&(*taxel as u16));
    let pairs = seen.rest.iter().zip(&calibration.rest).enumerate().filter(|(taxel, _)| well(taxel));
    let mut all: Vec<f64> = pairs.map(|(_, (now, then))| (now - f64::from(*then)).abs()).collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(0.0)
}
