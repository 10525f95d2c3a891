//! Fuzzy cognitive maps as files: run, check, explain, combine, learn and draw.

pub mod aggregate;
pub mod board;
pub mod check;
pub mod combine;
pub mod config;
pub mod decimal;
pub mod draw;
pub mod engine;
pub mod json;
pub mod layers;
pub mod learn;
pub mod load;
pub mod map;
pub mod member;
pub mod paths;
pub mod scene;
pub mod search;
pub mod steps;
pub mod sweep;
pub mod terms;
pub mod told;
pub mod touches;
pub mod unite;
pub mod weight;
pub mod why;
pub mod wrong;
