//! Boards between machines, over Zenoh: what is offered arrives unchanged, requests go back, losses are counted, and
//! what goes wrong is said.

mod errors;
mod hostile;
mod offered;
mod requests;
mod returns;
#[path = "../library/session/rig.rs"]
#[allow(dead_code)] // these tests take a part of it
mod rig;
mod rivals;
mod stage;
