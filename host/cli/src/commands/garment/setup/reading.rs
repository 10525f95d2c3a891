//! Derives address lines from a stroke.
//!
//! Two addresses that differ in one line are two taxels. If the line belongs to the direction of the stroke,
//! the finger passes both, and the time between is that of 1, 2, 4, ... taxels: the rank of the line. If it
//! belongs to the other direction, the finger passes one of them, or both at once. This needs no knowledge of
//! where the finger was, nor of its speed.

use super::bundle::Bundle;
use super::touch::{Touch, Trace};
use std::collections::BTreeMap;

/// A block counts as stroked from this share of the strongest block's sum; below it, it was touched across a
/// seam at an end of the stroke.
const BLOCK: f64 = 0.15;

/// Address lines derived from a stroke.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Lines of the address within a block along the stroke, least significant first.
    pub fine: Vec<usize>,
    /// Signal of each address.
    pub traces: Vec<Trace>,
    /// Time from taxel to taxel, s.
    pub step: f64,
    /// Margin of the decisions: 1 is ideal, 0 is undecided.
    pub margin: f64,
}

/// Blocks of a stroke, once the lines that select blocks are known.
#[derive(Debug, Clone, PartialEq)]
pub struct Blocks {
    /// Blocks in the order of the stroke.
    pub felt: Vec<StrokedBlock>,
    /// Which of the fine lines are inverted, if the most significant is not.
    pub inverted: Vec<bool>,
    /// Margin of the directions.
    pub margin: f64,
}

/// A stroked block.
#[derive(Debug, Clone, PartialEq)]
pub struct StrokedBlock {
    /// Signals of its addresses.
    pub traces: Vec<Trace>,
    /// True if the code of the fine lines rises along the stroke.
    pub rising: bool,
}

/// A line, and the time between addresses that differ in it, in taxels.
struct Gap {
    line: usize,
    taxels: f64,
    /// Share of addresses whose counterpart was felt as well.
    paired: f64,
}

impl Reading {
    /// Reads a stroke over `taxels` taxels, with `fine` lines along a block. An error says what is unclear.
    pub fn of(bundle: &Bundle, touch: &Touch, taxels: u16, fine: usize) -> Result<Reading, String> {
        let traces = touch.traces();
        let times = || traces.iter().map(|trace| trace.time);
        let (first, last) = (times().fold(f64::MAX, f64::min), times().fold(f64::MIN, f64::max));
        let step = (last - first) / f64::from(taxels.max(2) - 1);
        if traces.len() < usize::from(taxels) / 2 || step <= 0.0 {
            return Err("too few taxels were felt along the way".into());
        }
        let gaps: Vec<Gap> = (0..bundle.lines.len()).map(|line| gap(&traces, line, step)).collect();
        let (fine, margin) = ranked(&gaps, fine)?;
        Ok(Reading { fine, traces, step, margin })
    }

    /// Returns the `count` blocks that were stroked; `within` has a bit for each line that does not select a
    /// block.
    pub fn blocks(&self, within: usize, count: usize) -> Result<Blocks, String> {
        let mut parts = BTreeMap::<usize, Vec<Trace>>::new();
        self.traces.iter().for_each(|trace| parts.entry(trace.address & !within).or_default().push(*trace));
        let sum = |traces: &[Trace]| traces.iter().map(|trace| trace.sum).sum::<f64>();
        let most = parts.values().map(|part| sum(part)).fold(0.0, f64::max);
        let mut parts: Vec<_> = parts.into_values().filter(|part| sum(part) >= BLOCK * most).collect();
        if parts.len() != count {
            return Err(format!("{} blocks were felt instead of {count}", parts.len()));
        }
        let time = |part: &[Trace]| part.iter().map(|t| t.time * t.sum).sum::<f64>() / sum(part);
        parts.sort_by(|a, b| time(a).total_cmp(&time(b)));
        let mut inverted = None;
        let (mut felt, mut margin) = (Vec::new(), 1.0);
        for traces in parts {
            let rises = directions(&traces, &self.fine, self.step, &mut margin)?;
            let rising = rises.last().copied().unwrap_or(true);
            let turned: Vec<bool> = rises.iter().map(|rise| *rise != rising).collect();
            if *inverted.get_or_insert_with(|| turned.clone()) != turned {
                return Err("the blocks along the way contradict each other".into());
            }
            felt.push(StrokedBlock { traces, rising });
        }
        Ok(Blocks { felt, inverted: inverted.unwrap_or_default(), margin })
    }
}

