//! A robot of several boards: its file, boards that are lost and come back, and other boards in their place.

mod boards;
mod file;
mod losses;
mod newtons;
mod one_bus;
mod one_time;
mod orders;
mod posture;
mod recorded;
