//! Another garment or scene for a board, from a file, before it streams.

use crate::client::Client;
use crate::fault::Blame;
use crate::garments;
use crate::source::read_scene;
use crate::verbose;
use anyhow::{Context, Result};
use clap::ValueEnum;
use std::path::Path;
use taxel_core::garment::{Circuit, Layout, Pins};
use taxel_core::gesture::{Certainty, GestureConfig, Gestures, Shipped};
use taxel_core::pipeline::Pipeline;
use taxel_core::wire::Request;

/// Queues `SetGarment` for a garment that comes with the program or a TOML file. What is wrong with it
/// whatever the board is said here; the board knows its own pins and size.
pub fn wear(client: &mut Client, name_or_path: &str) -> Result<()> {
    let read = garments::read(name_or_path)?;
    Layout::build(&read.garment, usize::from(u16::MAX), 4095)
        .and_then(|layout| Circuit::build(&read.garment, &layout, Pins::ANY))
        .map_err(|error| read.error(&error))?;
    let bytes = postcard::to_allocvec(&read.garment).context("the garment cannot be written")?;
    verbose::tell(format_args!("garment {} is sent, {} bytes", read.garment.name, bytes.len()));
    client.request(&Request::SetGarment(&bytes)).with_context(|| name_or_path.to_string())
}

/// Queues `SetScene` for a TOML file; what it does not say is as in the shipped scene, and its map may be
/// [named](crate::fcm::scene).
pub fn play(client: &mut Client, path: &Path) -> Result<()> {
    let place = || path.display().to_string();
    let scene = read_scene(path)?;
    let garment = taxel_core::garment::Garment::reference();
    let layout = Layout::build(&garment, usize::from(u16::MAX), 4095)?;
    // Regions are the board's affair: it may wear another garment.
    let mut elsewhere = scene.clone();
    elsewhere.react.iter_mut().for_each(|row| row.region.clear());
    Pipeline::build(&elsewhere, &layout).with_context(place)?;
    verbose::tell(format_args!("scene {} is sent", scene.name));
    client.use_for(&scene).with_context(place)
}

/// A model that the board holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum GestureModel {
    /// constant, notouch, pat, rub, scratch, stroke, tickle
    Gestures,
    /// kindness, threat, attack
    Intent,
}

/// Queues `SetGestures` for a model with its usual settings but the gain, and before it the certainty. Whoever
/// names a certainty is told as soon as the model is that sure, without a time for which it must have been so.
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
        // What is out of range, not a number included, becomes one that is refused.
        config.gain = (gain * 256.0).round() as u16;
    }
    if let Some(certainty) = certainty {
        // What is below 0, or no number, becomes one that is refused.
        let thousandths = if certainty >= 0.0 { (certainty * 1000.0).round() as u16 } else { u16::MAX };
        Certainty::of(thousandths).context("--gesture-certainty").usage()?;
        client.request(&Request::SetCertainty(thousandths))?;
        (config.decide_ms, config.onset_ms) = (100, 0);
    }
    Gestures::build(&config).context("--gestures").usage()?;
    Ok(client.request(&Request::SetGestures(Some(config)))?)
}
