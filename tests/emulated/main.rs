//! The firmware image in the emulator. `cargo xtask test` builds the image first and names it in
//! TAXEL_FIRMWARE_ELF.

mod board;
mod boots;
mod contacts;
#[path = "../../host/cli/tests/recorded/data.rs"]
mod data;
#[path = "../../host/taxel/tests/library/faults.rs"]
mod faults;
mod health;
mod images;
mod latency;
mod mishaps;
mod outputs;
mod recorded;
mod scan;
mod stack;
mod store;
mod surface;
mod twin;
mod usb;
