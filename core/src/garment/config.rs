//! The garment as its author writes it.

use crate::format::Name;
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Most panels of a garment.
pub const PANELS: usize = 8;
/// Most blocks of a garment.
pub const BLOCKS: usize = 64;
/// Most lines of one select group (16 one-hot rows).
pub const LINES: usize = 16;
/// Most lines of a circuit, all groups and enables together.
pub const CIRCUIT_LINES: usize = 32;
/// Most seams between panels.
pub const SEAMS: usize = 8;
/// Most rectangles of absent taxels.
pub const ABSENT: usize = 32;

/// Smallest and largest accepted distance of taxel centres, micrometres.
pub const PITCH_UM: [u32; 2] = [500, 200_000];

/// A whole garment: panels of taxels, the blocks that tile them, seams, gaps and wiring.
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Garment {
    /// Name for people; not empty.
    pub name: Name,
    /// Connection of the multiplexers and the converter.
    pub wiring: Wiring,
    /// The panels, in the order in which their taxels are numbered.
    pub panels: Vec<Panel, PANELS>,
    /// The blocks; each taxel that is not absent lies in exactly one.
    pub blocks: Vec<Block, BLOCKS>,
    /// Panel edges that are sewn together.
    #[serde(default)]
    pub seams: Vec<Seam, SEAMS>,
    /// Rectangles of panels without taxels.
    #[serde(default)]
    pub absent: Vec<Absent, ABSENT>,
}

/// One panel: a rectangle of taxels on one link of the robot.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Panel {
    /// Unique name. Neither name nor link nor region may be empty.
    pub name: Name,
    /// Link of the robot's description (URDF) that the panel is on.
    pub link: Name,
    /// Region of the body that the panel covers; several panels may share one.
    pub region: Name,
    /// Rows (y).
    pub rows: u16,
    /// Columns (x).
    pub columns: u16,
    /// Distance of taxel centres along x and along y in micrometres, within [`PITCH_UM`]; both 0 if unknown.
    #[serde(default)]
    pub pitch_um: [u32; 2],
}

/// One block: a rectangle of taxels of one panel, read through one converter input while `select` is applied.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Block {
    /// Index of its panel.
    pub panel: u8,
    /// First row of the block's rectangle in the panel.
    pub row: u16,
    /// First column of the block's rectangle in the panel.
    pub column: u16,
    /// Rows of the block as wired (codes of the row lines).
    pub rows: u8,
    /// Columns of the block as wired (codes of the column lines).
    pub columns: u8,
    /// GPIO number of the converter input that reads it.
    pub input: u8,
    /// Code of the block lines that selects it.
    pub select: u16,
    /// Orientation of the wired block in the panel.
    #[serde(default)]
    pub orientation: Orientation,
}

/// Orientation of a block: first transposed, then mirrored along the panel's axes.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Orientation {
    /// Wired rows run along x of the panel, wired columns along y.
    pub transposed: bool,
    /// x of the panel runs against the wiring.
    pub mirror_x: bool,
    /// y of the panel runs against the wiring.
    pub mirror_y: bool,
}

/// A side of a panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// column 0, counted by row
    Left,
    /// last column, counted by row
    Right,
    /// row 0, counted by column
    Top,
    /// last row, counted by column
    Bottom,
}

/// Part of a panel's side, from taxel `start`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SeamEdge {
    /// Index of the panel.
    pub panel: u8,
    /// Side of the panel.
    pub side: Side,
    /// First taxel along that side.
    #[serde(default)]
    pub start: u16,
}

/// Two edges of the same length that are sewn together: taxel `i` of `a` adjoins taxel `i` of `b`, or
/// `length - 1 - i` if `reversed`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Seam {
    /// First edge.
    pub a: SeamEdge,
    /// Second edge.
    pub b: SeamEdge,
    /// Taxels along the seam.
    pub length: u16,
    /// True if the two run in opposite directions.
    #[serde(default)]
    pub reversed: bool,
}

/// A rectangle of a panel without taxels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Absent {
    /// Index of the panel.
    pub panel: u8,
    /// First row.
    pub row: u16,
    /// First column.
    pub column: u16,
    /// Number of rows.
    pub rows: u16,
    /// Number of columns.
    pub columns: u16,
}

/// The select lines and the converter. A single binary address is written as three groups; separate row and
/// column multiplexers as two; one-hot rows or chip enables as a group with [`Coding::OneHot`].
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wiring {
    /// Lines that select the block.
    #[serde(default)]
    pub block: Group,
    /// Lines that select the row within the block.
    #[serde(default)]
    pub row: Group,
    /// Lines that select the column within the block.
    #[serde(default)]
    pub column: Group,
    /// Lines that are asserted for the whole scan.
    #[serde(default)]
    pub enable: Vec<Line, 4>,
    /// Time from a change of the select lines to the sample, in nanoseconds. A board refuses a time at which
    /// a frame takes longer than [`LONGEST_MS`](crate::acquire::LONGEST_MS).
    pub settle_ns: u32,
    /// True if pressure lowers the code instead of raising it.
    #[serde(default)]
    pub falling: bool,
}

/// Lines that together carry one code.
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// Coding of the code on the lines.
    #[serde(default)]
    pub coding: Coding,
    /// The lines, least significant first.
    pub lines: Vec<Line, LINES>,
}

/// Coding of a code on the lines of a group.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Coding {
    /// Line `i` carries bit `i`.
    #[default]
    Binary,
    /// Only the line of the code's number is asserted.
    OneHot,
}

/// One output line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// GPIO number.
    pub pin: u8,
    /// True if the line is asserted low.
    #[serde(default)]
    pub inverted: bool,
}

impl Group {
    /// Number of codes that the group can carry.
    pub fn codes(&self) -> u32 {
        match self.coding {
            Coding::Binary => 1 << self.lines.len(),
            Coding::OneHot => (self.lines.len() as u32).max(1),
        }
    }
}
