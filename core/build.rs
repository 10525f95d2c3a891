//! Generates the look-up tables of the core. Floats are used here, on the build machine, and not on the
//! board.

use std::fmt::Write as _;
use std::{env, fs, path::Path};

/// Intervals of the table of tanh over [0, 8], 1/64 wide; the table has one point more. Negative arguments
/// follow from oddness, the logistic function over [-16, 16] from sigmoid(u) = (1 + tanh(u / 2)) / 2.
const STEPS: u32 = 512;

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let out = env::var_os("OUT_DIR").expect("cargo sets OUT_DIR");
    fs::write(Path::new(&out).join("tanh.rs"), tanh_table()).expect("OUT_DIR can be written");
}

/// Returns the source of an array literal: tanh(k / 64) in Q23.
///
/// A chord lies on the inner side of its curve, at most h^2 f'' / 8 away. Each point is moved outwards by
/// half of that: the error of linear interpolation is halved and has both signs. f'' = -2 tanh (1 - tanh^2).
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
