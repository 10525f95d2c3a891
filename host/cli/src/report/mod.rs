//! A recording or a board on one self-contained HTML page. Its one script draws in three dimensions, as the page does.
//!
//! | section | what | file |
//! |---|---|---|
//! | pressure, 2-D | each panel at the moment of the greatest force: cells, lines of equal pressure, contacts, peaks | `plane.rs` |
//! | pressure, 3-D | the same moment as a surface, drawn by the scripts of the page | `surface.rs`, `script.rs`, `frozen.js` |
//! | on the robot | the same moment on a body, if there is one | `surface.rs`, `frozen.js` |
//! | ranges | how many taxels lie in which range of pressure, then and at their greatest | `ranges.rs` |
//! | over time | force by panel, activation of each concept | `strips.rs` |
//! | contacts, events, health | | `tables.rs` |

mod contour;
mod page;
mod plane;
mod ranges;
mod scale;
mod script;
mod seen;
mod series;
mod strips;
mod surface;
pub mod svg;
mod tables;

pub use page::page;
pub use seen::Seen;
