//! Shows a board's stream, those of a robot's boards or a recording (see `recorded`) in the browser.
//!
//! One program serves one page and all its files, to this machine only, and sends each page the stream over a
//! WebSocket; see [`message`]. Three rules keep the pages from delaying the board's stream: each page has one
//! [`Mailbox`] of bounded size, a newer image replaces a queued one, and each page has its own writing
//! thread.

mod assets;
pub mod browser;
mod hand;
mod hub;
mod hubs;
mod kept_log;
mod line_kind;
mod lines;
mod mailbox;
pub mod message;
mod order;
mod page;
mod past;
mod raw;
mod recent;
mod recorded;
mod robot;
mod said;
#[cfg(feature = "schema")]
pub mod schemas;
mod server;
mod shot;
mod tape;
mod transfer;
mod viewer;

pub use hand::PageHand;
pub use hub::PageHub;
pub use hubs::PageHubs;
pub use line_kind::LineKind;
pub use mailbox::{Mailbox, Parcel};
pub use order::Order;
pub use page::hear;
pub use recent::Recent;
pub use recorded::Player;
pub use robot::RobotPages;
pub use said::Said;
pub use server::serve;
pub use shot::Shot;
pub use tape::Tape;
pub use viewer::Viewer;
