//! Content of an output before it gets its name.

use super::named::{Named, folder};
use super::part::{self, Part};
use super::place::{self, Place};
use crate::error::{Context, Result};
use std::fs::File;
use std::io::{self, BufWriter, Error, ErrorKind, Seek, SeekFrom, Stdout, Write, stdout};

/// Content being written. Errors name the output. If it is dropped without [`Draft::keep`], the output stays
/// as before.
#[derive(Debug)]
pub struct Draft {
    output: Named,
    sink: Sink,
}

/// Destination of the bytes until then.
#[derive(Debug)]
enum Sink {
    Standard(Stdout),
    Device(BufWriter<File>),
    File(BufWriter<File>, Part),
}

impl Draft {
    pub(super) fn of(output: Named) -> Result<Draft> {
        let place = || format!("{} cannot be written", output.name.display());
        let sink = match &output.place {
            Place::Standard => Sink::Standard(stdout()),
            Place::Device(path) => Sink::Device(BufWriter::new(place::device(path).with_context(place)?)),
            Place::File(path, _) => {
                let (file, part) =
                    part::make(folder(path), |part| File::create_new(part)).with_context(place)?;
                Sink::File(BufWriter::new(file), Part(part))
            }
        };
        Ok(Draft { output, sink })
    }

    /// Puts the content into the output; it is on the disk when this returns.
    pub fn keep(mut self) -> Result<()> {
        self.flush()?;
        log::info!("has written {}", self.output.name.display());
        let Sink::File(file, part) = self.sink else { return Ok(()) };
        let place = || format!("{} cannot be written", self.output.name.display());
        file.get_ref().sync_all().with_context(place)?;
        drop(file);
        self.output.take_name(&part.0)
    }

    /// Adds the output's name to an error. Errors of the standard output stay unchanged: a reader that has
    /// exited is not a failure.
    fn reported<T>(&self, done: io::Result<T>) -> io::Result<T> {
        done.map_err(|error| match self.sink {
            Sink::Standard(_) => error,
            _ if error.kind() == ErrorKind::Interrupted => error,
            _ => {
                Error::new(error.kind(), format!("{} cannot be written: {error}", self.output.name.display()))
            }
        })
    }
}

impl Write for Draft {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let done = match &mut self.sink {
            Sink::Standard(out) => out.write(bytes),
            Sink::Device(file) | Sink::File(file, _) => file.write(bytes),
        };
        self.reported(done)
    }

    fn flush(&mut self) -> io::Result<()> {
        let done = match &mut self.sink {
            Sink::Standard(out) => out.flush(),
            Sink::Device(file) | Sink::File(file, _) => file.flush(),
        };
        self.reported(done)
    }
}

impl Seek for Draft {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let done = match &mut self.sink {
            Sink::Standard(_) => Err(ErrorKind::NotSeekable.into()),
            Sink::Device(file) | Sink::File(file, _) => file.seek(to),
        };
        self.reported(done)
    }
}
