//! From touch to motion: the reference robot, moved by its velocities and nothing else.

mod clamped;
mod cost;
mod faults;
mod files;
mod jacobian;
mod kinds;
mod led;
mod retreat;
mod rig;
mod sequences;
