//! `taxel setup`: identifies a bundle of unknown wires by touch, and writes a garment file.
//!
//! The intended garment is known: its panels and blocks, and which pins drive address lines or read. Unknown
//! is the role of each wire. During setup the board has the probe garment of a [`Bundle`], which reads every
//! address of every input. A [`Feeler`] finds touches in the raw codes; a [`Solver`] asks for touches and
//! builds the garment from them:
//!
//! - a stroke down each column of blocks, off its middle, gives the lines of the rows and of the blocks, the
//!   order and direction of the blocks, their input, and the side of column 0;
//! - one stroke across one panel gives the lines of the columns;
//! - a press on the first corner of each panel confirms the result.
//!
//! The reference garment takes nine touches. Each stroke is read by itself, and all must agree. The resulting
//! garment must show each touch at the requested place; else the touch is asked for again, up to three times,
//! and then the answer is "not sure".

mod ask;
mod assemble;
mod bundle;
mod check;
mod command;
mod feel;
mod reading;
mod solver;
mod touch;
mod user;

pub use ask::{Ask, Gesture};
pub use bundle::Bundle;
pub use command::{SetupArgs, run};
pub use feel::Feeler;
pub use reading::{Blocks, Reading, StrokedBlock};
pub use solver::{Found, Next, Solver};
pub use touch::{Touch, TouchFrame, Trace};
pub use user::User;
