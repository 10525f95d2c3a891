//! A linear model of a touch, read in place from the bytes of its file.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | `taxel-t` and the version, 2 |
//! | 4 | length of the notes |
//! | n | notes: the provenance as JSON, which the board passes over |
//! | 2 | classes, 2 ..= 8 |
//! | 2 | features that are used |
//! | 2 | a cell above this counts as touched |
//! | 16 each | names of the classes, padded with zeros |
//! | 4 each | offsets of the classes, Q18, signed |
//! | 6 + 2 c each | a feature: its index, its middle, its scale (65,536 / deviation), its weights, Q10, signed |
//! | 4 | CRC-32 of all before |
//!
//! All numbers are little-endian.

use super::state::{FEATURES, Features};
use crate::format::{Name, name};
use crc::{CRC_32_ISO_HDLC, Crc, NoTable};

/// Most classes of a model.
pub const CLASSES: usize = 8;

/// Most bytes of a model.
pub const LARGEST: usize = 48 << 10;

/// How a model begins; the last byte is the version.
pub const MAGIC: [u8; 8] = *b"taxel-t\x02";

/// A feature lies within 2.5 deviations of its middle, Q8; what is beyond counts as that.
pub const LIMIT: i32 = 640;

/// What each class scores, Q18; classes that the model does not have score 0.
pub type Scores = [i32; CLASSES];

/// Why bytes are no model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelError {
    /// More than [`LARGEST`] bytes.
    Large(usize),
    /// The first bytes are not those of a model.
    Foreign,
    /// Of a version that is not known.
    Version(u8),
    /// Fewer bytes than the head promises.
    Truncated(usize),
    /// More bytes than the head promises, by so many.
    Longer(usize),
    /// The checksum is not that of the bytes.
    Damaged,
    /// Not 2 ..= 8 classes.
    Classes(u16),
    /// A class without a name, or with one that is not text.
    Nameless(usize),
    /// The feature at a place has an index that is not above that before it, or that does not exist.
    Feature(usize, u16),
    /// The weights of a class may sum up to more than 31 bits.
    Heavy(usize),
}

impl core::fmt::Display for ModelError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            ModelError::Large(bytes) => {
                write!(f, "{bytes} bytes are too many for a board: at most {LARGEST}")
            }
            ModelError::Foreign => write!(f, "not a model of touches"),
            ModelError::Version(version) => write!(f, "a model of version {version}, known is 2"),
            ModelError::Truncated(bytes) => {
                write!(f, "truncated: {bytes} bytes are fewer than the head says")
            }
            ModelError::Longer(bytes) => write!(f, "{bytes} bytes more than the head says"),
            ModelError::Damaged => write!(f, "damaged: the checksum differs"),
            ModelError::Classes(count) => write!(f, "{count} classes, expected 2 to {CLASSES}"),
            ModelError::Nameless(class) => write!(f, "class {class} has no name"),
            ModelError::Feature(place, index) => {
                write!(f, "feature {index} at place {place}: expected ascending ones below {FEATURES}")
            }
            ModelError::Heavy(class) => write!(f, "the weights of class {class} are too great"),
        }
    }
}

impl core::error::Error for ModelError {}

/// A model whose bytes were checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Model<'a> {
    notes: &'a [u8],
    classes: u8,
    pressed: u16,
    names: &'a [u8],
    offsets: &'a [u8],
    features: &'a [u8],
}

