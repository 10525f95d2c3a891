//! A board that restarts, is unplugged, or whose connection breaks: everything is set again, the gap is told,
//! and what cannot be is an error.

mod links;
mod lost;
mod restored;
mod rig;
mod soak;
