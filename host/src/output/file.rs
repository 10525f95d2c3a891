//! An output file.

use super::draft::Draft;
use super::force::Force;
use super::part::{self, Part};
use super::place::{self, Place};
use super::same::is_same;
use crate::fault::Fault;
use anyhow::{Context, Result, bail, ensure};
use std::fs::{self, File};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

/// An output that may be written: it is not an input, and it does not exist or may be replaced.
#[derive(Debug)]
pub struct Output {
    pub(super) name: PathBuf,
    pub(super) place: Place,
    inputs: Vec<PathBuf>,
    force: Force,
}

impl Output {
    /// A file, not the standard output. `inputs` are the files that the command reads.
    pub fn file<P: AsRef<Path>>(
        name: &Path,
        force: impl Into<Force>,
        inputs: impl IntoIterator<Item = P>,
    ) -> Result<Output> {
        let output = Output::stream(name, force, inputs)?;
        ensure!(
            output.place != Place::Standard,
            Fault::usage("-o -: this cannot be written to the standard output, name a file")
        );
        Ok(output)
    }

    /// A file, or the standard output for the name `-`. `inputs` are the files that the command reads.
    pub fn stream<P: AsRef<Path>>(
        name: &Path,
        force: impl Into<Force>,
        inputs: impl IntoIterator<Item = P>,
    ) -> Result<Output> {
        let inputs = inputs.into_iter().map(|input| input.as_ref().to_path_buf()).collect();
        let output = Output { name: name.into(), place: Place::of(name)?, inputs, force: force.into() };
        output.is_no_input()?;
        match &output.place {
            Place::File(_, true) if !output.force.force => Err(exists(name)),
            _ => Ok(output),
        }
    }

    /// A file that the command has read and rewrites on request: extended or repaired.
    pub fn update(name: &Path) -> Result<Output> {
        let none: [&Path; 0] = [];
        Output::file(name, Force { force: true }, none)
    }

    /// Name as given by the user.
    pub fn name(&self) -> &Path {
        &self.name
    }

    /// True for the standard output, where a command must not print anything else.
    pub fn is_standard(&self) -> bool {
        self.place == Place::Standard
    }

    /// Writes all bytes at once.
    pub fn write(self, bytes: &[u8]) -> Result<()> {
        let mut draft = self.draft()?;
        draft.write_all(bytes)?;
        draft.keep()
    }

    /// Begins the content; [`Draft::keep`] puts it into the output.
    pub fn draft(self) -> Result<Draft> {
        Draft::of(self)
    }

    /// Begins a file that gets its name before it is complete: a recording, of which a crash must leave what
    /// was written. [`Begun::name`] gives it the name once its beginning is written. A replaced file is then
    /// gone; programs that have it open can go on reading it.
    pub fn begin(self) -> Result<(File, Begun)> {
        let place = || format!("{} cannot be written", self.name.display());
        let (file, part) = match &self.place {
            Place::Standard => bail!("the standard output cannot be truncated: name a file"),
            Place::Device(path) => (place::device(path).with_context(place)?, None),
            Place::File(path, _) => {
                let (file, part) =
                    part::make(folder(path), |part| File::create_new(part)).with_context(place)?;
                (file, Some(Part(part)))
            }
        };
        Ok((file, Begun { output: self, part }))
    }

    /// Error if it is an input; it may have become one since the first check.
    fn is_no_input(&self) -> Result<()> {
        let Place::File(path, _) = &self.place else { return Ok(()) };
        let Some(same) = self.inputs.iter().find(|input| is_same(path, input)) else { return Ok(()) };
        let name = self.name.display();
        if *same == self.name {
            bail!(Fault::usage(format!("{name} is read by this command: give another name for the output")));
        }
        let same = same.display();
        let told = format!("{name} is the same file as {same}, which this command reads: give another name");
        bail!(Fault::usage(told))
    }

    /// Renames a temporary file to the output's name.
    pub(super) fn take_name(&self, part: &Path) -> Result<()> {
        let Place::File(path, existed) = &self.place else { return Ok(()) };
        let place = || format!("{} cannot be written", self.name.display());
        self.is_no_input()?;
        if self.force.force {
            if let (true, Ok(old)) = (existed, fs::metadata(path)) {
                // The permissions are kept.
                fs::set_permissions(part, old.permissions()).with_context(place)?;
            }
            fs::rename(part, path).with_context(place)?;
        } else {
            part::name(part, path).map_err(|error| match error.kind() {
                ErrorKind::AlreadyExists => exists(&self.name),
                _ => anyhow::Error::new(error).context(place()),
            })?;
        }
        part::sync_folder(folder(path)).with_context(place)
    }
}

/// A file being written, without a name yet. Dropping it deletes it.
#[derive(Debug)]
pub struct Begun {
    output: Output,
    part: Option<Part>,
}

impl Begun {
    /// Gives it the output's name; the bytes written so far are on the disk when this returns.
    pub fn name(self) -> Result<()> {
        let Some(Part(part)) = &self.part else { return Ok(()) };
        let place = || format!("{} cannot be written", self.output.name.display());
        File::open(part).and_then(|file| file.sync_all()).with_context(place)?;
        self.output.take_name(part)
    }
}

fn exists(name: &Path) -> anyhow::Error {
    anyhow::anyhow!("{} already exists: give another name, or --force to replace it", name.display())
}

/// Folder of a path found by [`Place::of`].
pub(super) fn folder(path: &Path) -> &Path {
    path.parent().unwrap_or(path)
}
