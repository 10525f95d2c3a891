//! Sends a table of the surface to a board.

use crate::client::Client;
use crate::error::Result;
use taxel_core::wire::{Request, SURFACE_PIECE};

/// Queues the requests that store a table on the board; an empty one takes the board's table out of force. The
/// board answers each piece, the last one once the table is in force.
pub fn send(client: &mut Client, table: &[u8]) -> Result<()> {
    let length = table.len() as u32;
    if table.is_empty() {
        client.request(&Request::SetSurface { length, offset: 0, bytes: &[] })?;
    }
    for (index, bytes) in table.chunks(SURFACE_PIECE).enumerate() {
        client.request(&Request::SetSurface { length, offset: (index * SURFACE_PIECE) as u32, bytes })?;
    }
    Ok(())
}
