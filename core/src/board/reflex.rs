//! Reactions that begin within a frame.

use super::effects::Effects;
use super::perception::Perception;
use crate::format::Micros;
use crate::reflex::Early;
use crate::wire::ReflexReport;

/// Takes a reflex that began, whose pin has been asserted. `scanned`: end of the last perceived scan.
pub(super) fn begin<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
    early: &Early,
    scanned: Micros,
    perception: &mut Perception<'_, TAXELS, RUNS, PARTS>,
    effects: &mut Effects<'_, TAXELS>,
) {
    let Early { index, time, taxel, code, other } = *early;
    let Perception { setup, state, .. } = perception;
    let value = state.condition.pressure(taxel.into(), code, setup.circuit.falling());
    let reactions = setup.pipeline.reactions();
    if !reactions.reflexes().rows().iter().any(|row| row.index == index) {
        // The row belongs to a previous scene.
        return;
    }
    let reaction = state.begin_reaction(reactions, index, value, time);
    effects.outputs.apply(reactions.output(index).map(|line| (line.pin, !line.inverted)));
    // It may have begun in the frame being scanned, after the one perceived last.
    let frame = effects.frame.wrapping_add((time > scanned).into());
    let report = ReflexReport { frame, time, index, taxel, value, other };
    effects.outbox.reflex(report, reaction, effects.health);
}
