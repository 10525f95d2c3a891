//! Errors of a garment. Each names the place as the author wrote it.

use super::config::{CIRCUIT_LINES, PITCH_UM, Side};
use super::pins::{NotFree, PinList};
use crate::format::Name;
use core::fmt;

/// Error of a garment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum GarmentError {
    /// The garment has no name.
    NoName,
    /// The garment has no panel.
    Empty,
    /// A panel without a name, a link or a region.
    Nameless {
        /// index of the panel
        panel: usize,
        /// "name", "link" or "region"
        key: &'static str,
    },
    /// A pitch is out of range.
    Pitch {
        /// the panel
        panel: Name,
        /// the pitch, um
        um: u32,
    },
    /// A pitch is given along one axis only.
    HalfPitch(Name),
    /// A panel without rows or without columns.
    EmptyPanel(Name),
    /// Two panels have the same name.
    DuplicatePanel(Name),
    /// More taxels than this board or program can hold.
    TooLarge {
        /// taxels of the garment
        taxels: u32,
        /// most taxels that fit
        capacity: u32,
    },
    /// A contact that fills the panels would have moments that are not exact in 64 bits.
    Inexact {
        /// the panel, or the first of those sewn together
        panel: Name,
        /// largest value of a taxel
        full_scale: u16,
    },
    /// A block, seam or absent rectangle names a panel that does not exist.
    NoSuchPanel {
        /// "block", "seam" or "absent"
        what: &'static str,
        /// index in the garment
        index: usize,
        /// the panel it names
        panel: u8,
    },
    /// A block or an absent rectangle reaches outside its panel, or is empty.
    OutsidePanel {
        /// "block" or "absent"
        what: &'static str,
        /// index in the garment
        index: usize,
        /// the panel
        panel: Name,
    },
    /// An edge of a seam reaches outside its panel's side, or is empty.
    OutsideSide {
        /// index of the seam
        seam: usize,
        /// the panel
        panel: Name,
        /// the side
        side: Side,
    },
    /// A seam sews taxels to themselves.
    SelfSewn(usize),
    /// The garment has no block: nothing can be scanned.
    NoBlock,
    /// Two blocks cover the same taxel.
    Overlap(usize, usize),
    /// A taxel that is not absent lies in no block.
    Uncovered {
        /// the panel
        panel: Name,
        /// row
        row: u16,
        /// column
        column: u16,
    },
    /// Two blocks have the same select code on the same input.
    SameSelect(usize, usize),
    /// A code does not fit the lines of its group.
    Code {
        /// index of the block
        block: usize,
        /// "block", "row" or "column"
        group: &'static str,
        /// highest code that is needed
        code: u32,
        /// number of codes that the lines carry
        codes: u32,
    },
    /// A pin is used twice.
    PinTwice(u8),
    /// A select line is on a pin that the board does not bring out as an output.
    NoOutput {
        /// GPIO number
        pin: u8,
        /// why the pin is no output
        why: NotFree,
    },
    /// More select and enable lines than a garment may have.
    TooManyLines,
    /// An input is no converter pin of the board.
    NoAdc {
        /// index of the block
        block: usize,
        /// GPIO number
        pin: u8,
        /// converter inputs of the board, bit `n` for GPIO `n`
        inputs: u64,
    },
}

impl fmt::Display for GarmentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use GarmentError::*;
        match self {
            NoName => write!(f, "name: the garment has none"),
            Empty => write!(f, "panels: the garment has none"),
            EmptyPanel(p) => write!(f, "panel {p}: rows and columns must be at least 1"),
            DuplicatePanel(p) => write!(f, "panel {p}: the name is used twice"),
            Nameless { panel, key } => write!(f, "panel {panel}: its {key} is empty"),
            Pitch { panel, um } => pitch(f, panel, *um),
            HalfPitch(panel) => {
                write!(f, "panel {panel}: pitch_um is 0 along one axis: it is known along both or none")
            }
            TooLarge { taxels, capacity } => {
                write!(f, "panels: {taxels} taxels, but only {capacity} fit")
            }
            Inexact { panel, full_scale } => write!(
                f,
                "panel {panel}: too large for exact moments at full scale {full_scale} (and the panels sewn to it)"
            ),
            NoSuchPanel { what, index, panel } => {
                write!(f, "{what} {index}: there is no panel {panel}")
            }
            OutsidePanel { what, index, panel } => {
                write!(f, "{what} {index}: it is empty or leaves panel {panel}")
            }
            OutsideSide { seam, panel, side } => {
                write!(f, "seam {seam}: it is empty or leaves the {side:?} side of panel {panel}")
            }
            SelfSewn(seam) => write!(f, "seam {seam}: it sews taxels of a panel to themselves"),
            NoBlock => write!(f, "blocks: the garment has none"),
            Overlap(a, b) => write!(f, "blocks {a} and {b}: they cover the same taxel"),
            Uncovered { panel, row, column } => {
                write!(f, "panel {panel}: row {row}, column {column} lies in no block and is not absent")
            }
            SameSelect(a, b) => write!(f, "blocks {a} and {b}: same select code on the same input"),
            Code { block, group, code, codes } => write!(
                f,
                "block {block}: {group} code {code} does not fit the {codes} codes of the {group} lines"
            ),
            PinTwice(pin) => write!(f, "wiring: pin {pin} is used twice"),
            NoOutput { pin, why } => write!(f, "wiring: pin {pin} is no free output of this board: {why}"),
            TooManyLines => write!(f, "wiring: it has more than {CIRCUIT_LINES} lines"),
            NoAdc { block, pin, inputs } => write!(
                f,
                "block {block}: input {pin} is no converter input of this board, which has {}",
                PinList(*inputs)
            ),
        }
    }
}

/// Writes the error of a pitch out of range, with a hint in um if it seems to be given in mm or nm.
fn pitch(f: &mut fmt::Formatter<'_>, panel: &Name, um: u32) -> fmt::Result {
    let [least, most] = PITCH_UM;
    write!(f, "panel {panel}: pitch_um is {um}, outside {least} to {most}")?;
    let meant = if um < least { um.saturating_mul(1000) } else { um / 1000 };
    if (least..=most).contains(&meant) { write!(f, ": did you mean {meant}?") } else { Ok(()) }
}

impl core::error::Error for GarmentError {}
