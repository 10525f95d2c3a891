//! Garments, scenes and models of the user, queued as requests to a board.

use crate::client::Client;
use crate::error::{Context, Result, SettingError, UsageError};
use crate::files::garments;
use crate::source::SceneFile;
use crate::tell::verbose;
use taxel_core::garment::{Circuit, Garment, Layout, Pins};
use taxel_core::gesture::{Certainty, GestureConfig, GestureError, Gestures, ShippedModel};
use taxel_core::pipeline::Pipeline;
use taxel_core::wire::Request;

/// Queues `SetGarment` for a preset or a TOML file. Errors that do not depend on the board are found here;
/// the board checks its own pins and capacity.
pub fn set_garment(client: &mut Client, name_or_path: &str) -> Result<()> {
    let read = garments::read(name_or_path)?;
    Layout::build(&read.garment, usize::from(u16::MAX), 4095)
        .and_then(|layout| Circuit::build(&read.garment, &layout, Pins::ANY))
        .map_err(|error| read.error(&error))?;
    let bytes = postcard::to_allocvec(&read.garment).context("the garment cannot be written")?;
    verbose::tell(format_args!("sending garment {}, {} bytes", read.garment.name, bytes.len()));
    client.request(&Request::SetGarment(&bytes)).with_context(|| name_or_path.to_string())
}

/// Queues `SetScene` for a scene's file.
pub fn set_scene(client: &mut Client, file: &SceneFile) -> Result<()> {
    let place = || file.name().to_string();
    let layout = Layout::build(&Garment::reference(), usize::from(u16::MAX), 4095)?;
    // Regions are left to the board, which may have another garment.
    let mut elsewhere = file.scene.clone();
    elsewhere.react.iter_mut().for_each(|row| row.region.clear());
    Pipeline::build(&elsewhere, &layout).with_context(place)?;
    verbose::tell(format_args!("sending scene {}", file.scene.name));
    client.use_for(&file.scene).with_context(place)
}

/// Queues the confidence, 0 to 0.999, that the announcement of a gesture needs.
pub fn set_certainty(client: &mut Client, share: f64) -> Result<()> {
    // Negative, or NaN: a value that is refused.
    let thousandths = if share >= 0.0 { (share * 1000.0).round() as u16 } else { u16::MAX };
    Certainty::of(thousandths).map_err(|error| of_caller(error.into()))?;
    Ok(client.request(&Request::SetCertainty(thousandths))?)
}

/// Queues `SetGestures` for a model in the board's firmware: its own settings except for the gain, a factor
/// from the garment's counts to those that the model was trained on. If `by_certainty`, a class is announced
/// as soon as its confidence suffices, without a minimum time in the lead.
pub fn set_gestures(
    client: &mut Client,
    model: ShippedModel,
    gain: Option<f64>,
    by_certainty: bool,
) -> Result<()> {
    let mut config = GestureConfig::of(model);
    if let Some(gain) = gain {
        // Out of range, or NaN: a value that is refused.
        config.gain = (gain * 256.0).round() as u16;
    }
    if by_certainty {
        (config.decide_ms, config.onset_ms) = (100, 0);
    }
    Gestures::build(&config).map_err(of_caller)?;
    Ok(client.request(&Request::SetGestures(Some(config)))?)
}

/// An error of the arguments, not of a file.
fn of_caller(error: GestureError) -> UsageError {
    SettingError::from(error).into()
}
