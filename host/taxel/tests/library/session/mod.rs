//! A board that restarts, is unplugged, or loses its connection: all settings are restored, the gap is
//! reported, what touched it ends, and what cannot be restored is an error. Another board in its place is reported as
//! another.

mod dressed;
mod ended;
mod links;
mod lost;
mod other;
mod plugged;
mod posing;
mod restored;
pub mod rig;
