//! Flash of the simulated board: sectors are erased to ones, bits are written from one to zero, and the power
//! can fail at any step.

use embedded_storage::nor_flash::{
    ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash, check_erase, check_read, check_write,
};
use fastrand::Rng;
use std::fmt;

/// Point of a power failure within a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cut {
    /// Before the step.
    Before,
    /// During the step: some bytes are written, one of them in part; some bits of a sector are erased.
    Within,
    /// After the step.
    After,
}

/// Reason for a failed step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FlashError {
    /// The power is off.
    Off,
    /// A bit that is 0 was to be written to 1 without an erasure.
    NotErased,
    /// The step is misaligned, or past the end.
    Step(NorFlashErrorKind),
}

impl fmt::Display for FlashError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FlashError::Off => write!(f, "the power is off"),
            FlashError::NotErased => write!(f, "a bit was to become 1 without an erasure"),
            FlashError::Step(kind) => write!(f, "{kind}"),
        }
    }
}

impl std::error::Error for FlashError {}

impl NorFlashError for FlashError {
    fn kind(&self) -> NorFlashErrorKind {
        match self {
            FlashError::Step(kind) => *kind,
            _ => NorFlashErrorKind::Other,
        }
    }
}

/// A flash, by default of 64 KiB, the size of the reference board's settings area.
#[derive(Debug, Clone)]
pub struct SimFlash {
    bytes: Vec<u8>,
    /// Number of writes and sector erasures.
    steps: u64,
    erased: u64,
    cut: Option<(u64, Cut)>,
    off: bool,
    rng: Rng,
}

impl Default for SimFlash {
    fn default() -> Self {
        SimFlash::new(Self::BYTES)
    }
}

impl SimFlash {
    /// Default size.
    pub const BYTES: u32 = 64 * 1024;

    /// A blank flash of so many bytes.
    pub fn new(bytes: u32) -> SimFlash {
        let bytes = vec![0xff; bytes as usize];
        SimFlash { bytes, steps: 0, erased: 0, cut: None, off: false, rng: Rng::with_seed(7) }
    }

    /// The content.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Number of writes and sector erasures.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Number of sector erasures.
    pub fn erased(&self) -> u64 {
        self.erased
    }

    /// Makes the power fail at step `step`, counted as by [`SimFlash::steps`].
    pub fn cut_at(&mut self, step: u64, cut: Cut) {
        self.cut = Some((step, cut));
    }

    /// Restores the power for good.
    pub fn restore_power(&mut self) {
        (self.off, self.cut) = (false, None);
    }

    /// Begins a step. Returns which part of it takes place.
    fn begin(&mut self) -> Result<Extent, FlashError> {
        if self.off {
            return Err(FlashError::Off);
        }
        let cut = self.cut.filter(|(step, _)| *step == self.steps).map(|(_, cut)| cut);
        self.steps += 1;
        self.off = cut.is_some();
        match cut {
            None => Ok(Extent::Whole),
            Some(Cut::Before) => Err(FlashError::Off),
            Some(Cut::Within) => Ok(Extent::Part),
            Some(Cut::After) => Ok(Extent::Whole),
        }
    }

    fn end(&self) -> Result<(), FlashError> {
        if self.off { Err(FlashError::Off) } else { Ok(()) }
    }
}

#[derive(PartialEq)]
enum Extent {
    Part,
    Whole,
}

impl ErrorType for SimFlash {
    type Error = FlashError;
}

impl ReadNorFlash for SimFlash {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), FlashError> {
        check_read(self, offset, bytes.len()).map_err(FlashError::Step)?;
        let from = self.bytes.get(offset as usize..).unwrap_or(&[]);
        bytes.iter_mut().zip(from).for_each(|(to, from)| *to = *from);
        self.end()
    }

    fn capacity(&self) -> usize {
        self.bytes.len()
    }
}

impl NorFlash for SimFlash {
    const WRITE_SIZE: usize = 1;
    const ERASE_SIZE: usize = 4096;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), FlashError> {
        check_erase(self, from, to).map_err(FlashError::Step)?;
        for start in (from..to).step_by(Self::ERASE_SIZE) {
            let extent = self.begin()?;
            let sector = self.bytes.iter_mut().skip(start as usize).take(Self::ERASE_SIZE);
            match extent {
                Extent::Whole => sector.for_each(|byte| *byte = 0xff),
                Extent::Part => sector.for_each(|byte| *byte |= self.rng.u8(..)),
            }
            self.erased += 1;
            self.end()?;
        }
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), FlashError> {
        check_write(self, offset, bytes.len()).map_err(FlashError::Step)?;
        let extent = self.begin()?;
        let done = if extent == Extent::Part { self.rng.usize(..bytes.len().max(1)) } else { bytes.len() };
        let held = self.bytes.iter_mut().skip(offset as usize);
        for (index, (held, byte)) in held.zip(bytes).enumerate().take(done + 1) {
            if byte & !*held != 0 {
                return Err(FlashError::NotErased);
            }
            // Some bits of the byte at which the power fails are written.
            *held &= if index < done { *byte } else { byte | self.rng.u8(..) };
        }
        self.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_only_fall_until_their_sector_is_erased() {
        let mut flash = SimFlash::default();
        let read = |flash: &mut SimFlash, offset| {
            let mut byte = [0];
            flash.read(offset, &mut byte).unwrap();
            byte[0]
        };
        flash.write(4095, &[0x0f, 0xf0]).unwrap();
        flash.write(4095, &[0x0e]).unwrap();
        assert_eq!(flash.write(4096, &[0xff]), Err(FlashError::NotErased));
        assert_eq!((read(&mut flash, 4095), read(&mut flash, 4096)), (0x0e, 0xf0));
        flash.erase(4096, 8192).unwrap();
        assert_eq!((read(&mut flash, 4095), read(&mut flash, 4096)), (0x0e, 0xff));
        assert!(flash.erase(1, 4096).is_err() && flash.write(65_535, &[0, 0]).is_err());
    }

    #[test]
    fn power_fails_where_it_is_cut() {
        for (cut, first, last) in [(Cut::Before, 0xff, 0xff), (Cut::After, 0, 0)] {
            let mut flash = SimFlash::default();
            flash.write(0, &[1]).unwrap();
            flash.cut_at(1, cut);
            assert_eq!(flash.write(8, &[0; 100]), Err(FlashError::Off));
            assert_eq!(flash.erase(0, 4096), Err(FlashError::Off));
            flash.restore_power();
            let mut held = [0; 108];
            flash.read(0, &mut held).unwrap();
            assert_eq!((held[0], held[8], held[107]), (1, first, last));
        }
        let mut flash = SimFlash::default();
        flash.cut_at(0, Cut::Within);
        assert_eq!(flash.write(0, &[0; 1000]), Err(FlashError::Off));
        let written = flash.bytes.iter().filter(|byte| **byte == 0).count();
        assert!(0 < written && written < 1000, "{written}");
    }
}
