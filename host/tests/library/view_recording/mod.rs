//! A recording in the page of `taxel view`: every moment of it is that of the board, from wherever it is gone
//! to.

mod moments;
mod pages;
mod saved;
mod stage;
