//! The word that survives a reset.

/// Upper half of a word written by this module; a word after power-up has another.
const MAGIC: u32 = 0x7ac5;
/// Value of `saves` if their number is unknown.
const UNKNOWN: u8 = 15;

/// End of a run of the board, if it was noted.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ending {
    /// No end yet, or none that was noted.
    #[default]
    Running = 0,
    /// Panic.
    Panic = 1,
    /// A host requested a restart.
    Request = 2,
}

/// State from the run before the reset.
///
/// | bits | field |
/// |---|---|
/// | 31..16 | [`MAGIC`] |
/// | 15..14 | `ending` |
/// | 13 | `aside` |
/// | 11..8 | `saves`, 15 if unknown |
/// | 7..0 | `resets` |
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub(super) struct Kept {
    /// End of the run.
    pub ending: Ending,
    /// The stored settings stay out of use until power-off, or until settings are saved.
    pub aside: bool,
    /// Saves that were left.
    pub saves: Option<u8>,
    /// Resets by watchdog or panic, each less than a minute after the one before.
    pub resets: u8,
}

impl Kept {
    /// Decodes a word; none if it was not written by this module.
    pub fn read(word: u32) -> Option<Kept> {
        if word >> 16 != MAGIC {
            return None;
        }
        let ending = match word >> 14 & 3 {
            0 => Ending::Running,
            1 => Ending::Panic,
            2 => Ending::Request,
            _ => return None,
        };
        let saves = (word >> 8 & 15) as u8;
        let saves = Some(saves).filter(|saves| *saves != UNKNOWN);
        Some(Kept { ending, aside: word >> 13 & 1 == 1, saves, resets: word as u8 })
    }

    /// Encodes the state.
    pub fn word(self) -> u32 {
        let saves = self.saves.map_or(UNKNOWN, |saves| saves.min(UNKNOWN - 1));
        let flags = (self.ending as u32) << 14 | u32::from(self.aside) << 13;
        MAGIC << 16 | flags | u32::from(saves) << 8 | u32::from(self.resets)
    }
}

/// Returns the word that a panicking board keeps instead of `word`.
pub fn panicked(word: u32) -> u32 {
    Kept { ending: Ending::Panic, ..Kept::read(word).unwrap_or_default() }.word()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_is_read_as_it_was_written_or_is_not_ours() {
        let mut ours = 0;
        for low in 0..=u32::from(u16::MAX) {
            let Some(kept) = Kept::read(MAGIC << 16 | low) else { continue };
            ours += 1;
            // Bit 12 is unused.
            assert_eq!(kept.word(), MAGIC << 16 | low & !(1 << 12));
        }
        assert_eq!(ours, 3 << 14);
        for word in [0, u32::MAX, 0xb007_c0d3, 0x7ac4_0000] {
            assert_eq!(Kept::read(word), None);
        }
    }

    #[test]
    fn a_panic_keeps_the_rest_of_the_word() {
        let kept = Kept { ending: Ending::Running, aside: true, saves: Some(3), resets: 2 };
        assert_eq!(Kept::read(panicked(kept.word())), Some(Kept { ending: Ending::Panic, ..kept }));
        assert_eq!(Kept::read(panicked(0)), Some(Kept { ending: Ending::Panic, ..Kept::default() }));
    }
}
