//! A board, offered to other machines over Zenoh.
//!
//! | file | holds |
//! |---|---|
//! | `board.rs` | [`BoardOffer`]: publishes what a board says, and takes requests to it |
//! | `asks.rs` | requests of others, which come as queries |
//! | `state.rs` | what the board is, as JSON |

mod asks;
mod board;
mod state;

pub use board::BoardOffer;
pub use state::OfferState;
