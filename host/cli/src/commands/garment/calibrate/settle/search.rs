//! Finds the shortest settling time by bisection over the board's actual times.

use super::residue::{Residue, Steps, steps};
use anyhow::{Context, Result, bail};
use taxel_core::acquire::{Plan, check_duration};
use taxel_core::garment::{Circuit, Garment, Layout, Pins};

/// Full scale of the converter, counts.
const FULL: f64 = 4095.0;
/// Initial frames of a scan, and most frames that noise may require.
const FRAMES: (u32, u32) = (16, 256);
/// Initial and longest settling time of slow scans, ns.
const SLOW: (u32, u32) = (200_000, 3_200_000);
/// Shortest settling time that is tried, ns.
const QUICK: u32 = 100;
/// Final ratio of the bisection's bounds.
const CLOSE: f64 = 1.03;
/// Standard errors that must lie within the limit: for the input that is read first and decides, and for the
/// others.
const SURE: [f64; 2] = [8.0, 3.0];

/// A board with adjustable settling time.
pub trait Scanner {
    /// Mean codes by taxel of `frames` frames with this settling time, ns.
    fn scan(&mut self, settle_ns: u32, frames: u32) -> Result<Vec<f64>>;
}

/// Result of the search.
#[derive(Debug, Clone, PartialEq)]
pub struct Settled {
    /// Shortest settling time, ns.
    pub settle_ns: u32,
    /// Residue of a full-scale step, counts.
    pub residue_counts: f64,
    /// Standard error of the residue, counts.
    pub error_counts: f64,
    /// Settling time of the slow scans, ns.
    pub slow_ns: u32,
    /// Converter inputs whose lines were measured.
    pub measured: Vec<u8>,
    /// Inputs whose image had too few steps.
    pub unmeasured: Vec<u8>,
}

/// One comparison.
struct Trial {
    /// Largest residue of the inputs with contrast.
    worst: Residue,
    measured: Vec<u8>,
}

struct Search<'a, S> {
    scanner: &'a mut S,
    steps: Vec<Steps>,
    /// Allowed share of a full-scale step.
    bar: f64,
    slow_ns: u32,
    frames: u32,
}

/// Finds the shortest settling time that leaves at most `counts` of a full-scale step. The image must have
/// edges and stay unchanged meanwhile. An error says what is missing.
pub fn settle(scanner: &mut impl Scanner, garment: &Garment, counts: f64) -> Result<Settled> {
    let layout = Layout::build(garment, usize::from(u16::MAX), 4095)?;
    let circuit =
        Circuit::build(garment, &layout, Pins::ANY).with_context(|| format!("garment {}", garment.name))?;
    let mut search =
        Search { scanner, steps: steps(&circuit), bar: counts / FULL, slow_ns: SLOW.0, frames: FRAMES.0 };
    let longest = longest_ns(garment, &layout)?;
    while search.is_unsettled()? {
        search.slow_ns *= 2;
        if 2 * search.slow_ns > longest {
            bail!(
                "not sure: the codes have not settled after {} us, or the press does not hold still; a board takes \
                 at most {} us of settling for this garment",
                search.slow_ns / 1000,
                longest / 1000
            );
        }
    }
    let (mut short, mut long) = (QUICK, search.slow_ns);
    let mut best = search.trial(long, long)?;
    while f64::from(long) > CLOSE * f64::from(short) {
        let middle = (f64::from(short) * f64::from(long)).sqrt().round() as u32;
        if middle == short || middle == long {
            break;
        }
        let trial = search.trial(middle, search.slow_ns)?;
        // Including its error, so that the result is reliable.
        if trial.worst.part + trial.worst.error <= search.bar {
            (long, best) = (middle, trial);
        } else {
            short = middle;
        }
    }
    let unmeasured =
        search.steps.iter().map(|s| s.input).filter(|input| !best.measured.contains(input)).collect();
    Ok(Settled {
        settle_ns: long,
        residue_counts: best.worst.part.max(0.0) * FULL,
        error_counts: best.worst.error * FULL,
        slow_ns: search.slow_ns,
        measured: best.measured,
        unmeasured,
    })
}

/// Longest of the tried settling times that a board accepts for this garment: a longer frame would keep it
/// from its watchdog.
fn longest_ns(garment: &Garment, layout: &Layout) -> Result<u32> {
    let mut slower = garment.clone();
    slower.wiring.settle_ns = 2 * SLOW.1;
    while slower.wiring.settle_ns > 0
        && check_duration(&Circuit::build(&slower, layout, Pins::ANY)?, &Plan::default()).is_err()
    {
        slower.wiring.settle_ns /= 2;
    }
    Ok(slower.wiring.settle_ns)
}

impl<S: Scanner> Search<'_, S> {
    /// True if slow scans leave more than a quarter of the limit. Takes more frames while that may be noise.
    fn is_unsettled(&mut self) -> Result<bool> {
        loop {
            let worst = self.trial(self.slow_ns, 2 * self.slow_ns)?.worst;
            let beyond = worst.part - self.bar / 4.0;
            if beyond <= 0.0 {
                return Ok(false);
            }
            if beyond > 3.0 * worst.error || self.frames >= FRAMES.1 {
                return Ok(true);
            }
            self.frames *= 2;
        }
    }

    /// Compares quick scans with slow ones before and after, with as many frames as the noise requires.
    fn trial(&mut self, quick_ns: u32, slow_ns: u32) -> Result<Trial> {
        loop {
            let before = self.scanner.scan(slow_ns, self.frames)?;
            let quick = self.scanner.scan(quick_ns, self.frames)?;
            let after = self.scanner.scan(slow_ns, self.frames)?;
            let slow: Vec<f64> = before.iter().zip(&after).map(|(a, b)| (a + b) / 2.0).collect();
            let residues: Vec<Residue> =
                self.steps.iter().map(|steps| steps.residue(&slow, &quick)).collect();
            // Far from the limit, a large residue may have a large error.
            let clear = |index: &usize| {
                let residue = &residues[*index];
                SURE[usize::from(*index > 0)] * residue.error <= self.bar
                    || (residue.part - self.bar).abs() > 4.0 * residue.error
            };
            let seen: Vec<usize> = (0..residues.len()).filter(clear).collect();
            if seen.first() == Some(&0) {
                // Another line decides if it is slower, not if it is only noisier.
                let slower = |a: Residue, b: Residue| if b.part - 2.0 * b.error > a.part { b } else { a };
                let worst = seen.iter().map(|index| residues[*index]).reduce(slower).unwrap_or(residues[0]);
                let measured = seen.iter().map(|index| self.steps[*index].input).collect();
                return Ok(Trial { worst, measured });
            }
            if self.frames >= FRAMES.1 {
                let input = self.steps.first().map_or(0, |steps| steps.input);
                bail!(
                    "not sure: the picture has too few edges, or it moves; lay something with an edge on a panel that \
                     GP{input} reads, heavy enough for some hundred counts, and leave it there"
                );
            }
            self.frames *= 2;
        }
    }
}
