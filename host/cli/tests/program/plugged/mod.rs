//! What is plugged in, and what commands make of it: boards, none, ports that hang, are busy or not permitted, and
//! strangers.

mod arrays;
mod shown;
pub mod stage;
mod stranger;
mod table;
