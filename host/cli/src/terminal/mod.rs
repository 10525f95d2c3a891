//! A board's stream in the terminal: panes and maps, lines of text, one taxel.

mod curve;
mod head;
mod lines;
mod map;
mod panes;
pub mod ramp;
mod scale;
mod screen;
mod taxel;
mod view;

pub use lines::Lines;
pub use screen::Screen;
pub use taxel::TaxelLines;
pub use view::View;
