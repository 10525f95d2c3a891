//! Serves a board's stream to Foxglove and other programs with its WebSocket protocol.
//!
//! The channels are those of a recording, with their schemas (see [`record`](taxel::record)). The server only
//! sends; clients cannot send requests to the board. It listens on this machine only, and admits programs,
//! pages of this machine, and of other sites those of Foxglove and of `--allow-origin`. A client that reads
//! too slowly misses messages, and is informed; it never delays the board's stream.

mod hub;
mod protocol;
mod publisher;
mod server;
mod subscriber;

pub use hub::FoxgloveHub;
pub use protocol::channel;
pub use publisher::Publisher;
pub use server::serve;
