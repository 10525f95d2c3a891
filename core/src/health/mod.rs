//! The health of every taxel, found while the garment is used.
//!
//! In every frame 23 taxels begin to be watched, over 11 frames: lowest and highest code of each, and how far
//! its code has travelled. Then they are judged: each of 2,048 once in 90 frames, and what befalls it within
//! 100. What is found stays, though the taxel may recover (but see below for a dead and a shorted one), until
//! the garment is changed or a [`SelfTest`](crate::wire::Request::SelfTest) is asked for: then every taxel
//! counts as good again, with the gain of its good days, until it is found anew. `Start` only begins the
//! watch anew.
//!
//! | class | what shows it |
//! |---|---|
//! | dead | it rests while what surrounds it is pressed, to a distance of two taxels |
//! | stuck | its code does not even show noise, while its neighbours' do |
//! | open | no signal: below what it showed at rest, or dead there |
//! | shorted | full scale, and nothing beside it is pressed |
//! | noisy | its code goes to and fro, further than a touch of that size takes it, and those beside it do not |
//!
//! What is pressed around one taxel alone may be a ring: a cup, a hollow finger. A ring whose hole is one
//! taxel and whose wall is three or more cannot be told from what covers a dead taxel. So a dead taxel that
//! answers to pressure later is taken back. A needle that fills one taxel alone cannot be told from a short
//! circuit. So a shorted taxel that rests later is taken back.
//!
//! Where the codes are too quiet to tell (noise under 1.8 counts rms, or codes of 8 bits), nothing is called
//! stuck. A pressed taxel is called noisy only where its noise is over a fifth of its signal: how a cloth
//! lies changes under what moves.
//!
//! | | |
//! |---|---|
//! | input | [`Code`](crate::format::Code) by taxel number, codes at rest |
//! | output | at most [`ILL`] ill taxels |
//! | RAM | 2.9 KB |

mod inputs;
mod judge;
mod monitor;
mod seen;
mod taxel;
mod walk;
mod watch;

pub use monitor::{Codes, Found, ILL, IllTaxel, Monitor};
pub use taxel::TaxelHealth;
