//! The garment: positions and wiring of its taxels, as one value that arrives at run time.
//!
//! [`Garment`] is written by its author (a TOML file on a host, postcard on the wire). [`Layout::build`]
//! checks the geometry, which all of perception needs. [`Circuit::build`] checks the wiring against the pins
//! that a board brings out, which only the scan needs. Taxels are numbered panel by panel, row by row:
//! `taxel = panel.base + row * panel.columns + column`; x is the column, y the row.

mod area;
mod circuit;
mod config;
mod error;
mod layout;
mod pins;
mod presets;
mod seam;

pub use area::{ASSUMED_PITCH_UM, Area, Place, Rect, cell_mm2};
pub use circuit::{Circuit, Site};
pub use config::{
    Absent, BLOCKS, Block, CIRCUIT_LINES, Coding, Garment, Group, LINES, Line, Orientation, PANELS, PITCH_UM,
    Panel, SEAMS, Seam, SeamEdge, Side, Wiring,
};
pub use error::GarmentError;
pub use layout::Layout;
pub use pins::{NotFree, PinList, Pins};
pub(crate) use seam::signed;
pub use seam::{Joint, Stretch, Transform};
