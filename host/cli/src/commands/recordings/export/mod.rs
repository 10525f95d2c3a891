//! `taxel export`: converts recordings to other formats.
//!
//! | `--to` | what |
//! |---|---|
//! | `csv` | one row per taxel and frame: place, volts, pressure with unit, see `csv.rs`; with `--contacts` one per contact and frame, see `contacts.rs` |
//! | `npz` | NumPy arrays: an array of frames for each panel, times, contacts, see `npz.rs` |
//! | `png` | a folder with a 16-bit image for each frame, see `png.rs` |
//! | `lerobot` | a folder with a data set for LeRobot, one episode per recording, see `lerobot/mod.rs`; needs the feature `lerobot` |
//!
//! Each export reads the recording image by image: memory does not grow with its length.

mod archive;
mod args;
mod contacts;
mod csv;
mod entries;
mod frames;
#[cfg(feature = "lerobot")]
mod lerobot;
mod npy;
mod npz;
mod png;
mod units;

pub use args::{ExportArgs, Form};

use crate::fault::Fault;
use anyhow::{Context, Result, bail};
use frames::Frames;
use std::io::Write;
use taxel::files::output::{Folder, Output};

/// Runs the command.
pub fn run(args: ExportArgs) -> Result<()> {
    args.check()?;
    // The others hold counts, and describe them in their own way.
    let in_units = matches!(args.to, Form::Csv | Form::Lerobot) && !args.counts;
    let frames = |recording| Frames::new(recording, args.every, !in_units);
    let recordings = args.files.iter().map(frames).collect::<Result<Vec<_>>>()?;
    let done = match (args.to, recordings.as_slice()) {
        #[cfg(feature = "lerobot")]
        (Form::Lerobot, all) => lerobot(all, &args),
        (Form::Csv, [one, ..]) => csv(one, &args),
        (Form::Npz, [one, ..]) => npz(one, &args),
        (Form::Png, [one, ..]) => png(one, &args),
        _ => bail!(Fault::usage("no recording was given")),
    };
    eprintln!("{}: {} frames", args.output.display(), done?);
    for frames in recordings.iter().filter(|frames| !frames.skipped().is_none()) {
        eprintln!("{}: {}", frames.recording(), frames.skipped());
    }
    Ok(())
}

/// Context of an error; errors of a recording name it.
fn to(args: &ExportArgs) -> String {
    format!("exporting to {}", args.output.display())
}

/// Writes a table. Returns the number of frames.
fn csv(frames: &Frames<'_>, args: &ExportArgs) -> Result<u64> {
    let mut draft = Output::stream(&args.output, args.force, args.inputs())?.draft()?;
    let count =
        if args.contacts { contacts::write(frames, &mut draft) } else { taxels(frames, args, &mut draft) };
    let count = count.with_context(|| to(args))?;
    draft.keep()?;
    Ok(count)
}

fn npz(frames: &Frames<'_>, args: &ExportArgs) -> Result<u64> {
    let mut draft = Output::file(&args.output, args.force, args.inputs())?.draft()?;
    let count = npz::write(frames, &args.output, &mut draft).with_context(|| to(args))?;
    draft.keep()?;
    Ok(count)
}

fn png(frames: &Frames<'_>, args: &ExportArgs) -> Result<u64> {
    let folder = Folder::begin(&args.output, args.force, args.inputs(), png::is_ours)?;
    let count = png::write(frames, args.counts, &folder).with_context(|| to(args))?;
    folder.keep_unsynced()?;
    Ok(count)
}

/// Writes the table of taxels, and reports missing voltages.
fn taxels(frames: &Frames<'_>, args: &ExportArgs, out: &mut impl Write) -> Result<u64> {
    let [count, with_volts] =
        csv::ContactTable { touched: args.touched, reference: args.reference }.write(frames, out)?;
    if with_volts == 0 {
        eprintln!(
            "No raw codes were recorded, so the column of volts is empty: `taxel record --raw` records them."
        );
    } else if with_volts < count {
        eprintln!("Raw codes were recorded with {with_volts} of {count} frames: the others have no volts.");
    }
    Ok(count)
}

#[cfg(feature = "lerobot")]
fn lerobot(recordings: &[Frames<'_>], args: &ExportArgs) -> Result<u64> {
    let folder = Folder::begin(&args.output, args.force, args.inputs(), lerobot::is_ours)?;
    lerobot::write(recordings, &lerobot::Choices { fps: args.fps, task: &args.task }, folder)
        .with_context(|| to(args))
}
