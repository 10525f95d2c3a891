//! The surfaces of links as triangles: what a panel is draped over.

mod drape;
mod file;
mod link;
mod model;
mod obj;
mod stl;

pub use drape::Drape;
pub use file::{parse, read};
pub use link::{OfLink, of_link};
pub use model::{Mesh, Nearest};
