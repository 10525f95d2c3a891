//! Garments, scenes and models of the user, queued as requests to a board.

use crate::body;
use crate::client::Client;
use crate::error::{Context, Result, SettingError, UsageError};
use crate::files::bases::Base;
use crate::files::{folds, garments};
use crate::source::SceneFile;
use std::path::Path;
use taxel_core::board::TableKind;
use taxel_core::format::Micros;
use taxel_core::garment::{Circuit, Garment, Layout};
use taxel_core::gesture::{GestureConfig, GestureError, Gestures, ShippedModel};
use taxel_core::pipeline::Pipeline;
use taxel_core::shape::GalleryHead;
use taxel_core::surface::LinkMotion;
use taxel_core::wire::{Poses, Request, SHAPES_ADDED, TABLE_PIECE, TablePiece};

/// Queues `SetGarment` for a preset or a TOML file. Errors that do not depend on the board are found here;
/// the board checks its own pins and capacity.
pub fn set_garment(client: &mut Client, name_or_path: &str) -> Result<()> {
    let read = garments::read(name_or_path)?;
    Layout::build(&read.garment, usize::from(u16::MAX), 4095)
        .and_then(|layout| Circuit::build(&read.garment, &layout, read.pins()))
        .map_err(|error| read.error(&error))?;
    let bytes = postcard::to_allocvec(&read.garment).context("the garment cannot be written")?;
    log::info!("sending garment {}, {} bytes", read.garment.name, bytes.len());
    client.request(&Request::SetGarment(&bytes)).with_context(|| name_or_path.to_string())
}

/// Queues the requests that store a body on the board: a preset or a TOML file, for the garment of the
/// board or, before its `Hello`, for `garment`.
pub fn set_body(client: &mut Client, body: &str, garment: &str) -> Result<()> {
    let read = body::read(body)?;
    let table = |garment: &Garment, layout: &Layout| -> Result<Vec<u8>> {
        Ok(body::table(&read.surface(garment, layout)?, layout)?)
    };
    let table = match client.description() {
        Some(description) => table(&description.garment, &description.layout)?,
        None => {
            let garment = garments::read(garment)?;
            let layout = Layout::build(&garment.garment, usize::from(u16::MAX), 4095);
            table(&garment.garment, &layout.map_err(|error| garment.error(&error))?)?
        }
    };
    log::info!("sending body {body}, {} bytes", table.len());
    send_table(client, TableKind::Surface, &table)
}

/// Queues the requests that transfer a base of shapes to a board.
pub fn set_shapes(client: &mut Client, base: &Base) -> Result<()> {
    let gallery = &base.gallery;
    let head = GalleryHead {
        names: gallery.names.clone(),
        space: gallery.space.clone(),
        k: gallery.k,
        reject: gallery.reject,
        confidence: gallery.confidence.clone(),
        prototypes: gallery.prototypes.len() as u16,
    };
    client.request(&Request::SetShapes(&postcard::to_allocvec(&head)?))?;
    for some in gallery.prototypes.chunks(SHAPES_ADDED) {
        client.request(&Request::AddShapes(&postcard::to_allocvec(some)?))?;
    }
    Ok(())
}

/// Queues the requests that store a table of folds on the board, as [`learn::folds`](crate::learn::folds)
/// makes them. The board checks it.
pub fn set_folds(client: &mut Client, file: &Path) -> Result<()> {
    let table = folds::read(file)?;
    log::info!("sending folds {}, {} bytes", file.display(), table.len());
    send_table(client, TableKind::Folds, &table)
}

/// Queues the requests that store a table on the board; an empty one takes the board's table out of force.
/// The board answers each piece, the last one once the table is in force.
fn send_table(client: &mut Client, kind: TableKind, table: &[u8]) -> Result<()> {
    let length = table.len() as u32;
    // At least one: an empty piece of an empty table.
    for index in 0..table.len().div_ceil(TABLE_PIECE).max(1) {
        let offset = index * TABLE_PIECE;
        let bytes = &table[offset..table.len().min(offset + TABLE_PIECE)];
        let piece = TablePiece { kind, length, offset: offset as u32, bytes };
        client.request(&Request::SetTable(&postcard::to_allocvec(&piece)?))?;
    }
    Ok(())
}

