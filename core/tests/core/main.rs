//! The core by itself: exact references, golden bytes, hard images, properties. `cargo test -p taxel-core`
//! runs this alone.

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
mod moments;
mod outputs;
mod plain;
mod random;
mod reflex;
mod shape;
mod sweep;
mod taught;
mod told;
mod tracking;
mod wire;
