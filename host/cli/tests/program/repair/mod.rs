//! Damaged recordings: readable data is never lost, and no input is changed.

mod damaged;
mod foreign;
mod made;
mod program;
