//! Queues the garment, scene and models of the command line before a board streams.

use anyhow::{Context, Result};
use clap::ValueEnum;
use std::path::Path;
use taxel::client::Client;
use taxel::files::garments;
use taxel::source::read_scene;
use taxel::tell::fault::Blame;
use taxel::tell::verbose;
use taxel_core::garment::{Circuit, Layout, Pins};
use taxel_core::gesture::{Certainty, GestureConfig, Gestures, Shipped};
use taxel_core::pipeline::Pipeline;
use taxel_core::wire::Request;

/// Queues `SetGarment` for a preset or a TOML file. Errors that do not depend on the board are found here;
/// the board checks its own pins and capacity.
pub fn wear(client: &mut Client, name_or_path: &str) -> Result<()> {
    let read = garments::read(name_or_path)?;
    Layout::build(&read.garment, usize::from(u16::MAX), 4095)
        .and_then(|layout| Circuit::build(&read.garment, &layout, Pins::ANY))
        .map_err(|error| read.error(&error))?;
    let bytes = postcard::to_allocvec(&read.garment).context("the garment cannot be written")?;
    verbose::tell(format_args!("sending garment {}, {} bytes", read.garment.name, bytes.len()));
    client.request(&Request::SetGarment(&bytes)).with_context(|| name_or_path.to_string())
}

/// Queues `SetScene` for a TOML file. Missing keys have the shipped scene's values; the map may be
/// [named](taxel::fcm::scene).
pub fn play(client: &mut Client, path: &Path) -> Result<()> {
    let place = || path.display().to_string();
    let scene = read_scene(path)?;
    let garment = taxel_core::garment::Garment::reference();
    let layout = Layout::build(&garment, usize::from(u16::MAX), 4095)?;
    // Regions are left to the board, which may have another garment.
    let mut elsewhere = scene.clone();
    elsewhere.react.iter_mut().for_each(|row| row.region.clear());
    Pipeline::build(&elsewhere, &layout).with_context(place)?;
    verbose::tell(format_args!("sending scene {}", scene.name));
    client.use_for(&scene).with_context(place)
}

/// A model in the board's firmware.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum GestureModel {
    /// constant, notouch, pat, rub, scratch, stroke, tickle
    Gestures,
    /// kindness, threat, attack
    Intent,
}

/// Queues the confidence and `SetGestures` for a model: the settings of the model except for the gain. With a
/// confidence, a class is announced as soon as it is reached, without a minimum time in the lead.
pub fn recognise(
    client: &mut Client,
    model: GestureModel,
    gain: Option<f64>,
    certainty: Option<f64>,
) -> Result<()> {
    let mut config = GestureConfig::of(match model {
        GestureModel::Gestures => Shipped::Gestures,
        GestureModel::Intent => Shipped::Intent,
    });
    if let Some(gain) = gain {
        // Out of range, or NaN: a value that is refused.
        config.gain = (gain * 256.0).round() as u16;
    }
    if let Some(certainty) = certainty {
        // Negative, or NaN: a value that is refused.
        let thousandths = if certainty >= 0.0 { (certainty * 1000.0).round() as u16 } else { u16::MAX };
        Certainty::of(thousandths).context("--gesture-certainty").usage()?;
        client.request(&Request::SetCertainty(thousandths))?;
        (config.decide_ms, config.onset_ms) = (100, 0);
    }
    Gestures::build(&config).context("--gestures").usage()?;
    Ok(client.request(&Request::SetGestures(Some(config)))?)
}