impl<'a> Model<'a> {
    /// Reads a model; nothing is copied.
    pub fn read(bytes: &'a [u8]) -> Result<Model<'a>, ModelError> {
        if bytes.len() > LARGEST {
            return Err(ModelError::Large(bytes.len()));
        }
        let model = Model::split(bytes)?;
        (0..model.classes()).try_for_each(|class| match model.name(class) {
            Some(name) if !name.is_empty() => Ok(()),
            _ => Err(ModelError::Nameless(class)),
        })?;
        let mut next = 0;
        for (place, feature) in model.used().enumerate() {
            if feature.index < next || usize::from(feature.index) >= FEATURES {
                return Err(ModelError::Feature(place, feature.index));
            }
            next = feature.index + 1;
        }
        (0..model.classes()).try_for_each(|class| {
            let weights = model.used().filter_map(|feature| feature.weights().nth(class));
            let most: i64 = weights.map(|w| i64::from(w.unsigned_abs()) * i64::from(LIMIT)).sum();
            let offset = model.offset(class).unsigned_abs();
            if most + i64::from(offset) < i64::from(i32::MAX) {
                Ok(())
            } else {
                Err(ModelError::Heavy(class))
            }
        })?;
        Ok(model)
    }

    /// The bytes as they lie, with lengths and checksum checked.
    fn split(bytes: &'a [u8]) -> Result<Model<'a>, ModelError> {
        let short = ModelError::Truncated(bytes.len());
        let (magic, rest) = bytes.split_first_chunk::<8>().ok_or(short)?;
        match (magic, magic.last().copied()) {
            (magic, _) if *magic == MAGIC => {}
            (magic, Some(version)) if magic.starts_with(b"taxel-t") => {
                return Err(ModelError::Version(version));
            }
            _ => return Err(ModelError::Foreign),
        }
        let (length, rest) = rest.split_first_chunk::<4>().ok_or(short)?;
        let (notes, rest) = rest.split_at_checked(u32::from_le_bytes(*length) as usize).ok_or(short)?;
        let (head, rest) = rest.split_first_chunk::<6>().ok_or(short)?;
        let [c0, c1, f0, f1, p0, p1] = *head;
        let [classes, count] = [u16::from_le_bytes([c0, c1]), u16::from_le_bytes([f0, f1])];
        if !(2..=CLASSES as u16).contains(&classes) {
            return Err(ModelError::Classes(classes));
        }
        let classes = usize::from(classes);
        let (names, rest) = rest.split_at_checked(16 * classes).ok_or(short)?;
        let (offsets, rest) = rest.split_at_checked(4 * classes).ok_or(short)?;
        let (features, rest) = rest.split_at_checked(usize::from(count) * (6 + 2 * classes)).ok_or(short)?;
        let (sum, rest) = rest.split_first_chunk::<4>().ok_or(short)?;
        if !rest.is_empty() {
            return Err(ModelError::Longer(rest.len()));
        }
        let summed = bytes.split_last_chunk::<4>().ok_or(short)?.0;
        if checksum(summed) != u32::from_le_bytes(*sum) {
            return Err(ModelError::Damaged);
        }
        let pressed = u16::from_le_bytes([p0, p1]);
        Ok(Model { notes, classes: classes as u8, pressed, names, offsets, features })
    }

    /// The provenance, as JSON.
    pub fn notes(&self) -> &'a [u8] {
        self.notes
    }

    /// Number of classes.
    pub fn classes(&self) -> usize {
        self.classes.into()
    }

    /// A cell above this counts as touched.
    pub fn pressed(&self) -> u16 {
        self.pressed
    }

    /// Name of a class, from 0.
    pub fn name(&self, class: usize) -> Option<Name> {
        let padded = self.names.chunks_exact(16).nth(class)?;
        let text = padded.split(|byte| *byte == 0).next()?;
        core::str::from_utf8(text).ok().map(name)
    }

    /// What each class scores for the features of a touch.
    pub fn scores(&self, features: &Features) -> Scores {
        let mut scores: Scores = core::array::from_fn(|class| self.offset(class));
        for used in self.used() {
            let Some(value) = features.get(usize::from(used.index)) else { continue };
            let away = (i32::from(*value) - i32::from(used.middle)).clamp(-0x7fff, 0x7fff);
            let away = ((away * i32::from(used.scale)) >> 8).clamp(-LIMIT, LIMIT);
            for (score, weight) in scores.iter_mut().zip(used.weights()) {
                *score = score.wrapping_add(away * i32::from(weight));
            }
        }
        scores
    }

    fn offset(&self, class: usize) -> i32 {
        let bytes = self.offsets.chunks_exact(4).nth(class).and_then(|bytes| bytes.first_chunk());
        bytes.map_or(0, |bytes| i32::from_le_bytes(*bytes))
    }

    fn used(&self) -> impl Iterator<Item = Used<'a>> {
        self.features.chunks_exact(6 + 2 * self.classes()).filter_map(|record| {
            let ([i0, i1, m0, m1, s0, s1], weights) = record.split_first_chunk::<6>()?;
            let [index, middle] = [[*i0, *i1], [*m0, *m1]].map(u16::from_le_bytes);
            Some(Used { index, middle, scale: u16::from_le_bytes([*s0, *s1]), weights })
        })
    }
}

/// A feature that is used.
struct Used<'a> {
    index: u16,
    middle: u16,
    scale: u16,
    weights: &'a [u8],
}

impl Used<'_> {
    fn weights(&self) -> impl Iterator<Item = i16> {
        self.weights.as_chunks().0.iter().map(|pair| i16::from_le_bytes(*pair))
    }
}

/// The checksum that ends a model.
pub fn checksum(bytes: &[u8]) -> u32 {
    Crc::<u32, NoTable>::new(&CRC_32_ISO_HDLC).checksum(bytes)
}
