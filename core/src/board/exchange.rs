//! Another scene or garment while reactions last: what goes on keeps its pin, every other end is told.

use super::Board;
use crate::format::{Micros, Name};
use crate::garment::Line;
use crate::react::{REACTIONS, Reaction, ReactionConfig};
use crate::wire::ReactionReport;
use heapless::Vec;

/// A reaction that lasted when its scene or garment was changed.
pub(super) struct Lasting {
    index: u8,
    name: Name,
    output: Option<Line>,
    /// When its value last reached the level.
    since: Micros,
}

impl Lasting {
    /// Whether a row goes on where this one was: it has its name and its pin.
    fn goes_on_as(&self, row: &ReactionConfig) -> bool {
        row.name == self.name && row.output == self.output
    }
}

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// The reactions that last.
    #[inline(never)] // M0+: out of line
    pub(super) fn lasting(&self) -> Vec<Lasting, REACTIONS> {
        let mut lasting = Vec::new();
        for (index, (row, since)) in
            (0u8..).zip(self.setup.scene.react.iter().zip(self.state.react().since()))
        {
            if let Some(since) = *since {
                // As many places as rows.
                let _ = lasting.push(Lasting { index, name: row.name.clone(), output: row.output, since });
            }
        }
        lasting
    }

    /// Carries reactions over to the table of the scene that is in force now: its levels decide with the next frame, and their pins
    /// stay as they are until then. Those that it has no row for have ended; so have all, where the garment is another (`none`).
    #[inline(never)] // M0+: out of line
    pub(super) fn carry(&mut self, lasting: &[Lasting], none: bool, now: Micros) {
        for reaction in lasting {
            let row = self.setup.scene.react.iter().position(|row| !none && reaction.goes_on_as(row));
            match row {
                Some(row) => {
                    self.state.react_mut().go_on(row, reaction.since);
                    if let Some(line) = reaction.output {
                        self.outputs.set(line.pin, !line.inverted);
                    }
                }
                None => {
                    let (index, name) = (reaction.index, reaction.name.clone());
                    let reaction = Reaction { index, name, active: false, value: 0 };
                    self.outbox
                        .end(ReactionReport { frame: self.frame, time: now, reaction }, &mut self.health);
                }
            }
        }
    }
}
