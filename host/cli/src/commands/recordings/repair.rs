//! `taxel info --repair`: writes what can be read of a recording to another file.

use crate::watch::Overwrite;
use anyhow::{Context, Result, bail};
use clap::Args;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;
use taxel::files::input;
use taxel::files::output::Output;
use taxel::recording::{self, Scan};

/// Arguments of `taxel info` for a repair.
#[derive(Debug, Clone, Default, Args)]
pub struct RepairArgs {
    /// Write all that can be read to another file, with an end: after a kill, a power cut or damage
    #[arg(long)]
    pub repair: bool,
    /// With --repair: file to write [default: NAME.repaired.mcap]
    #[arg(short, long, value_name = "FILE", requires = "repair", conflicts_with = "in_place")]
    pub output: Option<PathBuf>,
    /// With --repair: replace the recording itself, when the repaired one is complete
    #[arg(long, requires = "repair")]
    pub in_place: bool,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
}

impl RepairArgs {
    /// Writes the repaired file, and reports it. Returns its name. An intact file stays as it is; it is
    /// copied only if an output was named.
    pub fn run(&self, file: &Path) -> Result<PathBuf> {
        let shown = file.display();
        let before = state(file);
        let scan = recording::scan(file)?;
        if scan.whole && self.output.is_none() {
            eprintln!("{shown} is whole: there is nothing to repair.");
            return Ok(file.into());
        }
        let beside = || file.with_extension("repaired.mcap");
        let name = if self.in_place { file.into() } else { self.output.clone().unwrap_or_else(beside) };
        let output = match self.in_place {
            true => Output::update(&name)?,
            false => Output::file(&name, self.force, [file])?,
        };
        let mut draft = output.draft()?;
        if scan.whole {
            let mut whole = input::open(file).with_context(|| format!("{shown} cannot be read"))?;
            io::copy(&mut whole, &mut draft)?;
        } else {
            recording::repair(file, &scan, &mut draft)?;
        }
        if self.in_place && state(file) != before {
            bail!("{shown} is still being recorded: repair it when the recording has ended");
        }
        draft.keep()?;
        eprintln!("{shown}: {}; written to {}.", found(&scan), name.display());
        Ok(name)
    }
}

/// Length and modification time of a file, to detect that it is still being written.
fn state(file: &Path) -> Option<(u64, SystemTime)> {
    let known = fs::metadata(file).ok()?;
    Some((known.len(), known.modified().ok()?))
}

/// Describes the damage of a file.
pub fn found(scan: &Scan) -> String {
    let mut words = Vec::new();
    let (chunks, bytes) = scan.damaged();
    if chunks > 0 {
        let s = if chunks == 1 { "" } else { "s" };
        words.push(format!("{chunks} damaged chunk{s} of {bytes} bytes cannot be read"));
    } else if bytes > 0 {
        words.push(format!("{bytes} bytes are damaged"));
    }
    if scan.corrected > 0 {
        let (s, stand) = if scan.corrected == 1 { ("", "has an error") } else { ("s", "have errors") };
        words.push(format!("{} record{s} that {stand} can be corrected", scan.corrected));
    }
    if !scan.ended {
        words.push(format!("without its end, {} bytes torn", scan.torn));
    }
    if scan.foreign > 0 {
        words.push(format!("{} chunks with an unsupported compression or size", scan.foreign));
    }
    match (words.is_empty(), scan.whole) {
        (true, true) => "whole".into(),
        (true, false) => "its summary is damaged or does not match its contents".into(),
        _ => words.join(", "),
    }
}
