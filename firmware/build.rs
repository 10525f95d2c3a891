//! Puts the memory map where the linker looks for it and names the linker scripts.

use std::{env, fs, path::PathBuf};

fn main() {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    // One map for all boards, in the repository's root. A memory.x in the folder where the linker runs would silently
    // win over this one: that is why it does not lie beside this file.
    fs::copy("../memory.x", out.join("memory.x")).expect("copy ../memory.x");
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rerun-if-changed=../memory.x");
    for script in ["link.x", "link-rp.x", "defmt.x"] {
        println!("cargo:rustc-link-arg-bins=-T{script}");
    }
    println!("cargo:rustc-link-arg-bins=--nmagic");
    // defmt drops what is below the level that is set at compile time; its default is errors only.
    println!("cargo:rustc-env=DEFMT_LOG=info");
}
