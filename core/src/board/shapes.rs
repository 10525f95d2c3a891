//! Shapes that the host teaches.

use super::effects::Effects;
use super::perception::Perception;
use super::reading;
use super::refusal::Refusal;
use crate::format::Invalid;
use crate::pipeline::CONTACTS;
use crate::shape::{Exemplar, Taught};
use crate::wire::SHAPES_ADDED;
use heapless::Vec;

/// Begins a gallery with the bytes of its head, or goes back to the built-in base if there are none. Own frame,
/// here and below: each needs much stack.
#[inline(never)]
pub(super) fn set<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
    bytes: &[u8],
    perception: &mut Perception<'_, TAXELS, RUNS, PARTS>,
    effects: &mut Effects<'_, TAXELS>,
) -> Result<(), Refusal> {
    if bytes.is_empty() {
        perception.state.taught.clear();
        forget(perception, effects);
        return Ok(());
    }
    if !cfg!(feature = "gallery") {
        return Err(Refusal::left_out("shapes"));
    }
    let head = reading::value("shapes", bytes)?;
    teach(perception, effects, |taught| taught.begin(head))
}

/// Adds prototypes to the gallery.
#[inline(never)]
pub(super) fn add<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
    bytes: &[u8],
    perception: &mut Perception<'_, TAXELS, RUNS, PARTS>,
    effects: &mut Effects<'_, TAXELS>,
) -> Result<(), Refusal> {
    if !cfg!(feature = "gallery") {
        return Err(Refusal::left_out("shapes"));
    }
    let prototypes = reading::value::<Vec<Exemplar, SHAPES_ADDED>>("prototypes", bytes)?;
    teach(perception, effects, |taught| taught.add(&prototypes))
}

/// Changes the gallery; forgets the recognised shapes if one was in force before or is now.
fn teach<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
    perception: &mut Perception<'_, TAXELS, RUNS, PARTS>,
    effects: &mut Effects<'_, TAXELS>,
    change: impl FnOnce(&mut Taught<CONTACTS>) -> Result<(), Invalid>,
) -> Result<(), Refusal> {
    let before = perception.state.taught.gallery().is_some();
    let done = change(&mut perception.state.taught);
    if before || perception.state.taught.gallery().is_some() {
        forget(perception, effects);
    }
    done.map_err(Refusal::of)
}

/// Forgets the recognised shapes: classes of the previous base have no name in this one.
fn forget<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
    perception: &mut Perception<'_, TAXELS, RUNS, PARTS>,
    effects: &mut Effects<'_, TAXELS>,
) {
    perception.state.recognise_shapes_anew();
    effects.outbox.shapes_changed();
}
