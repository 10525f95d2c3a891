//! A board that restarts, is unplugged, or loses its connection: all settings are restored, the gap is
//! reported, and what cannot be restored is an error.

mod links;
mod lost;
mod plugged;
mod posing;
mod restored;
pub mod rig;
