//! What a board may say that no board of ours says: none of it may end a program, fill its memory, or reach a
//! terminal.

mod control;
mod hello;
mod released;
mod stage;
mod terminal;
mod times;
