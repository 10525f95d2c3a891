//! Checks that the standard board can run a garment's file and a scene's file.

use anyhow::Result;
use std::path::Path;
use taxel::files::garments;
use taxel::source::SceneFile;
use taxel_core::acquire::Depth;
use taxel_core::board::{BoardInfo, Setup, SetupError};
use taxel_core::capacity::TAXELS;
use taxel_core::garment::{Garment, Layout, Pins};
use taxel_core::pipeline::SceneError;
use taxel_core::scene::Scene;

/// The board that ships.
const BOARD: BoardInfo = BoardInfo::feather("");

/// Checks a preset or a garment's file, and a scene's file. Returns a sentence about them. Errors name file,
/// line and key.
pub fn check(garment: &str, scene: Option<&Path>) -> Result<String> {
    let read = garments::read(garment)?;
    let garments::Read { name, garment, .. } = &read;
    let refused = |error: SetupError| match error {
        SetupError::Garment(error) => read.error(&error),
        SetupError::Slow(error) => read.error_at("wiring.settle_ns", error),
        SetupError::Scene(error) => taxel::Error::from(error).context(name),
        SetupError::Interlaced(_) => read.error_at("wiring", error),
    };
    // A grid is perceived on the host, and never scanned.
    let board =
        if read.is_grid() { BoardInfo { pins: Pins { inputs: 0, ..BOARD.pins }, ..BOARD } } else { BOARD };
    let mut setup = Setup::build(&board, garment.clone(), bare(), TAXELS).map_err(refused)?;
    let said = match scene {
        None => String::new(),
        Some(file) => {
            let file = SceneFile::read(file)?;
            let slow = scans_slowly(garment, &file.scene);
            let mut scene = file.scene.clone();
            setup.change_scene(&board, &mut scene).map_err(|error| match error {
                SetupError::Scene(error) => file.error(&scene_key(&error), error),
                SetupError::Slow(error) if slow => read.error_at("wiring.settle_ns", error),
                error => file.error("plan.depth", error),
            })?;
            format!("; scene {} can be played on it", file.scene.name)
        }
    };
    Ok(sentence(name, garment, &setup.layout) + &said + ".")
}

/// The shipped scene without reactions, whose pins a user's garment may need.
fn bare() -> Scene {
    Scene { react: Default::default(), ..Scene::shipped() }
}

/// True if a frame of the scene takes too long even without averaging.
fn scans_slowly(garment: &Garment, scene: &Scene) -> bool {
    let mut plain = Scene { plan: scene.plan, ..bare() };
    plain.plan.depth = Depth::Twelve;
    matches!(Setup::build(&BOARD, garment.clone(), plain, TAXELS), Err(SetupError::Slow(_)))
}

/// Path of the key of a scene's file that an error is about.
fn scene_key(error: &SceneError) -> String {
    use taxel_core::gesture::GestureError;
    use taxel_core::intent::MapError;
    match error {
        SceneError::Invalid(invalid) => invalid.parameter.into(),
        SceneError::Row(row) if row.invalid.parameter.is_empty() => format!("{}[{}]", row.list, row.index),
        SceneError::Row(row) => format!("{}[{}].{}", row.list, row.index, row.invalid.parameter),
        SceneError::Map(MapError::NoSteps) => "intent.steps".into(),
        SceneError::Map(MapError::Fraction { parameter, .. }) => format!("intent.{parameter}"),
        SceneError::Map(_) => "intent.map".into(),
        SceneError::Gestures(GestureError::Invalid(invalid)) => invalid.parameter.into(),
        SceneError::Gestures(GestureError::Model(_)) => "gestures.model".into(),
    }
}

fn sentence(name: &str, garment: &Garment, layout: &Layout) -> String {
    let count = |number: usize, what: &str| format!("{number} {what}{}", if number == 1 { "" } else { "s" });
    format!(
        "{name}: garment {}, {} in {} and {}: fits",
        garment.name,
        count(layout.taxels(), "taxel"),
        count(layout.areas().len(), "panel"),
        count(garment.blocks.len(), "block"),
    )
}
