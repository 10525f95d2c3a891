//! Shapes of contacts in words, reported only where the recogniser is sure.

use taxel::client::Client;
use taxel_core::body::Placed;
use taxel_core::format::Q15;
use taxel_core::shape::Class;

/// Confidence from which a shape is reported: below, another is about as likely.
const SURE: Q15 = Q15(24_576);

/// Name of a contact's shape; `touch` unless the recogniser is sure of it.
pub fn shape(client: &Client, placed: &Placed) -> String {
    if is_sure(client, placed) { client.shape_name(placed.shape.class) } else { "touch".into() }
}

/// True if the recogniser is sure of a contact's shape. Of the built-in base it never is: the nearest prototype alone
/// decides there, so that the confidence is always 1, and a palm or a ball is a rectangle.
pub fn is_sure(client: &Client, Placed { contact, shape, .. }: &Placed) -> bool {
    let is_known = client.is_taught() && shape.class != Class::UNKNOWN;
    is_known && shape.confidence >= SURE && !client.is_unsure(contact.id)
}