/// Queues poses of the links of the board's body: by name, its origin (m) and its rotation (quaternion x, y,
/// z, w) in the frame in which contacts are to be reported.
pub fn set_poses<'a>(
    client: &mut Client,
    poses: impl IntoIterator<Item = (&'a str, [f64; 3], [f64; 4])>,
) -> Result<()> {
    let still = |(link, at, turn)| (link, body::Pose::from_arrays(at, turn), None);
    send_poses(client, None, poses.into_iter().map(still))
}

/// Queues poses of links of the board's body at the board's time `at`, by name, in the frame in which
/// contacts are to be reported, and how they move: the board carries them on.
pub(crate) fn move_poses<'a>(
    client: &mut Client,
    at: Micros,
    poses: impl IntoIterator<Item = (&'a str, (body::Pose, LinkMotion))>,
) -> Result<()> {
    let moving = |(link, (pose, motion))| (link, pose, Some(motion));
    send_poses(client, Some(at), poses.into_iter().map(moving))
}

fn send_poses<'a>(
    client: &mut Client,
    at: Option<Micros>,
    poses: impl Iterator<Item = (&'a str, body::Pose, Option<LinkMotion>)>,
) -> Result<()> {
    let mut reported = Poses { at, links: heapless::Vec::new() };
    for (link, pose, motion) in poses {
        let wrong = |why: &str| UsageError::Argument(format!("the pose of {link}: {why}"));
        let called = link.try_into().map_err(|_| wrong("its name is longer than 40 bytes"))?;
        let pose = pose.for_board().map_err(wrong)?;
        reported.links.push((called, pose, motion)).map_err(|_| wrong("a body has at most 8 links"))?;
    }
    Ok(client.request(&Request::SetPoses(&postcard::to_allocvec(&reported)?))?)
}

/// Checks what of a scene does not depend on the board.
pub(crate) fn check_scene(file: &SceneFile) -> Result<()> {
    let layout = Layout::build(&Garment::reference(), usize::from(u16::MAX), 4095)?;
    // Regions are left to the board, which may have another garment.
    let mut elsewhere = file.scene.clone();
    elsewhere.react.iter_mut().for_each(|row| row.region.clear());
    Pipeline::build(&elsewhere, &layout).with_context(|| file.name().to_string())?;
    Ok(())
}

/// Queues `SetScene` for a scene's file.
pub fn set_scene(client: &mut Client, file: &SceneFile) -> Result<()> {
    check_scene(file)?;
    log::info!("sending scene {}", file.scene.name);
    client.use_for(&file.scene).with_context(|| file.name().to_string())
}

/// Settings of the recognition of gestures by a model in the board's firmware: its own except for the gain, a
/// factor from the garment's counts to those that the model was trained on, and the confidence, 0 to 0.999, that an
/// announcement needs. With a confidence, a class is announced as soon as it is reached, without a minimum time in
/// the lead.
pub fn gestures(model: ShippedModel, gain: Option<f64>, certainty: Option<f64>) -> Result<GestureConfig> {
    let mut config = GestureConfig::of(model);
    if let Some(gain) = gain {
        // Out of range, or NaN: a value that is refused.
        config.gain = (gain * 256.0).round() as u16;
    }
    if let Some(share) = certainty {
        // Negative, or NaN: a value that is refused.
        config.certainty = if share >= 0.0 { (share * 1000.0).round() as u16 } else { u16::MAX };
        (config.decide_ms, config.onset_ms) = (100, 0);
    }
    Gestures::build(&config).map_err(of_caller)?;
    Ok(config)
}

/// An error of the arguments, not of a file.
fn of_caller(error: GestureError) -> UsageError {
    SettingError::from(error).into()
}
