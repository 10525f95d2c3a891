//! Saving and loading of the settings.

use crate::index::{Entry, Index, VERSION};
use crate::waitless::Waitless;
use core::fmt;
use core::ops::Range;
use embedded_storage::nor_flash::NorFlash;
use sequential_storage::cache::{Cache, Uncached};
use sequential_storage::map::{MapConfig, MapStorage};
use taxel_core::board::{Board, PART_BYTES, Part, Saved, Settings};
use taxel_core::run::block_on;

/// Greatest number of bytes of an item: four fit in a sector of 4 KiB with the map's own data.
pub const CHUNK: usize = 1000;
/// Number of items of the longest part.
const CHUNKS: usize = PART_BYTES.div_ceil(CHUNK);
/// Key of the index; the keys of the parts follow.
const INDEX: u8 = 0;
/// Bytes of an item with its key, in whole words of any flash.
const ITEM: usize = (CHUNK + 1).next_multiple_of(32);

const _: () = assert!(Part::ALL.len() * 2 * CHUNKS < 256, "the keys fit a byte");

/// Error of storing or reading settings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StoreError {
    /// The reserved sectors are not whole, or fewer than two.
    Range,
    /// The flash cannot be read, written or erased.
    Flash,
    /// The settings need more sectors than are reserved.
    Full,
    /// The stored bytes are not those that were written.
    Damaged,
    /// The settings have another storage format.
    Version,
    /// A part is too long for its place.
    TooLong(Part),
}

impl StoreError {
    /// Short description.
    pub const fn sentence(self) -> &'static str {
        match self {
            StoreError::Range => "the sectors set aside in the flash are not whole, or fewer than two",
            StoreError::Flash => "the flash cannot be read or written",
            StoreError::Full => "the flash has no room for the settings",
            StoreError::Damaged => "what the flash holds is damaged",
            StoreError::Version => "what the flash holds is of another version of the firmware",
            StoreError::TooLong(Part::Garment) => "the garment is too long to be stored",
            StoreError::TooLong(Part::Scene) => "the scene is too long to be stored",
            StoreError::TooLong(_) => "the garment has too many taxels to be stored",
        }
    }
}

impl fmt::Display for StoreError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.sentence())
    }
}

impl core::error::Error for StoreError {}

impl<E> From<sequential_storage::Error<E>> for StoreError {
    fn from(error: sequential_storage::Error<E>) -> Self {
        match error {
            sequential_storage::Error::Storage { .. } => StoreError::Flash,
            sequential_storage::Error::FullStorage => StoreError::Full,
            _ => StoreError::Damaged,
        }
    }
}

type SettingsMap<F> = MapStorage<u8, Waitless<F>, Cache<Uncached, Uncached, Uncached, u8>>;

/// Result of loading.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Found {
    /// Nothing was stored.
    Nothing,
    /// Settings that a host has set aside: the board got none of them.
    Aside,
    /// Settings, which were given to the board.
    Settings,
}

/// Settings in a range of sectors of a flash.
pub struct Store<F: NorFlash> {
    map: SettingsMap<F>,
}

impl<F: NorFlash> Store<F> {
    /// Opens the sectors from offset `range.start` up to `range.end` of `flash`. Error if they are not whole,
    /// or fewer than two.
    pub fn new(flash: F, range: Range<u32>) -> Result<Self, StoreError> {
        let config = MapConfig::try_new(range).map_err(|_| StoreError::Range)?;
        Ok(Store { map: MapStorage::new(Waitless(flash), config, Cache::new_uncached()) })
    }

    /// Stores what has changed. If power fails meanwhile, either the old settings or these are loaded later.
    /// The exception: if something else has written to the sectors so that nothing can be added, they are
    /// erased first, and a power cut may leave neither.
    pub fn save(&mut self, settings: &Settings<'_>) -> Result<Saved, StoreError> {
        let in_the_way = match self.change(settings) {
            Ok(Saved::Unchanged) => return Ok(Saved::Unchanged),
            // A flash reports no error for bits that it could not raise.
            Ok(Saved::Written) => !self.holds(settings)?,
            Err(error @ StoreError::TooLong(_)) => return Err(error),
            Err(StoreError::Full) if !self.has_room(settings)? => return Err(StoreError::Full),
            Err(_) => true,
        };
        if in_the_way {
            self.clear()?;
            self.change(settings)?;
        }
        Ok(Saved::Written)
    }

