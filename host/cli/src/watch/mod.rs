//! Watching a board: the options that set it, the loop that hands its stream to a
//! [`Observer`](taxel::session::Observer), and events as sentences.

mod args;
mod felt;
mod follow;
pub mod narrate;
mod open;
mod overwrite;
mod place;
pub mod rate;
pub mod raw;
pub mod shape;
pub mod stop;

pub use args::{BoardArgs, LiveArgs, seconds};
pub use felt::{Basis, Felt};
pub use follow::{Remarks, run_limit, watch};
pub use overwrite::Overwrite;
pub use place::TaxelPlace;
