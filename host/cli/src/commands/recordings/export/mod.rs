//! `taxel export`: converts recordings to other formats.
//!
//! | `--to` | what |
//! |---|---|
//! | `csv` | one row per taxel and frame: place, volts, pressure with unit, see `csv.rs`; with `--contacts` one per contact and frame, see `contacts.rs` |
//! | `npz` | NumPy arrays: an array of frames for each panel, times, contacts, see `npz.rs` |
//! | `png` | a folder with a 16-bit image for each frame, see `png.rs` |
//!
//! Each export reads the recording image by image: memory does not grow with its length.

mod archive;
mod args;
mod contacts;
mod csv;
mod entries;
mod frames;
mod npy;
mod npz;
mod png;
mod units;

pub use args::{ExportArgs, Form};

use anyhow::{Context, Result};
use frames::Frames;
use std::io::Write;
use taxel::files::output::{Folder, Output};

/// Runs the command.
pub fn run(args: ExportArgs) -> Result<()> {
    args.check()?;
    // The others hold counts, and describe them in their own way.
    let in_units = args.to == Form::Csv && !args.counts;
    let frames = Frames::new(&args.file, args.every, !in_units)?;
    let count = match args.to {
        Form::Csv => csv(&frames, &args),
        Form::Npz => npz(&frames, &args),
        Form::Png => png(&frames, &args),
    }?;
    eprintln!("{}: {count} frames", args.output.display());
    if !frames.skipped().is_none() {
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
