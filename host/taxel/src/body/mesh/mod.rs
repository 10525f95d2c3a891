//! The surfaces of links as triangles: what a panel is draped over, and what a robot looks like.

mod drape;
mod figure;
mod file;
mod link;
mod model;
mod obj;
mod solids;
mod stl;

pub use drape::Drape;
pub use figure::{Figure, figure};
pub use file::{parse, read};
pub use link::{OfLink, of_link};
pub use model::{Mesh, Nearest};
