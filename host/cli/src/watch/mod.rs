//! Watching a board: the options that set it, the loop that hands its stream to a
//! [`Show`](taxel::session::Show), and events as sentences.

mod args;
mod asked;
mod feed;
mod felt;
mod follow;
mod forms;
mod gesture_model;
pub mod narrate;
mod open;
mod overwrite;
mod place;
pub mod rate;
pub mod raw;
pub mod shape;
pub mod stop;

pub use args::{BoardArgs, LiveArgs, seconds};
pub use feed::feed;
pub use felt::{Basis, Felt};
pub use follow::watch;
pub use forms::forms;
pub use gesture_model::GestureModel;
pub use overwrite::Overwrite;
pub use place::TaxelPlace;
