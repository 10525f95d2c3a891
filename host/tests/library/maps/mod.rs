//! Files of cognitive maps: contents, checks, combination of experts' maps, explanations, learning, drawing,
//! and creation by questions.

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
