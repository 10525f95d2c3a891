//! A file that is going to be written.

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

/// An output that may be written: it is no input, and it is free or may be replaced.
#[derive(Debug)]
pub struct Output {
    pub(super) name: PathBuf,
    pub(super) place: Place,
    inputs: Vec<PathBuf>,
    force: Force,
}

impl Output {
    /// A file that cannot be the standard output. `inputs` are the files that the command reads.
    pub fn file<P: AsRef<Path>>(
        name: &Path,
        force: Force,
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
        force: Force,
        inputs: impl IntoIterator<Item = P>,
    ) -> Result<Output> {
        let inputs = inputs.into_iter().map(|input| input.as_ref().to_path_buf()).collect();
        let output = Output { name: name.into(), place: Place::of(name)?, inputs, force };
        output.is_no_input()?;
        match &output.place {
            Place::File(_, true) if !force.force => Err(exists(name)),
            _ => Ok(output),
        }
    }

    /// A file that the command has read and writes again as the user asked: with more in it, or repaired.
    pub fn update(name: &Path) -> Result<Output> {
        let none: [&Path; 0] = [];
        Output::file(name, Force { force: true }, none)
    }

    /// The name as the user wrote it.
    pub fn name(&self) -> &Path {
        &self.name
    }

    /// Whether it is the standard output: what else a command prints there would be in the way.
    pub fn is_standard(&self) -> bool {
        self.place == Place::Standard
    }

    /// Writes all of it at once.
    pub fn write(self, bytes: &[u8]) -> Result<()> {
        let mut draft = self.draft()?;
        draft.write_all(bytes)?;
        draft.keep()
    }

    /// Begins the content. The output gets it with [`Draft::keep`].
    pub fn draft(self) -> Result<Draft> {
        Draft::of(self)
    }

    /// Begins a file that has its name before it is complete: a recording, of which a crash shall leave what
    /// was written. It gets the name with [`Begun::name`], once its beginning is written. An old file that is
    /// replaced is gone then; who has it open goes on reading it.
    pub fn begin(self) -> Result<(File, Begun)> {
        let place = || format!("{} cannot be written", self.name.display());
        let (file, part) = match &self.place {
            Place::Standard => bail!("the standard output cannot be cut back: name a file"),
            Place::Device(path) => (place::device(path).with_context(place)?, None),
            Place::File(path, _) => {
                let (file, part) =
                    part::make(folder(path), |part| File::create_new(part)).with_context(place)?;
                (file, Some(Part(part)))
            }
        };
        Ok((file, Begun { output: self, part }))
    }

    /// Refuses what is an input; it may have become one since it was looked at.
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

    /// Gives the output's name to a temporary file.
    pub(super) fn take_name(&self, part: &Path) -> Result<()> {
        let Place::File(path, existed) = &self.place else { return Ok(()) };
        let place = || format!("{} cannot be written", self.name.display());
        self.is_no_input()?;
        if self.force.force {
            if let (true, Ok(old)) = (existed, fs::metadata(path)) {
                // A file keeps who may read it.
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

/// A file that is written and has no name yet. Dropped, it is gone.
#[derive(Debug)]
pub struct Begun {
    output: Output,
    part: Option<Part>,
}

impl Begun {
    /// Gives it the output's name; what was written so far is on the disk when this returns.
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

/// The folder of a path that was found by [`Place::of`].
pub(super) fn folder(path: &Path) -> &Path {
    path.parent().unwrap_or(path)
}
