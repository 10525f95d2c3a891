//! Cognitive maps as files: what they say, what is found wrong with them, how experts' maps combine, why a
//! map decides as it does, what it learns, how it is drawn and asked for.

mod ask;
mod check;
mod draw;
mod files;
mod hardness;
mod large;
mod learn;
mod told;
mod unite;
mod why;
