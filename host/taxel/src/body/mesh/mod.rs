//! The surfaces of links as triangles: what a panel is draped over.

mod drape;
mod file;
mod model;
mod obj;
mod stl;

pub use drape::Drape;
pub use file::{parse, read};
pub use model::{Mesh, Nearest};
