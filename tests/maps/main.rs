//! Cognitive maps as files: what they say, what is found wrong with them, how experts' maps combine, why a map decides as it does.

mod check;
mod files;
