//! Options of the linker for WebAssembly: boards are built on the stack, and nobody reads the names of functions.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    if std::env::var("CARGO_CFG_TARGET_FAMILY").as_deref() == Ok("wasm") {
        println!("cargo:rustc-link-arg-cdylib=-zstack-size=8388608");
        println!("cargo:rustc-link-arg-cdylib=--strip-all");
    }
}
