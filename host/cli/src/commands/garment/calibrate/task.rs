//! A complete calibration on a board.

use super::dialogue::Dialogue;
use crate::fault::Blame;
use crate::watch::raw::RawBoard;
use anyhow::{Context, Result};
use taxel::files::calibrate::{Calibration, Over, fit, plates};
use taxel_core::garment::Layout;
use taxel_core::wire::Request;

/// Frames averaged by the tare.
const TARE: u16 = 64;

/// Task of a calibration: what, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct CalibrationTask {
    /// Area that the plate covers.
    pub over: Over,
    /// The weights, N, ascending.
    pub weights: Vec<f64>,
    /// Author.
    pub by: String,
    /// Longest wait of the board for a weight, s.
    pub wait: f64,
    /// Print the dialogue as JSON.
    pub json: bool,
}

/// Tares the board, asks for the weights and fits. The board's own calibration is not changed.
pub fn calibrate(board: &mut RawBoard, task: &CalibrationTask) -> Result<Calibration> {
    let description = board.description().context("the board has not sent its garment").board()?;
    let (garment, firmware) = (description.garment.clone(), description.firmware.clone());
    let layout = Layout::build(&garment, usize::from(u16::MAX), 4095)?;
    let plates = plates(&garment, &layout, task.over)?;
    let mut dialogue = Dialogue::new(board, garment.wiring.falling, task.wait, task.json);
    dialogue.ask_for_rest();
    let rest = dialogue.rest()?;
    dialogue.board.ask(&Request::Tare { frames: TARE })?;
    let readings = dialogue.readings(&plates, &task.weights, &rest)?;
    let fitted = fit(&layout, &plates, &readings)?;
    let about = [
        garment.name.as_str(),
        &task.by,
        &how(task, plates.len()),
        &format!("{firmware} at {}", board.label()),
    ];
    Ok(Calibration { celsius: board.celsius(), ..Calibration::of(fitted, &layout, &rest, about) })
}

fn how(task: &CalibrationTask, plates: usize) -> String {
    let weights: Vec<_> = task.weights.iter().map(|weight| format!("{weight:.3}")).collect();
    let over = match task.over {
        Over::Panel => "panel",
        Over::Block => "block",
        Over::Taxel => "taxel",
    };
    format!("a plate on each {over} ({plates}), on and off: {} N", weights.join(", "))
}
