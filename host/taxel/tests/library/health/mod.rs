//! Faulty taxels, lines and inputs on the simulated board: each is found and classified, and no healthy one
//! is.

mod broken;
mod classes;
mod healthy;
mod lines;
mod rings;
mod said;
mod scripts;
mod watched;

fn is_campaign() -> bool {
    std::env::var_os("TAXEL_CAMPAIGN").is_some()
}
