//! How a garment is worn, found again from touches.

mod exact;
mod simulated;
mod worn_case;
mod wrong;
