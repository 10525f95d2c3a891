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
mod requests;
mod robot;
pub mod shape;
pub mod stop;

pub use args::{BoardArgs, time};
pub use felt::Felt;
pub use follow::{Remarks, WatchOptions, run_limit, watch};
pub use overwrite::Overwrite;
pub use place::TaxelPlace;
pub use requests::{HostInput, RequestLines};
pub use robot::{RobotNews, RobotObserver, watch_robot};
