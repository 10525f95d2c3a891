//! The encoder of images: [`reference`] keeps the base image on the board, [`encoder`] skips what is
//! unchanged and writes long runs, [`stretch`] encodes the taxels near a run.

mod encoder;
mod reference;
mod stretch;

pub use encoder::encode_image;
pub(crate) use reference::ImageReference;
