//! The shortest settling: bisection over what the board really does.

use super::residue::{Residue, Steps, steps};
use anyhow::{Context, Result, bail};
use taxel_core::acquire::{Plan, check_duration};
use taxel_core::garment::{Circuit, Garment, Layout, Pins};

/// Full scale of the converter, counts.
const FULL: f64 = 4095.0;
/// Frames of a scan at first, and at most where noise asks for more.
const FRAMES: (u32, u32) = (16, 256);
/// Slow settling to begin with, and at most, ns.
const SLOW: (u32, u32) = (200_000, 3_200_000);
/// Shortest settling that is tried, ns.
const QUICK: u32 = 100;
/// The bracket is closed to this ratio.
const CLOSE: f64 = 1.03;
/// Standard errors that must lie within the bar: of the input that is read first and decides, and of the
/// others.
const SURE: [f64; 2] = [8.0, 3.0];

/// A board that can be told how long to settle.
pub trait Scanner {
    /// Mean codes by taxel of that many frames with that settling, ns.
    fn scan(&mut self, settle_ns: u32, frames: u32) -> Result<Vec<f64>>;
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Settled {
    /// Shortest settling, ns.
    pub settle_ns: u32,
    /// What it leaves of a full-scale step, counts.
    pub residue_counts: f64,
    /// Standard error of that, counts.
    pub error_counts: f64,
    /// Settling that counted as slow, ns.
    pub slow_ns: u32,
    /// Converter inputs whose lines were measured.
    pub measured: Vec<u8>,
    /// Those where the picture had too few steps.
    pub unmeasured: Vec<u8>,
}

/// One comparison.
struct Trial {
    /// The largest of the inputs that have contrast.
    worst: Residue,
    measured: Vec<u8>,
}

struct Search<'a, S> {
    scanner: &'a mut S,
    steps: Vec<Steps>,
    /// Part of a full-scale step that may be left.
    bar: f64,
    slow_ns: u32,
    frames: u32,
}

/// Finds the shortest settling that leaves at most `counts` of a full-scale step. The picture must stay as it
/// is meanwhile, and have edges. An error says what is missing.
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
        // With its error, so that what is found keeps what it says.
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

/// The longest settling that a board takes for this garment, of those that are tried: a longer frame would
/// keep it from its watchdog.
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
    /// Whether slow scans leave more than a quarter of the bar; more frames are taken as long as that may be
    /// noise.
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

    /// Compares quick scans with slow ones before and after, with as many frames as the noise asks for.
    fn trial(&mut self, quick_ns: u32, slow_ns: u32) -> Result<Trial> {
        loop {
            let before = self.scanner.scan(slow_ns, self.frames)?;
            let quick = self.scanner.scan(quick_ns, self.frames)?;
            let after = self.scanner.scan(slow_ns, self.frames)?;
            let slow: Vec<f64> = before.iter().zip(&after).map(|(a, b)| (a + b) / 2.0).collect();
            let residues: Vec<Residue> =
                self.steps.iter().map(|steps| steps.residue(&slow, &quick)).collect();
            // Far from the bar, a large error of a large residue does no harm.
            let clear = |index: &usize| {
                let residue = &residues[*index];
                SURE[usize::from(*index > 0)] * residue.error <= self.bar
                    || (residue.part - self.bar).abs() > 4.0 * residue.error
            };
            let seen: Vec<usize> = (0..residues.len()).filter(clear).collect();
            if seen.first() == Some(&0) {
                // Another line counts where it is slower, not where its noise is larger.
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
