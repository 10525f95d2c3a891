//! Builds a garment from the readings of strokes.

use super::ask::{Ask, Gesture, blocks_along, extent};
use super::bundle::Bundle;
use super::reading::{Blocks, Reading, StrokedBlock};
use taxel_core::garment::{Block, Coding, Garment, Group, Line, Orientation};

/// Margin below which the side of a block is undecided.
const SIDE: f64 = 0.2;

/// A stroke with its reading.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stroke<'a> {
    /// Number of its step.
    pub step: usize,
    pub ask: &'a Ask,
    pub reading: &'a Reading,
}

/// A step to be repeated, and the reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Unclear {
    pub step: usize,
    pub why: String,
}

/// Address lines of one direction within the blocks.
#[derive(Debug, Clone, Default, PartialEq)]
struct Wires {
    lines: Vec<usize>,
    inverted: Vec<bool>,
}

impl Wires {
    /// Code of an address on these lines.
    fn code(&self, address: usize) -> usize {
        let bit = |(rank, (line, inverted)): (usize, (&usize, &bool))| {
            usize::from((address >> line & 1 == 1) != *inverted) << rank
        };
        self.lines.iter().zip(&self.inverted).enumerate().map(bit).sum()
    }

    fn group(&self, bundle: &Bundle) -> Group {
        let line = |(line, inverted): (&usize, &bool)| Line { pin: bundle.lines[*line], inverted: *inverted };
        Group { coding: Coding::Binary, lines: self.lines.iter().zip(&self.inverted).map(line).collect() }
    }
}

/// Returns the garment that the strokes show, and the least margin of all decisions. Blocks of panels without
/// strokes stay as in the template.
pub(super) fn assemble(
    template: &Garment,
    bundle: &Bundle,
    strokes: &[Stroke<'_>],
) -> Result<(Garment, f64), Unclear> {
    let lines = directions(template, strokes)?;
    let within: Vec<usize> = lines.concat();
    let rest: Vec<usize> = (0..bundle.lines.len()).filter(|line| !within.contains(line)).collect();
    let mask = within.iter().map(|line| 1 << line).sum();
    let mut wires = lines.map(|lines| Wires { lines, inverted: Vec::new() });
    let mut margin = 1.0f64;
    let mut seen = Vec::new();
    for stroke in strokes {
        let unclear = |why: String| Unclear { step: stroke.step, why };
        let blocks = blocks_along(template, stroke.ask);
        let Blocks { felt, inverted, margin: clear } =
            stroke.reading.blocks(mask, blocks.len()).map_err(unclear)?;
        margin = margin.min(stroke.reading.margin).min(clear);
        if let Some(wires) = wires.iter_mut().find(|wires| wires.lines == stroke.reading.fine) {
            if wires.inverted.is_empty() {
                wires.inverted = inverted;
            } else if wires.inverted != inverted {
                return Err(unclear("it showed other lines inverted than the strokes before".into()));
            }
        }
        seen.push((stroke, blocks, felt));
    }
    let [rows, columns] = wires;
    let select = Wires { inverted: vec![false; rest.len()], lines: rest };
    let mut garment = template.clone();
    garment.wiring.row = rows.group(bundle);
    garment.wiring.column = columns.group(bundle);
    garment.wiring.block = select.group(bundle);
    for (stroke, blocks, felt) in seen {
        let Gesture::Down { column, from } = stroke.ask.gesture else { continue };
        for (index, felt) in blocks.into_iter().zip(felt) {
            let Some(block) = garment.blocks.get_mut(index) else { continue };
            let transposed = runs_crosswise(block, stroke.reading, &rows);
            let across = if transposed { &rows } else { &columns };
            let (mirror_x, clear) = side(&felt, across, extent(block).0, column - from);
            if clear < SIDE {
                let why = "it was not clear on which side of its blocks the finger was".into();
                return Err(Unclear { step: stroke.step, why });
            }
            margin = margin.min(clear);
            let address = felt.traces.first().map_or(0, |trace| trace.address);
            block.orientation = Orientation { transposed, mirror_x, mirror_y: !felt.rising };
            block.input = bundle.inputs[bundle.split(address).0];
            block.select = select.code(address) as u16;
        }
    }
    Ok((garment, margin))
}

/// Lines of the rows and of the columns, on which all strokes must agree.
fn directions(template: &Garment, strokes: &[Stroke<'_>]) -> Result<[Vec<usize>; 2], Unclear> {
    let mut known: [Option<&Vec<usize>>; 2] = [None, None];
    for stroke in strokes {
        let lines = &stroke.reading.fine;
        let blocks = blocks_along(template, stroke.ask);
        let Some(block) = blocks.first().and_then(|index| template.blocks.get(*index)) else { continue };
        let down = matches!(stroke.ask.gesture, Gesture::Down { .. });
        let mut direction = usize::from(down == block.orientation.transposed);
        // A square block fits in either orientation.
        if block.rows == block.columns && known[1 - direction] == Some(lines) {
            direction = 1 - direction;
        }
        let shared = |other: &Vec<usize>| other.iter().any(|line| lines.contains(line));
        if known[direction].is_some_and(|before| before != lines) || known[1 - direction].is_some_and(shared)
        {
            let why = "it showed other address lines than the strokes before".into();
            return Err(Unclear { step: stroke.step, why });
        }
        known[direction] = Some(lines);
    }
    Ok(known.map(|lines| lines.cloned().unwrap_or_default()))
}

/// True if the wired columns of a block run down the panel.
fn runs_crosswise(block: &Block, down: &Reading, rows: &Wires) -> bool {
    if block.rows == block.columns { down.fine != rows.lines } else { block.orientation.transposed }
}

/// Returns whether x runs against the wiring in a block of this width that was stroked along column `at`, and
/// the margin of that decision.
fn side(felt: &StrokedBlock, across: &Wires, width: u16, at: u16) -> (bool, f64) {
    let (last, at) = (f64::from(width - 1), f64::from(at));
    if width == 1 {
        return (false, 1.0);
    }
    let sum: f64 = felt.traces.iter().map(|trace| trace.sum).sum();
    let mean = felt.traces.iter().map(|t| across.code(t.address) as f64 * t.sum).sum::<f64>() / sum;
    let (plain, mirrored) = ((mean - at).abs(), (last - mean - at).abs());
    (mirrored < plain, (mirrored - plain).abs() / (last - 2.0 * at).abs())
}
