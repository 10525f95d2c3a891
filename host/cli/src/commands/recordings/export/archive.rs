//! A ZIP archive that can be abandoned silently: the library's own writes its end when dropped, and prints an
//! error if that fails.

use std::cell::Cell;
use std::io::{self, Seek, SeekFrom, Write};
use std::rc::Rc;
use zip::ZipWriter;

/// Upper limit of an entry's header. Discarded writes advance that far, because an entry begins behind its
/// header.
const HEAD: u64 = 1 << 18;

/// An archive being written.
pub struct Archive<W: Write + Seek> {
    /// Declared before `zip`, so that it is dropped first.
    given_up: GivenUp,
    /// Writer of the entries.
    pub zip: ZipWriter<Gate<W>>,
}

impl<W: Write + Seek> Archive<W> {
    /// Begins an archive.
    pub fn new(out: W) -> Archive<W> {
        let given_up = Rc::new(Cell::new(false));
        let gate = Gate { out, given_up: given_up.clone(), at: 0, end: 0 };
        Archive { given_up: GivenUp(given_up), zip: ZipWriter::new(gate) }
    }

    /// Writes its end. Returns the underlying writer.
    pub fn finish(self) -> zip::result::ZipResult<W> {
        let Archive { given_up: _given_up, zip } = self;
        Ok(zip.finish()?.out)
    }
}

/// Set when the archive is dropped.
struct GivenUp(Rc<Cell<bool>>);

impl Drop for GivenUp {
    fn drop(&mut self) {
        self.0.set(true);
    }
}

/// Passes bytes on until a write fails or the archive is abandoned; discards them from then on.
pub struct Gate<W> {
    out: W,
    given_up: Rc<Cell<bool>>,
    /// Offset of the next byte, and of the end: the library requires consistent offsets.
    at: u64,
    end: u64,
}

impl<W> Gate<W> {
    fn pass<T>(&mut self, nowhere: T, pass: impl FnOnce(&mut W) -> io::Result<T>) -> io::Result<T> {
        if self.given_up.get() {
            return Ok(nowhere);
        }
        let passed = pass(&mut self.out);
        if passed.as_ref().is_err_and(|error| error.kind() != io::ErrorKind::Interrupted) {
            self.given_up.set(true);
            self.at = self.end + HEAD;
            self.end = self.at;
        }
        passed
    }
}

impl<W: Write> Write for Gate<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let taken = self.pass(bytes.len(), |out| out.write(bytes))?;
        self.at += taken as u64;
        self.end = self.end.max(self.at);
        Ok(taken)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.pass((), W::flush)
    }
}

impl<W: Seek> Seek for Gate<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let nowhere = match to {
            SeekFrom::Start(at) => at,
            SeekFrom::Current(by) => self.at.saturating_add_signed(by),
            SeekFrom::End(by) => self.end.saturating_add_signed(by),
        };
        self.at = self.pass(nowhere, |out| out.seek(to))?;
        Ok(self.at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Cursor, ErrorKind};
    use zip::write::SimpleFileOptions;

    /// Fails at one of its calls, and at all later ones.
    struct Failing(Cursor<Vec<u8>>, usize);

    impl Failing {
        fn at(&mut self) -> io::Result<&mut Cursor<Vec<u8>>> {
            self.1 = self.1.saturating_sub(1);
            if self.1 == 0 { Err(ErrorKind::StorageFull.into()) } else { Ok(&mut self.0) }
        }
    }

    impl Write for Failing {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.at()?.write(bytes)
        }

        fn flush(&mut self) -> io::Result<()> {
            self.at()?.flush()
        }
    }

    impl Seek for Failing {
        fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
            self.at()?.seek(to)
        }
    }

    fn write(until: usize) -> zip::result::ZipResult<Vec<u8>> {
        let mut archive = Archive::new(Failing(Cursor::default(), until));
        for name in ["a", "b"] {
            archive.zip.start_file(name, SimpleFileOptions::default())?;
            archive.zip.write_all(&[b'x'; 1000])?;
        }
        archive.finish().map(|out| out.0.into_inner())
    }

    #[test]
    fn an_archive_that_fails_anywhere_is_given_up_without_a_panic() {
        let whole = write(usize::MAX).unwrap();
        let failed = (1..).map(write).take_while(zip::result::ZipResult::is_err).count();
        assert!(failed > 10, "{failed} calls");
        assert_eq!(write(failed + 1).unwrap(), whole);
    }
}
