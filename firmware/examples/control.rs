//! The control of `no_panic.rs`: one panic is reachable, and it must not link.
#![no_std]
#![no_main]

mod handler;

/// Code of a taxel that may not exist.
#[unsafe(no_mangle)]
pub extern "C" fn _start(codes: &&[u16], taxel: usize) -> u16 {
    codes[taxel]
}
