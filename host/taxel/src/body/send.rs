//! Sends a table of the surface to a board.

use crate::client::Client;
use crate::error::Result;
use taxel_core::wire::{Request, SURFACE_PIECE, TablePiece};

/// Queues the requests that store a table on the board; an empty one takes the board's table out of force. The
/// board answers each piece, the last one once the table is in force.
pub fn send(client: &mut Client, table: &[u8]) -> Result<()> {
    let length = table.len() as u32;
    // At least one: an empty piece of an empty table.
    for index in 0..table.len().div_ceil(SURFACE_PIECE).max(1) {
        let offset = index * SURFACE_PIECE;
        let bytes = &table[offset..table.len().min(offset + SURFACE_PIECE)];
        let piece = TablePiece { length, offset: offset as u32, bytes };
        client.request(&Request::SetSurface(&postcard::to_allocvec(&piece)?))?;
    }
    Ok(())
}
