//! Checks by linking `firmware/examples/no_panic.rs`, and `control.rs` beside it, that no panic is reachable from
//! the core on the microcontroller.

use crate::cross::Toolchain;
use crate::end::End;
use crate::{paths, process};
use std::path::Path;
use std::process::Command;

/// The linker's message if a panic is reachable.
const REACHABLE: &str = "undefined symbol: a_panic_is_reachable";

/// The example must link; the control, in which a panic is reachable, must not, for this reason and no other.
pub fn check(log: &Path) -> End {
    Ok(by(&Toolchain::find()?, log))
}

/// Checks with one compiler.
pub fn by(toolchain: &Toolchain, log: &Path) -> Result<(), String> {
    if process::run_into(&mut example(toolchain, "no_panic"), log).is_err() {
        let text = std::fs::read_to_string(log).unwrap_or_default();
        let why = if text.contains(REACHABLE) { "a panic is reachable" } else { "it cannot be built" };
        return Err(why.into());
    }
    let control = log.with_extension("control.log");
    let _ = std::fs::remove_file(&control);
    let linked = process::run_into(&mut example(toolchain, "control"), &control).is_ok();
    let text = std::fs::read_to_string(&control).unwrap_or_default();
    match (linked, text.contains(REACHABLE)) {
        (true, _) => Err("the control, in which a panic is reachable, links, too".into()),
        (false, false) => Err(format!("the control fails for another reason: {}", control.display())),
        (false, true) => Ok(()),
    }
}

/// The command that links an example.
fn example(toolchain: &Toolchain, name: &str) -> Command {
    let mut cargo = toolchain.cargo("build", &paths::firmware());
    cargo.args(["--locked", "--example", name]);
    cargo
}
