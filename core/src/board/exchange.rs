//! Change of scene or garment while reactions last: those that continue keep their pin, all others are
//! reported as ended.

use super::effects::Effects;
use super::perception::Perception;
use crate::format::Micros;
use crate::react::{REACTIONS, Reaction, ReactionConfig};

/// By row: time at which its value last reached its level, if the reaction lasts.
pub(super) type Lasting = [Option<Micros>; REACTIONS];

/// Transfers lasting reactions of the previous table to the scene in force. Rows of the same name and pin
/// continue: their pins stay, and from the next frame on the new levels decide. All others end.
#[inline(never)] // M0+: out of line
pub(super) fn transfer_reactions<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
    lasting: &Lasting,
    before: &[ReactionConfig],
    now: Micros,
    perception: &mut Perception<'_, TAXELS, RUNS, PARTS>,
    effects: &mut Effects<'_, TAXELS>,
) {
    for (index, (row, since)) in (0..).zip(before.iter().zip(lasting)) {
        let Some(since) = *since else { continue };
        let is_same = |new: &ReactionConfig| new.name == row.name && new.output == row.output;
        let Some(place) = perception.setup.scene.react.iter().position(is_same) else {
            effects.reaction(now, ended(index, row));
            continue;
        };
        perception.state.react_mut().go_on(place, since);
        effects.outputs.apply(row.output.map(|line| (line.pin, !line.inverted)));
    }
}

/// Another garment: ends the reactions to touch. Reactions to the board's own state continue.
#[inline(never)] // M0+: out of line
pub(super) fn end_reactions<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
    lasting: &Lasting,
    now: Micros,
    perception: &mut Perception<'_, TAXELS, RUNS, PARTS>,
    effects: &mut Effects<'_, TAXELS>,
) {
    for (index, since) in lasting.iter().enumerate() {
        let row = perception.setup.scene.react.get(index).cloned();
        let Some((row, since)) = row.zip(*since) else { continue };
        if row.cause.is_of_board() {
            perception.state.react_mut().go_on(index, since);
            effects.outputs.apply(perception.pin(index as u8));
        } else {
            effects.reaction(now, ended(index as u8, &row));
        }
    }
}

/// Reports the reactions that last to a newly connected host, each with the level at which it began.
pub(super) fn report_reactions<const TAXELS: usize>(
    now: Micros,
    (rows, lasting): (&[ReactionConfig], &Lasting),
    effects: &mut Effects<'_, TAXELS>,
) {
    for (index, (row, _)) in (0..).zip(rows.iter().zip(lasting)).filter(|(_, (_, since))| since.is_some()) {
        let reaction = Reaction { index, name: row.name.clone(), active: true, value: row.level };
        effects.reaction(now, reaction);
    }
}

fn ended(index: u8, row: &ReactionConfig) -> Reaction {
    Reaction { index, name: row.name.clone(), active: false, value: 0 }
}
