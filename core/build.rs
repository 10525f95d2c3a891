//! Generates the look-up tables of the core. Floats live here, on the machine that builds, and not on the
//! board.

use std::fmt::Write as _;
use std::{env, fs, path::Path};

/// tanh over [0, 8]: 512 steps of 1/64 and the last point. The other half follows from oddness, and the
/// logistic function from tanh: sigmoid(u) = (1 + tanh(u / 2)) / 2, over [-16, 16].
const STEPS: u32 = 512;

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let out = env::var_os("OUT_DIR").expect("cargo sets OUT_DIR");
    fs::write(Path::new(&out).join("tanh.rs"), tanh_table()).expect("OUT_DIR can be written");
}

/// The source of an array literal: tanh(k / 64) in Q23.
///
/// A chord of a curve lies on its inner side, by at most h^2 f'' / 8. Each point is moved outwards by half of
/// that, so that the error of linear interpolation is halved and has both signs. f'' = -2 tanh (1 - tanh^2).
fn tanh_table() -> String {
    let mut text = String::from("[\n");
    for k in 0..=STEPS {
        let h = 8.0 / f64::from(STEPS);
        let exact = (h * f64::from(k)).tanh();
        let moved = exact + h * h / 8.0 * exact * (1.0 - exact * exact);
        writeln!(text, "    {},", (moved * 8_388_608.0).round() as u32).expect("a String takes any text");
    }
    text.push(']');
    text
}
