//! The gesture models of the command line.

use anyhow::{Context, Result};
use clap::ValueEnum;
use taxel::client::Client;
use taxel::session::setting;
use taxel_core::gesture::ShippedModel;

/// A model in the board's firmware.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum GestureModel {
    /// constant, notouch, pat, rub, scratch, stroke, tickle
    Gestures,
    /// kindness, threat, attack
    Intent,
}

/// Queues the confidence and the model.
pub fn recognise(
    client: &mut Client,
    model: GestureModel,
    gain: Option<f64>,
    certainty: Option<f64>,
) -> Result<()> {
    let model = match model {
        GestureModel::Gestures => ShippedModel::Gestures,
        GestureModel::Intent => ShippedModel::Intent,
    };
    setting::set_gestures(client, model, gain, certainty).context("--gestures")
}
