//! The core by itself: exact references, golden bytes, hard images, properties. `cargo test -p taxel-core`
//! runs this alone; with `TAXEL_CAMPAIGN=1`, longer.

mod baseline;
mod board;
mod bounds;
mod certainty;
mod condition;
mod dense;
mod events;
mod exchange;
mod garment;
mod golden;
mod hard;
mod interlaced;
mod late_host;
mod moments;
mod outputs;
mod owners;
mod peers;
mod plain;
mod random;
mod reflex;
mod shape;
mod sweep;
mod taught;
mod tracking;
mod wire;

/// True if the tests are to take as long as they like.
fn is_campaign() -> bool {
    std::env::var_os("TAXEL_CAMPAIGN").is_some()
}
