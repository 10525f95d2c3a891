//! `taxel --version`.

use crate::start::taxel;
use std::process::Command;

#[test]
fn the_program_says_its_version() {
    let output = Command::new(taxel()).arg("--version").output().unwrap();
    assert!(output.status.success());
    let want = format!("taxel {}\n", env!("CARGO_PKG_VERSION"));
    assert_eq!(String::from_utf8(output.stdout).unwrap(), want);
}
