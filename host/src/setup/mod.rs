//! `taxel setup`: an unknown bundle of wires to a right garment file, by touch.
//!
//! Known is how the garment is meant to be: its panels and blocks, which pins drive address lines, which
//! read. Not known is what each of these wires is. While the garment is set up, the board wears a
//! [`Bundle`]'s probe, which reads every address of every input. A [`Feeler`] finds touches in the raw codes;
//! a [`Solver`] asks for them and makes a garment of what it gets:
//!
//! - a stroke down each column of blocks, off its middle: lines of the rows and of the blocks, order and
//!   direction of the blocks, the input they are read by, and the side on which column 0 is;
//! - one stroke across one panel: lines of the columns;
//! - a press on the first corner of each panel: nothing new, but the proof.
//!
//! The reference garment takes nine touches. Each stroke is read by itself, all must agree, and what they
//! give together must show each touch where it was asked for; else the touch is asked for again, three times
//! at most, and then the answer is "not sure".

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
pub use reading::{Blocks, Felt, Reading};
pub use solver::{Found, Next, Solver};
pub use touch::{Moment, Touch, Trace};
pub use user::User;
