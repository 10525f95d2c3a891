//! Commands about a board itself.

pub mod doctor;
pub mod flash;
pub mod health;
pub mod ports;
pub mod reset_settings;
pub mod save;
