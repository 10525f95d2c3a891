//! Maps that are explained from a board's reports.

mod reported;
