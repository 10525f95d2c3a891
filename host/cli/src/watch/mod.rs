//! Watching a board: the options that set it, the loop that hands its stream to a
//! [`Observer`](taxel::session::Observer), and events as sentences.

#[cfg(feature = "program")]
mod args;
mod felt;
#[cfg(feature = "program")]
mod follow;
pub mod narrate;
#[cfg(feature = "program")]
mod open;
#[cfg(feature = "program")]
mod overwrite;
#[cfg(feature = "program")]
mod place;
pub mod rate;
#[cfg(feature = "program")]
pub mod raw;
#[cfg(feature = "program")]
mod requests;
#[cfg(feature = "program")]
mod robot;
pub mod shape;
#[cfg(feature = "program")]
pub mod stop;

#[cfg(feature = "program")]
pub use args::{BoardArgs, time};
pub use felt::Felt;
#[cfg(feature = "program")]
pub use follow::{Remarks, WatchOptions, run_limit, watch};
#[cfg(feature = "program")]
pub use overwrite::Overwrite;
#[cfg(feature = "program")]
pub use place::TaxelPlace;
#[cfg(feature = "program")]
pub use requests::{HostInput, RequestLines};
#[cfg(feature = "program")]
pub use robot::{RobotNews, RobotObserver, watch_robot};
