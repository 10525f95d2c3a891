//! Messages that no board of ours sends: none of them may end a program, fill its memory, or control a
//! terminal.

mod control;
mod hello;
mod released;
mod stage;
mod terminal;
mod times;
