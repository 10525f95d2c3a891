//! The host side of taxel.
#![forbid(unsafe_code)]

// First: what follows uses its macros.
#[macro_use]
mod told;

pub mod arrays;
pub mod bench;
pub mod calibrate;
pub mod cli;
pub mod client;
pub mod clock;
pub mod config;
pub mod date;
pub mod doctor;
pub mod doubts;
pub mod export;
pub mod fault;
pub mod fcm;
pub mod features;
pub mod flash;
#[cfg(feature = "foxglove")]
pub mod foxglove;
pub mod garments;
pub mod gestures;
pub mod growths;
pub mod health;
pub mod info;
pub mod intent;
pub mod json;
pub mod learn;
pub mod live;
pub mod output;
mod passed;
pub mod ports;
pub mod process;
pub mod progress;
pub mod raw;
pub mod record;
pub mod recording;
pub mod repair;
pub mod replay;
pub mod report;
pub mod reset_settings;
pub mod save;
pub mod scenes;
pub mod serve;
pub mod session;
pub mod settle;
pub mod setup;
pub mod shapes;
mod shared;
pub mod sim;
pub mod source;
mod starts;
pub mod stop;
pub mod toml_key;
pub mod touches;
pub mod verbose;
pub mod view;
pub mod words;
