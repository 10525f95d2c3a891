//! The health of every taxel, found while the garment is used.
//!
//! In every frame a group of 23 taxels begins to be watched, for 11 frames: lowest and highest code of each,
//! and the distance that its code has travelled. Then the group is judged. So each of 2,048 taxels is judged
//! once in 90 frames, and a new fault is found within 100. A finding stays, though the taxel may recover
//! (except a dead and a shorted one, see below), until the garment is changed or a
//! [`SelfTest`](crate::wire::Request::SelfTest) is requested. Then every taxel counts as good again, with the
//! gain it had before, until a fault is found anew. `Start` only restarts the watch.
//!
//! | class | evidence |
//! |---|---|
//! | dead | it stays at rest while the taxels around it are pressed, to a distance of two taxels |
//! | stuck | its code does not even show noise, while its neighbours' do |
//! | open | no signal: below its code at rest, or dead there |
//! | shorted | full scale, and nothing beside it is pressed |
//! | noisy | its code goes back and forth further than a touch takes it, and its neighbours' do not |
//!
//! What presses around a single taxel may be a ring: a cup, a hollow finger. A ring whose hole is one taxel
//! and whose wall is three or more cannot be distinguished from an object that covers a dead taxel. So a dead
//! taxel is cleared when it later responds to pressure. A needle that fills a single taxel cannot be
//! distinguished from a short circuit. So a shorted taxel is cleared when it later rests.
//!
//! Where the codes are too quiet (noise under 1.8 counts rms, or codes of 8 bits), no taxel is called stuck.
//! A pressed taxel is called noisy only if its noise is over a fifth of its signal: a moving object changes
//! how the cloth lies.
//!
//! | | |
//! |---|---|
//! | input | [`Code`](crate::format::Code) by taxel number, codes at rest |
//! | output | at most [`FAULTY_TAXELS`] faulty taxels |
//! | RAM | [`Monitor`]: 2,812 bytes |

mod codes;
mod inputs;
mod judge;
mod monitor;
mod seen;
mod taxel;
mod walk;
mod watch;

pub use codes::Codes;
pub use monitor::{FAULTY_TAXELS, FaultyTaxel, FoundFaults, Monitor};
pub use taxel::TaxelHealth;
