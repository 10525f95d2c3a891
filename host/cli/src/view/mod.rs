//! Shows a board's stream, those of a robot's boards or a recording (see `recorded`) in the browser.
//!
//! One program serves one page and all its files, to this machine only, and sends each page the stream over a
//! WebSocket; see [`message`]. Three rules keep the pages from delaying the board's stream: each page has one
//! [`Mailbox`] of bounded size, a newer image replaces a queued one, and each page has its own writing
//! thread.

#[cfg(feature = "program")]
mod assets;
#[cfg(feature = "program")]
pub mod browser;
mod hand;
mod hub;
#[cfg(feature = "program")]
mod hubs;
mod kept_log;
mod limits;
mod line_kind;
pub mod lines;
mod mailbox;
pub mod message;
mod order;
#[cfg(feature = "program")]
mod page;
#[cfg(feature = "program")]
mod past;
mod raw;
mod recent;
#[cfg(feature = "program")]
mod recorded;
#[cfg(feature = "program")]
mod robot;
mod said;
#[cfg(feature = "schema")]
pub mod schemas;
#[cfg(feature = "program")]
mod server;
mod setup;
mod shot;
mod tape;
#[cfg(feature = "program")]
mod token;
#[cfg(feature = "program")]
mod transfer;
mod viewer;

pub use hand::PageHand;
pub use hub::PageHub;
#[cfg(feature = "program")]
pub use hubs::PageHubs;
pub use limits::SceneLimits;
pub use line_kind::LineKind;
pub use mailbox::{Mailbox, Parcel};
pub use order::Order;
#[cfg(feature = "program")]
pub use page::hear;
pub use recent::Recent;
#[cfg(feature = "program")]
pub use recorded::Player;
#[cfg(feature = "program")]
pub use robot::RobotPages;
pub use said::Said;
#[cfg(feature = "program")]
pub use server::{serve, serve_guests};
pub use shot::Shot;
pub use tape::Tape;
#[cfg(feature = "program")]
pub use token::Token;
pub use viewer::Viewer;
