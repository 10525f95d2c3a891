//! The surfaces of links as triangles: what a panel is draped over.

mod file;
mod model;
mod obj;
mod stl;

pub use file::{parse, read};
pub use model::{Mesh, Nearest};