/// Median time between pairs of addresses that differ in the line.
fn gap(traces: &[Trace], line: usize, step: f64) -> Gap {
    let mut taxels: Vec<f64> =
        pairs(traces, line).map(|(low, high)| (high.time - low.time).abs() / step).collect();
    taxels.sort_by(f64::total_cmp);
    let paired = 2.0 * taxels.len() as f64 / traces.len() as f64;
    Gap { line, taxels: taxels.get(taxels.len() / 2).copied().unwrap_or(0.0), paired }
}

/// Pairs of addresses that differ only in this line, low first. Traces are sorted by address.
fn pairs(traces: &[Trace], line: usize) -> impl Iterator<Item = (&Trace, &Trace)> {
    traces.iter().filter(move |trace| trace.address >> line & 1 == 0).filter_map(move |low| {
        let high = traces.binary_search_by_key(&(low.address | 1 << line), |trace| trace.address).ok()?;
        Some((low, traces.get(high)?))
    })
}

/// Returns the lines along a block by rank, and the margin of that decision.
///
/// They have the shortest times of the lines whose addresses the finger passed one after the other. Lines
/// that select blocks have longer times; the same taxel of another block may not have been touched at all, if
/// that block is oriented differently.
fn ranked(gaps: &[Gap], fine: usize) -> Result<(Vec<usize>, f64), String> {
    let mut passed: Vec<&Gap> = gaps.iter().filter(|gap| gap.paired >= 0.5 && gap.taxels >= 0.5).collect();
    passed.sort_by(|a, b| a.taxels.total_cmp(&b.taxels));
    passed.truncate(fine);
    if passed.len() < fine {
        return Err(format!("{} address lines changed along a block instead of {fine}", passed.len()));
    }
    let mut margin = 1.0f64;
    for (rank, gap) in passed.iter().enumerate() {
        margin = margin.min(1.0 - 2.0 * (gap.taxels.log2() - rank as f64).abs());
    }
    let lines: Vec<usize> = passed.iter().map(|gap| gap.line).collect();
    for gap in gaps.iter().filter(|gap| gap.paired >= 0.25 && !lines.contains(&gap.line)) {
        let (still, farther) = (1.0 - 2.0 * gap.taxels, 1.0 - 2.0 * (fine as f64 - gap.taxels.log2()));
        margin = margin.min(still.max(farther));
    }
    if margin < 0.1 {
        return Err("the stroke was too uneven to distinguish the address lines".into());
    }
    Ok((lines, margin))
}

/// Returns for each line: true if the taxel with the line high is passed after the one with it low.
fn directions(traces: &[Trace], lines: &[usize], step: f64, margin: &mut f64) -> Result<Vec<bool>, String> {
    let mut rises = Vec::new();
    for (rank, line) in lines.iter().enumerate() {
        let later: Vec<f64> = pairs(traces, *line).map(|(low, high)| (high.time - low.time) / step).collect();
        let mean = later.iter().sum::<f64>() / later.len().max(1) as f64;
        let clear = mean.abs() / f64::from(1u32 << rank);
        if clear < 0.3 {
            return Err("a block on the way was not felt clearly".into());
        }
        *margin = margin.min(clear);
        rises.push(mean > 0.0);
    }
    Ok(rises)
}
