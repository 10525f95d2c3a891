//! A recording in the page of `taxel view`: every moment equals that of the board, after any jump.

mod moments;
mod pages;
mod retained;
mod saved;
mod stage;
