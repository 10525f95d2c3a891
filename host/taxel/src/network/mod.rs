//! Boards between machines, over Zenoh: names of the keys, how a stream is cut and put together, and how a
//! session is opened. The feature `zenoh` builds the last one; everything else needs no network.
//!
//! | file | holds |
//! |---|---|
//! | `place.rs` | [`BoardPlace`]: the name of a board, and its keys |
//! | `cut.rs` | [`FrameCutter`]: cuts a board's bytes into whole frames, and distinguishes images |
//! | `stamp.rs` | [`PieceKind`] and [`PieceStamp`]: how a frame travels, and where it belongs |
//! | `piece.rs` | [`WirePiece`]: a frame on its way |
//! | `order.rs` | [`PieceOrder`]: puts contacts and images back into the board's order |
//! | `request.rs` | [`AskedFrame`]: a request on its way to a board, and the [`words`] of an answer |
//! | `config.rs` | Zenoh's configuration, of which nothing listens to other machines unless it says so |
//!
//! A board's bytes go through unchanged: a frame of the wire is one sample. What was lost between two machines is
//! missing from the board's own numbers, and the [`Client`](crate::client::Client) counts it like any other loss.

#[cfg(feature = "zenoh")]
mod config;
mod cut;
mod order;
mod piece;
mod place;
mod request;
mod stamp;

#[cfg(feature = "zenoh")]
pub(crate) use config::said;
#[cfg(feature = "zenoh")]
pub use config::{NetworkEnd, open};
pub use cut::FrameCutter;
pub use order::{PATIENCE, PieceOrder};
pub use piece::WirePiece;
pub use place::BoardPlace;
pub use request::{AskedFrame, LONGEST_ASK, too_long, words};
pub use stamp::{PieceKind, PieceStamp};
