//! Sends a base to a board.

use super::base::Base;
use crate::client::Client;
use crate::error::Result;
use taxel_core::shape::GalleryHead;
use taxel_core::wire::{Request, SHAPES_ADDED};

/// Queues the requests that transfer a base to a board.
pub fn teach(client: &mut Client, base: &Base) -> Result<()> {
    let known = &base.gallery;
    let head = GalleryHead {
        names: known.names.clone(),
        space: known.space.clone(),
        k: known.k,
        reject: known.reject,
        confidence: known.confidence.clone(),
        prototypes: known.prototypes.len() as u16,
    };
    client.request(&Request::SetShapes(&postcard::to_allocvec(&head)?))?;
    for some in known.prototypes.chunks(SHAPES_ADDED) {
        client.request(&Request::AddShapes(&postcard::to_allocvec(some)?))?;
    }
    Ok(())
}
