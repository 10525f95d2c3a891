//! The limits of a model, and what is wrong with a file that is none.

use super::state::FEATURES;

/// Greatest number of classes of a model.
pub const CLASSES: usize = 8;

/// Greatest number of bytes of a model.
pub const LARGEST: usize = 48 << 10;

/// Greatest number of experts of a model.
pub const EXPERTS: usize = 3;

/// Error of a file that is not a valid model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelError {
    /// More than [`LARGEST`] bytes.
    Large(usize),
    /// The first bytes are not those of a model.
    Foreign,
    /// The version is unknown.
    Version(u8),
    /// Fewer bytes than the head promises.
    Truncated(usize),
    /// More bytes than the head promises, by this many.
    Longer(usize),
    /// The checksum is not that of the bytes.
    Damaged,
    /// Not 2 ..= 8 classes.
    Classes(u16),
    /// Not 1 ..= 3 experts.
    Experts(u16),
    /// The expert at this place does not begin at a later age than the one before it, or the first not at 0.
    Age(usize, u16),
    /// A class without a name, or with one that is not text.
    Nameless(usize),
    /// The feature at this place has an index that does not exist, or that is not above the one before.
    Feature(usize, u16),
    /// The weights of a class may add up to more than 31 bits.
    Heavy(usize),
}

impl core::fmt::Display for ModelError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            ModelError::Large(bytes) => {
                write!(f, "{bytes} bytes are too many for a board: at most {LARGEST}")
            }
            ModelError::Foreign => write!(f, "not a model of touches"),
            ModelError::Version(version) => write!(f, "a model of version {version}, known are 2 and 3"),
            ModelError::Truncated(bytes) => {
                write!(f, "truncated: {bytes} bytes are fewer than the head says")
            }
            ModelError::Longer(bytes) => write!(f, "{bytes} bytes more than the head says"),
            ModelError::Damaged => write!(f, "damaged: the checksum differs"),
            ModelError::Classes(count) => write!(f, "{count} classes, expected 2 to {CLASSES}"),
            ModelError::Experts(count) => write!(f, "{count} experts, expected 1 to {EXPERTS}"),
            ModelError::Age(place, from) => {
                write!(
                    f,
                    "expert {place} speaks from frame {from}: expected 0 for the first, then ascending ones"
                )
            }
            ModelError::Nameless(class) => write!(f, "class {class} has no name"),
            ModelError::Feature(place, index) => {
                write!(f, "feature {index} at place {place}: expected ascending ones below {FEATURES}")
            }
            ModelError::Heavy(class) => write!(f, "the weights of class {class} are too great"),
        }
    }
}

impl core::error::Error for ModelError {}
