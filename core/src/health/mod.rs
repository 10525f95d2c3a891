//! The health of every taxel, found while the garment is used.
//!
//! 256 taxels are watched at a time, over [`FRAMES`] frames: lowest and highest code of each, and how far its code has
//! travelled. Then each is judged, and it is the next ones' turn: each of 2,048 is judged once in 96 frames. What is found
//! stays, though the taxel may recover, until the garment is changed or a [`SelfTest`](crate::wire::Request::SelfTest) is asked
//! for: then every taxel counts as good again, with the gain of its good days, until it is found anew. `Start` only begins the
//! watch anew.
//!
//! | class | what shows it |
//! |---|---|
//! | dead | it rests while what surrounds it is pressed |
//! | stuck | its code does not even show noise, while its neighbours' do |
//! | open | no signal: below what it showed at rest, or dead there |
//! | shorted | full scale, and nothing beside it is pressed |
//! | noisy | its code goes to and fro, many times further than it gets |
//!
//! Where the codes are too quiet to tell (noise under 2.6 counts rms, or codes of 8 bits), nothing is called stuck.
//!
//! | | |
//! |---|---|
//! | input | [`Code`](crate::format::Code) by taxel number, codes at rest |
//! | output | at most [`ILL`] ill taxels |
//! | RAM | 2.9 KB |

mod judge;
mod monitor;
mod seen;
mod taxel;

pub use monitor::{Codes, FRAMES, Found, ILL, IllTaxel, Monitor};
pub use taxel::TaxelHealth;
