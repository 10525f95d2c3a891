//! The simulated board: scripted touches on a garment, read through simulated pins, multiplexers and a
//! converter.
//!
//! A [`Script`] lists touches with place, time and force. [`World`] computes the code of a taxel at a time, a
//! pure function of both as long as the wiring is ideal. [`SimBoard`] adds pins, a delay, a converter and a
//! clock of virtual time, so that the core's portable scan reads it like a real board. [`Player`] reads the
//! same codes without pins, for benchmarks and campaigns. Nothing here sleeps.
//!
//! | quantity | unit |
//! |---|---|
//! | time of the board | ns inside, us at [`SimClock`] |
//! | position | taxels of a panel, x the column, y the row |
//! | force of a contact, share of a taxel | N |
//! | signal of a taxel | counts, [`COUNTS_PER_NEWTON`] per newton on the taxel, linear up to [`FULL_SCALE`] |
#![forbid(unsafe_code)]

mod decode;
mod error;
mod flash;
mod noise;
mod rewire;
mod touch;

mod footprint;
mod trace;

mod act;
mod script;
mod sneak;
mod wiring;

mod contact;
mod parse;
mod scenes;

mod pressure;

mod signal;
mod tool;
mod variants;

mod chain;
mod codes;
mod drift;
mod pads;

mod hardware;

mod hand;

mod board;

mod scan;

pub use board::{NoSuchInput, SimAdc, SimBoard};
pub use chain::Chain;
pub use codes::{FRAME_PERIOD_US, Player, frame_codes, wiring_json};
pub use contact::Contact;
pub use decode::{Address, Decoder};
pub use drift::{Course, Drifting, Patch};
pub use error::ScriptError;
pub use flash::{Cut, FlashError, SimFlash};
pub use footprint::Footprint;
pub use hand::SimHand;
pub use hardware::{PINS, SimClock, SimDelay, SimPin, Timing};
pub use pressure::Pressure;
pub use rewire::rewire;
pub use scan::SimScan;
pub use scenes::{SceneInfo, list, names, shipped, text};
pub use script::{Converter, Faults, Idle, Joint, Noisy, Script, Sensor, Stuck, WiringEffects, posture};
pub use signal::{COUNTS_PER_NEWTON, FULL_SCALE, World};
pub use tool::{TOOLS, Tool};
pub use touch::{Shape, Size, Touch};
pub use trace::{Knot, Trace};
pub use variants::{lacking, largest, refit, scale_force, scale_rate, vary};
