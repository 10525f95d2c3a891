//! Files of cognitive maps: contents, checks, combination of experts' maps, explanations, learning, drawing.

mod check;
mod draw;
mod files;
mod hardness;
mod large;
mod learn;
mod unite;
mod why;
