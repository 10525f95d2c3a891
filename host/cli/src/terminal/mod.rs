//! A board's stream in the terminal: panes and maps, lines of text, one taxel, and a picture of the panes.

mod curve;
mod head;
mod lines;
mod map;
mod panes;
pub mod ramp;
mod scale;
mod screen;
mod svg;
mod taxel;
mod view;

pub use lines::Lines;
pub use screen::Screen;
pub use svg::{Painter, picture};
pub use taxel::TaxelLines;
pub use view::View;