    /// True if these settings can be read back.
    #[inline(never)] // out of line: its stack is needed only during the call
    fn holds(&mut self, settings: &Settings<'_>) -> Result<bool, StoreError> {
        let index = match self.index() {
            Ok(Some(index)) => index,
            Ok(None) | Err(StoreError::Damaged | StoreError::Version) => return Ok(false),
            Err(error) => return Err(error),
        };
        let mut content = [0; PART_BYTES];
        for part in Part::ALL {
            let content = settings.write(part, &mut content).map_err(|_| StoreError::TooLong(part))?;
            let holds = match (index.entry(part), content) {
                (Some(entry), Some(content)) => entry.holds(content) && self.stands(&entry, content)?,
                (None, None) => true,
                _ => false,
            };
            if !holds {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// True if these settings fit in otherwise empty sectors: four items each, and one sector stays free.
    #[inline(never)] // out of line: its stack is needed only during the call
    fn has_room(&mut self, settings: &Settings<'_>) -> Result<bool, StoreError> {
        let mut content = [0; PART_BYTES];
        let mut items = 1;
        for part in Part::ALL {
            let content = settings.write(part, &mut content).map_err(|_| StoreError::TooLong(part))?;
            items += content.map_or(0, |content| content.len().div_ceil(CHUNK));
        }
        let sectors = self.map.flash_range().len() / F::ERASE_SIZE;
        Ok(items <= 4 * sectors.saturating_sub(1))
    }

    #[inline(never)] // out of line: its stack is needed only during the call
    fn change(&mut self, settings: &Settings<'_>) -> Result<Saved, StoreError> {
        let old = match self.index() {
            Ok(index) => index,
            Err(StoreError::Flash) => return Err(StoreError::Flash),
            // Settings that cannot be read are lost: the new ones replace them.
            Err(_) => None,
        };
        if old.is_none() {
            self.clear()?;
        }
        let mut new = Index::new(settings.saves);
        let mut content = [0; PART_BYTES];
        for part in Part::ALL {
            let Some(content) = settings.write(part, &mut content).map_err(|_| StoreError::TooLong(part))?
            else {
                continue;
            };
            let before = old.as_ref().and_then(|index| index.entry(part));
            let entry = match before {
                Some(entry) if entry.holds(content) && self.stands(&entry, content)? => entry,
                before => self.write(part, before.map_or(0, |entry| entry.place ^ 1), content)?,
            };
            // Always room for every part.
            let _ = new.entries.push(entry);
        }
        if old.is_some_and(|old| old.entries == new.entries && !old.more.aside) {
            return Ok(Saved::Unchanged);
        }
        self.put_index(&new)?;
        Ok(Saved::Written)
    }

    /// Erases all sectors that are not blank: another program may have left bytes there that settings cannot
    /// overwrite.
    fn clear(&mut self) -> Result<(), StoreError> {
        for start in self.map.flash_range().step_by(F::ERASE_SIZE) {
            let end = start + F::ERASE_SIZE as u32;
            if !self.is_blank(start..end)? {
                self.map.flash().0.erase(start, end).map_err(|_| StoreError::Flash)?;
            }
        }
        Ok(())
    }

    fn is_blank(&mut self, sector: Range<u32>) -> Result<bool, StoreError> {
        let mut bytes = [0; 64];
        for start in sector.step_by(bytes.len()) {
            self.map.flash().0.read(start, &mut bytes).map_err(|_| StoreError::Flash)?;
            if bytes.iter().any(|byte| *byte != 0xff) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Sets the stored settings aside until the next save, so that a board does not use them at start-up; or
    /// restores them. Does nothing if they cannot be read, since they are not used then.
    pub fn put_aside(&mut self, aside: bool) -> Result<Saved, StoreError> {
        let mut index = match self.index() {
            Ok(Some(index)) if index.more.aside != aside => index,
            Err(StoreError::Flash) => return Err(StoreError::Flash),
            _ => return Ok(Saved::Unchanged),
        };
        index.more.aside = aside;
        self.put_index(&index)?;
        Ok(Saved::Written)
    }

    fn put_index(&mut self, index: &Index) -> Result<(), StoreError> {
        let mut bytes = [0; Index::BYTES];
        let bytes = index.write(&mut bytes).ok_or(StoreError::Full)?;
        self.put(INDEX, bytes)
    }

    /// Gives the stored settings to a board that has not begun yet, unless they are set aside; also the
    /// number of saves left. The board reports an invalid part; the other parts are used.
    pub fn load<const TAXELS: usize, const RUNS: usize, const PARTS: usize>(
        &mut self,
        board: &mut Board<TAXELS, RUNS, PARTS>,
    ) -> Result<Found, StoreError> {
        let Some(index) = self.index()? else { return Ok(Found::Nothing) };
        board.resume_saving(index.more.saves);
        if index.more.aside {
            return Ok(Found::Aside);
        }
        let mut content = [0; PART_BYTES];
        for part in Part::ALL {
            let Some(entry) = index.entry(part) else { continue };
            let content = self.read(&entry, &mut content)?;
            board.restore(part, content);
        }
        Ok(Found::Settings)
    }

    fn index(&mut self) -> Result<Option<Index>, StoreError> {
        let mut item = [0; ITEM];
        let Some(bytes) = block_on(self.map.fetch_item::<&[u8]>(&mut item, &INDEX))? else { return Ok(None) };
        match bytes.split_first() {
            Some((&VERSION, rest)) => Index::read(rest).map(Some).ok_or(StoreError::Damaged),
            Some(_) => Err(StoreError::Version),
            None => Err(StoreError::Damaged),
        }
    }

    /// True if a part in force can be read.
    fn stands(&mut self, entry: &Entry, content: &[u8]) -> Result<bool, StoreError> {
        for (chunk, expected) in content.chunks(CHUNK).enumerate() {
            let mut item = [0; ITEM];
            let held = block_on(self.map.fetch_item::<&[u8]>(&mut item, &key(entry, chunk)))?;
            if held != Some(expected) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn write(&mut self, part: Part, place: u8, content: &[u8]) -> Result<Entry, StoreError> {
        let entry = Entry::of(part, place, content);
        for (chunk, bytes) in content.chunks(CHUNK).enumerate() {
            self.put(key(&entry, chunk), bytes)?;
        }
        Ok(entry)
    }

    fn put(&mut self, key: u8, bytes: &[u8]) -> Result<(), StoreError> {
        let mut item = [0; ITEM];
        Ok(block_on(self.map.store_item(&mut item, &key, &bytes))?)
    }

    fn read<'b>(&mut self, entry: &Entry, content: &'b mut [u8]) -> Result<&'b [u8], StoreError> {
        let content = content.get_mut(..usize::from(entry.length)).ok_or(StoreError::Damaged)?;
        for (chunk, to) in content.chunks_mut(CHUNK).enumerate() {
            let mut item = [0; ITEM];
            match block_on(self.map.fetch_item::<&[u8]>(&mut item, &key(entry, chunk)))? {
                Some(bytes) if bytes.len() == to.len() => to.copy_from_slice(bytes),
                _ => return Err(StoreError::Damaged),
            }
        }
        if entry.holds(content) { Ok(content) } else { Err(StoreError::Damaged) }
    }
}

/// Key of a chunk of a part in its place.
fn key(entry: &Entry, chunk: usize) -> u8 {
    let place = usize::from(entry.part) * 2 + usize::from(entry.place);
    (1 + place * CHUNKS + chunk) as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::convert::Infallible;
    use embedded_storage::nor_flash::{ErrorType, ReadNorFlash};
    use heapless::Vec;

    #[test]
    fn every_chunk_has_a_key_of_its_own_and_keeps_it() {
        let mut keys = Vec::<u8, 256>::new();
        for (part, place, chunk) in Part::ALL.into_iter().flat_map(|part| {
            [0, 1].into_iter().flat_map(move |place| (0..CHUNKS).map(move |chunk| (part, place, chunk)))
        }) {
            keys.push(key(&Entry::of(part, place, &[]), chunk)).unwrap();
        }
        // Boards in use have stored their settings under these keys.
        assert_eq!((keys.first(), keys.len()), (Some(&1), Part::ALL.len() * 2 * CHUNKS));
        assert!(keys.is_sorted_by(|a, b| *b == a + 1), "{keys:?}");
        assert_eq!(key(&Entry::of(Part::Gain, 1, &[]), 2), 1 + (2 * Part::Gain as u8 + 1) * 5 + 2);
    }

    /// Two sectors of flash.
    struct Ram([u8; 8192]);

    impl ErrorType for Ram {
        type Error = Infallible;
    }

    impl ReadNorFlash for Ram {
        const READ_SIZE: usize = 1;

        fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Infallible> {
            bytes.copy_from_slice(&self.0[offset as usize..][..bytes.len()]);
            Ok(())
        }

        fn capacity(&self) -> usize {
            self.0.len()
        }
    }

    impl NorFlash for Ram {
        const WRITE_SIZE: usize = 1;
        const ERASE_SIZE: usize = 4096;

        fn erase(&mut self, from: u32, to: u32) -> Result<(), Infallible> {
            self.0[from as usize..to as usize].fill(0xff);
            Ok(())
        }

        fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Infallible> {
            self.0[offset as usize..].iter_mut().zip(bytes).for_each(|(held, byte)| *held &= byte);
            Ok(())
        }
    }

    /// As a firmware with chunks of another length would leave them.
    #[test]
    fn a_chunk_of_another_length_is_damage() {
        let mut store = Store::new(Ram([0xff; 8192]), 0..8192).unwrap();
        let (content, mut read) = ([7; 128], [0; PART_BYTES]);
        let entry = Entry::of(Part::Gain, 0, &content);
        for length in [127, 129, 0, 128] {
            store.put(key(&entry, 0), &[7; 129][..length]).unwrap();
            let expected = if length == 128 { Ok(&content[..]) } else { Err(StoreError::Damaged) };
            assert_eq!(store.read(&entry, &mut read).map(|read| read as &[u8]), expected, "{length} bytes");
        }
    }
}
