//! Maps that are written by questions, and explained from a board's reports.

mod ask;
mod told;
