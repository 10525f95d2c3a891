//! Ghosts of a passive matrix: if three corners of a rectangle are pressed, current through all three shows
//! at the fourth corner as well, with at most a third of their signal if they are pressed equally.
//!
//! A contact is a candidate if three stronger ones are at the other corners: one in its rows, one in its
//! columns, and one in the columns of the former and the rows of the latter, all within one block. It is only
//! a candidate: four fingers may press the corners of a rectangle, one of them more lightly. Fewer than four
//! contacts need no computation.

use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::ops::Range;
use taxel_core::body::Placed;
use taxel_core::garment::{Block, Garment, Place};

/// Candidates by the place of their peak (panel, row, column), and the number of contact lists with each.
#[derive(Debug, Default)]
pub struct Ghosts(BTreeMap<(u8, u16, u16), u32>);

impl Ghosts {
    /// Adds the contacts of a frame.
    pub fn take(&mut self, garment: &Garment, present: &[Placed]) {
        for placed in candidates(garment, present) {
            let Place { panel, row, column } = placed.contact.peak_at;
            *self.0.entry((panel, row, column)).or_default() += 1;
        }
    }

    /// A line for each place.
    pub fn table(&self, garment: &Garment) -> String {
        let line = |((panel, row, column), times): (&(u8, u16, u16), &u32)| {
            let name = name_of(garment, *panel);
            format!(
                "ghost?   {name}, row {row}, column {column} (three stronger contacts make a rectangle with it; {times} times)\n"
            )
        };
        self.0.iter().map(line).collect()
    }

    /// `[{"panel", "row", "column", "times"}]`
    pub fn report(&self, garment: &Garment) -> Value {
        let one = |((panel, row, column), times): (&(u8, u16, u16), &u32)| json!({ "panel": name_of(garment, *panel), "row": row, "column": column, "times": times });
        self.0.iter().map(one).collect()
    }
}

fn name_of(garment: &Garment, panel: u8) -> &str {
    garment.panels.get(usize::from(panel)).map_or("?", |panel| panel.name.as_str())
}

/// Part of a contact within a block.
struct ContactPart<'a> {
    placed: &'a Placed,
    rows: Range<u16>,
    columns: Range<u16>,
}

impl ContactPart<'_> {
    fn peak(&self) -> u16 {
        self.placed.contact.peak
    }
}

/// Contacts that may be ghosts of three others in the same block.
pub fn candidates<'a>(garment: &Garment, present: &'a [Placed]) -> Vec<&'a Placed> {
    let mut found: Vec<&Placed> = Vec::new();
    if present.len() < 4 {
        return found;
    }
    for block in &garment.blocks {
        let parts: Vec<ContactPart<'_>> = present.iter().filter_map(|placed| part(block, placed)).collect();
        let ghosts = parts.iter().filter(|part| is_candidate(part, &parts)).map(|part| part.placed);
        for placed in ghosts {
            if !found.iter().any(|known| known.contact.id == placed.contact.id) {
                found.push(placed);
            }
        }
    }
    found
}

fn part<'a>(block: &Block, placed: &'a Placed) -> Option<ContactPart<'a>> {
    let (mut height, mut width) = (u16::from(block.rows), u16::from(block.columns));
    if block.orientation.transposed {
        std::mem::swap(&mut height, &mut width);
    }
    let bounds = &placed.contact.bounds;
    let rows = bounds.top.max(block.row)..bounds.bottom.saturating_add(1).min(block.row + height);
    let columns = bounds.left.max(block.column)..bounds.right.saturating_add(1).min(block.column + width);
    let inside = bounds.panel == block.panel && !rows.is_empty() && !columns.is_empty();
    inside.then_some(ContactPart { placed, rows, columns })
}

fn is_candidate(ghost: &ContactPart<'_>, parts: &[ContactPart<'_>]) -> bool {
    let stronger: Vec<&ContactPart<'_>> = parts.iter().filter(|part| part.peak() > ghost.peak()).collect();
    let meet = |a: &Range<u16>, b: &Range<u16>| a.start < b.end && b.start < a.end;
    stronger.iter().filter(|a| meet(&a.rows, &ghost.rows) && !meet(&a.columns, &ghost.columns)).any(|a| {
        stronger
            .iter()
            .filter(|b| meet(&b.columns, &ghost.columns) && !meet(&b.rows, &ghost.rows))
            .any(|b| stronger.iter().any(|c| meet(&c.rows, &b.rows) && meet(&c.columns, &a.columns)))
    })
}
