//! An output file.

use super::draft::Draft;
use super::force::Force;
use super::named::{Named, exists, folder};
use super::part::{self, Part};
use super::place::{self, Place};
use crate::error::{Context, FileError, Result, UsageError};
use std::fs::File;
use std::io::Write;
use std::path::Path;

/// An output that may be written: it is not an input, and it does not exist or may be replaced.
#[derive(Debug)]
pub struct Output(Named);

impl Output {
    /// A file, not the standard output. `inputs` are the files that the command reads.
    pub fn file<P: AsRef<Path>>(
        name: &Path,
        force: impl Into<Force>,
        inputs: impl IntoIterator<Item = P>,
    ) -> Result<Output> {
        let output = Output::stream(name, force, inputs)?;
        require!(
            !output.is_standard(),
            UsageError::Argument,
            "-o -: this cannot be written to the standard output, name a file"
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
        let named = Named { name: name.into(), place: Place::of(name)?, inputs, force: force.into() };
        named.is_no_input()?;
        match &named.place {
            Place::File(_, true) if !named.force.force => Err(exists(name)),
            _ => Ok(Output(named)),
        }
    }

    /// A file that the command has read and rewrites on request: extended or repaired.
    pub fn update(name: &Path) -> Result<Output> {
        let none: [&Path; 0] = [];
        Output::file(name, Force { force: true }, none)
    }

    /// Name as given by the user.
    pub fn name(&self) -> &Path {
        &self.0.name
    }

    /// True for the standard output, where a command must not print anything else.
    pub fn is_standard(&self) -> bool {
        self.0.place == Place::Standard
    }

    /// Writes all bytes at once.
    pub fn write(self, bytes: &[u8]) -> Result<()> {
        let mut draft = self.draft()?;
        draft.write_all(bytes)?;
        draft.keep()
    }

    /// Begins the content; [`Draft::keep`] puts it into the output.
    pub fn draft(self) -> Result<Draft> {
        Draft::of(self.0)
    }

    /// Begins a file that gets its name before it is complete: a recording, of which a crash must leave what
    /// was written. [`Begun::open`] gives it the name once its beginning is written, unless it replaces another
    /// file; then [`Begun::name`] does, once there is something in it. The replaced file is then gone; programs
    /// that have it open can go on reading it.
    pub fn begin(self) -> Result<(File, Begun)> {
        let place = || format!("{} cannot be written", self.0.name.display());
        let (file, part) = match &self.0.place {
            Place::Standard => {
                fail!(FileError::Output, "the standard output cannot be truncated: name a file")
            }
            Place::Device(path) => (place::device(path).with_context(place)?, None),
            Place::File(path, _) => {
                let (file, part) =
                    part::make(folder(path), |part| File::create_new(part)).with_context(place)?;
                (file, Some(Part(part)))
            }
        };
        Ok((file, Begun { output: self.0, part }))
    }
}

/// A file being written, at first without its name; if dropped then, it is deleted.
#[derive(Debug)]
pub struct Begun {
    output: Named,
    /// None once it has its name.
    part: Option<Part>,
}

impl Begun {
    /// Path at which it is now.
    pub fn path(&self) -> &Path {
        self.part.as_ref().map_or(&self.output.name, |Part(path)| path)
    }

    /// Gives it the output's name, unless another file has it.
    pub fn open(&mut self) -> Result<()> {
        if matches!(self.output.place, Place::File(_, true)) { Ok(()) } else { self.name() }
    }

    /// Gives it the output's name, unless it has it; the bytes written so far are on the disk when this
    /// returns.
    pub fn name(&mut self) -> Result<()> {
        let Some(Part(part)) = &self.part else { return Ok(()) };
        let place = || format!("{} cannot be written", self.output.name.display());
        part::sync_file(part).with_context(place)?;
        self.output.take_name(part)?;
        self.part = None;
        Ok(())
    }

    /// Gives it the output's name at its end. Error if it is empty and would replace another file, which
    /// stays.
    pub fn end(&mut self, is_empty: bool) -> Result<()> {
        if is_empty && self.part.is_some() {
            fail!(FileError::Output, "{} stays as it was: no frames came", self.output.name.display());
        }
        self.name()
    }
}
