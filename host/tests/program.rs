//! The program from outside. For a test of this kind cargo builds it along with all others, so that those of `taxel-tests`
//! that run it find it there.

use std::process::Command;

#[test]
fn the_program_says_its_version() {
    let output = Command::new(env!("CARGO_BIN_EXE_taxel")).arg("--version").output().unwrap();
    assert!(output.status.success());
    let want = format!("taxel {}\n", env!("CARGO_PKG_VERSION"));
    assert_eq!(String::from_utf8(output.stdout).unwrap(), want);
}
