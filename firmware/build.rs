//! Copies the memory maps to where the linker looks for them, and names the linker scripts.

use std::{env, fs, path::PathBuf};

/// The images and their memory maps. A memory.x in the folder where the linker runs would silently take
/// precedence, so there is none beside this file.
const MAPS: [(&str, &str); 2] = [("taxel-firmware", "../memory.x"), ("bench", "src/bin/bench.x")];

fn main() {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    for (image, map) in MAPS {
        let place = out.join(image);
        fs::create_dir_all(&place).expect("make a folder in OUT_DIR");
        fs::copy(map, place.join("memory.x")).unwrap_or_else(|error| panic!("copy {map}: {error}"));
        println!("cargo:rustc-link-arg-bin={image}=-L{}", place.display());
        println!("cargo:rerun-if-changed={map}");
    }
    for script in ["link.x", "link-rp.x", "defmt.x"] {
        println!("cargo:rustc-link-arg-bins=-T{script}");
    }
    println!("cargo:rustc-link-arg-bins=--nmagic");
    // The first function that runs is that of src/levels.rs, which calls the original one.
    println!("cargo:rustc-link-arg-bin=taxel-firmware=--wrap=__pre_init");
    // defmt drops messages below the level set at compile time; its default is errors only.
    println!("cargo:rustc-env=DEFMT_LOG=info");
}
