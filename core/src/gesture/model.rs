//! A model of touches, read in place from the bytes of its file: linear experts, each for touches from an age
//! on.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | `taxel-t` and the version, 3 |
//! | 4 | length of the notes |
//! | n | notes: the provenance as JSON, which the board skips |
//! | 2 | number of classes, 2 ..= 8 |
//! | 2 | number of experts, 1 ..= 3 |
//! | 2 | a cell above this counts as touched |
//! | 2 | 1: the last expert classifies a finished touch, whatever its age; 0: the expert of its age does |
//! | 16 each | names of the classes, padded with zeros |
//! | | the experts, by age: see `expert.rs` |
//! | 4 | CRC-32 of all bytes before |
//!
//! All numbers are little-endian. Version 2 can still be read. It has one expert: the field of the number of
//! experts holds the number of its features, and the head, the rows, and the field on the last expert are
//! missing.

use super::expert::{Expert, Head};
use super::model_error::{CLASSES, EXPERTS, LARGEST, ModelError};
use crate::format::{Name, crc32, name};

/// First bytes of a model; the last of them is the version.
pub const MAGIC: [u8; 8] = *b"taxel-t\x03";

/// First bytes of a model of the previous version.
const BEFORE: [u8; 8] = *b"taxel-t\x02";

/// A model whose bytes have been checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Model<'a> {
    notes: &'a [u8],
    classes: u8,
    count: u8,
    concludes: bool,
    pressed: u16,
    names: &'a [u8],
    experts: [Expert<'a>; EXPERTS],
}

impl<'a> Model<'a> {
    /// Reads and checks a model in place; nothing is copied.
    pub fn read(bytes: &'a [u8]) -> Result<Model<'a>, ModelError> {
        if bytes.len() > LARGEST {
            return Err(ModelError::Large(bytes.len()));
        }
        let model = Model::split(bytes)?;
        (0..model.classes()).try_for_each(|class| match model.name(class) {
            Some(name) if !name.is_empty() => Ok(()),
            _ => Err(ModelError::Nameless(class)),
        })?;
        let mut before = None;
        for (place, expert) in model.experts().enumerate() {
            if before.map_or(expert.from() != 0, |before| expert.from() <= before) {
                return Err(ModelError::Age(place, expert.from()));
            }
            before = Some(expert.from());
            expert.check()?;
        }
        Ok(model)
    }

    /// Splits the bytes into their fields; checks lengths and checksum.
    fn split(bytes: &'a [u8]) -> Result<Model<'a>, ModelError> {
        let short = ModelError::Truncated(bytes.len());
        let (magic, rest) = bytes.split_first_chunk::<8>().ok_or(short)?;
        match (magic, magic.last().copied()) {
            (magic, _) if [MAGIC, BEFORE].contains(magic) => {}
            (magic, Some(version)) if magic.starts_with(b"taxel-t") => {
                return Err(ModelError::Version(version));
            }
            _ => return Err(ModelError::Foreign),
        }
        let (length, rest) = rest.split_first_chunk::<4>().ok_or(short)?;
        let (notes, rest) = rest.split_at_checked(u32::from_le_bytes(*length) as usize).ok_or(short)?;
        let (head, rest) = rest.split_first_chunk::<6>().ok_or(short)?;
        let [c0, c1, f0, f1, p0, p1] = *head;
        let [classes, number, pressed] = [[c0, c1], [f0, f1], [p0, p1]].map(u16::from_le_bytes);
        if !(2..=CLASSES as u16).contains(&classes) {
            return Err(ModelError::Classes(classes));
        }
        let classes = classes as u8;
        // In version 2 the number is that of the features of its one expert.
        let alone = (*magic == BEFORE).then(|| Head::alone(number));
        let count = if alone.is_some() { 1 } else { number };
        if !(1..=EXPERTS as u16).contains(&count) {
            return Err(ModelError::Experts(count));
        }
        let (concludes, rest) = match alone {
            Some(_) => ([0, 0], rest),
            None => rest.split_first_chunk::<2>().map(|(word, rest)| (*word, rest)).ok_or(short)?,
        };
        let (names, mut rest) = rest.split_at_checked(16 * usize::from(classes)).ok_or(short)?;
        let mut experts = [Expert::NONE; EXPERTS];
        for place in experts.iter_mut().take(count.into()) {
            let (head, body) = match alone {
                Some(head) => (head, rest),
                None => Head::split(rest).ok_or(short)?,
            };
            (*place, rest) = Expert::split(head, classes, body).ok_or(short)?;
        }
        check_end(bytes, rest)?;
        let concludes = u16::from_le_bytes(concludes) != 0;
        Ok(Model { notes, classes, count: count as u8, concludes, pressed, names, experts })
    }

    /// Provenance, as JSON.
    pub fn notes(&self) -> &'a [u8] {
        self.notes
    }

    /// Number of classes.
    pub fn classes(&self) -> usize {
        self.classes.into()
    }

    /// Greatest value of a cell that counts as untouched.
    pub fn pressed(&self) -> u16 {
        self.pressed
    }

    /// Name of a class, from 0.
    pub fn name(&self, class: usize) -> Option<Name> {
        let padded = self.names.chunks_exact(16).nth(class)?;
        let text = padded.split(|byte| *byte == 0).next()?;
        core::str::from_utf8(text).ok().map(name)
    }

    /// The experts, by age.
    pub fn experts(&self) -> impl Iterator<Item = &Expert<'a>> {
        self.experts.iter().take(self.count.into())
    }

    /// The expert for a touch in progress that has lasted `frames`.
    pub fn expert(&self, frames: u32) -> Option<&Expert<'a>> {
        self.experts().take_while(|expert| u32::from(expert.from()) <= frames).last()
    }

    /// The expert for a finished touch that has lasted `frames`.
    pub fn concluding(&self, frames: u32) -> Option<&Expert<'a>> {
        if self.concludes { self.experts().last() } else { self.expert(frames) }
    }
}

/// Checks that `rest` is the correct checksum and nothing else.
fn check_end(bytes: &[u8], rest: &[u8]) -> Result<(), ModelError> {
    let short = ModelError::Truncated(bytes.len());
    let (sum, rest) = rest.split_first_chunk::<4>().ok_or(short)?;
    if !rest.is_empty() {
        return Err(ModelError::Longer(rest.len()));
    }
    let summed = bytes.split_last_chunk::<4>().ok_or(short)?.0;
    if crc32(summed) == u32::from_le_bytes(*sum) { Ok(()) } else { Err(ModelError::Damaged) }
}
