//! How a garment sits, found again from touches.

mod displaced;
mod exact;
mod simulated;
mod wrong;
