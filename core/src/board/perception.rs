//! Garment and scene with the stages built from them, and the state of the stages.

use super::info::BoardInfo;
use super::reading;
use super::refusal::Refusal;
use super::setup::Setup;
use crate::garment::Garment;
use crate::pipeline::PipelineState;
use crate::scene::Scene;

/// Parts that perceive: owners get them with their inputs.
pub(super) struct Perception<'a, const TAXELS: usize, const RUNS: usize, const PARTS: usize> {
    pub info: &'a BoardInfo,
    pub setup: &'a mut Setup,
    pub state: &'a mut PipelineState<TAXELS, RUNS, PARTS>,
}

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Perception<'_, TAXELS, RUNS, PARTS> {
    /// Resets the state of all stages.
    pub fn reset(&mut self) {
        let Setup { layout, circuit, .. } = &*self.setup;
        self.state.reset(layout, circuit.falling(), self.info.full_scale);
    }

    /// Replaces the garment by one in postcard; an error changes nothing. Own frame, here and below: each needs
    /// much stack, and most inputs need none of it.
    #[inline(never)]
    pub fn take_garment(&mut self, bytes: &[u8]) -> Result<(), Refusal> {
        let mut garment = Garment::default();
        reading::garment(bytes, &mut garment)?;
        self.setup.change_garment(self.info, &mut garment, TAXELS).map_err(Refusal::of)
    }

    /// Level that all rows of the pin of a row require.
    pub fn pin(&self, index: u8) -> Option<(u8, bool)> {
        self.setup.pipeline.reactions().pin(self.state.react(), index)
    }

    /// Sets the shipped scene, if the garment leaves its pins free.
    #[inline(never)]
    pub fn ship_scene(&mut self) {
        let _ = self.setup.change_scene(self.info, &mut Scene::shipped());
    }
}

/// True if something touches the garment, or a reaction to a touch lasts.
pub(super) fn is_busy<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
    scene: &Scene,
    state: &PipelineState<TAXELS, RUNS, PARTS>,
) -> bool {
    let rows = scene.react.iter().zip(state.react().since());
    let reacts = rows.into_iter().any(|(row, since)| since.is_some() && !row.cause.is_of_board());
    reacts || state.is_touched()
}
