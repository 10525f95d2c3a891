//! The tables and charts in docs/evidence/bench equal the program's output. TAXEL_BLESS=1 updates them.

use std::path::Path;
use taxel_bench::{Report, acquisition, amplifier, nmi};

/// Compares a table and its chart with the files, or writes them.
fn check(name: &str, report: &Report) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/evidence/bench");
    for (ending, want) in [("txt", report.text.clone()), ("svg", report.chart.svg())] {
        let file = folder.join(name).with_extension(ending);
        if std::env::var_os("TAXEL_BLESS").is_some() {
            std::fs::create_dir_all(&folder).expect("it can be made");
            std::fs::write(&file, &want).expect("it can be written");
        }
        let have = std::fs::read_to_string(&file).expect("it is checked in");
        for (have, want) in have.lines().zip(want.lines()) {
            assert_eq!(have, want, "{}", file.display());
        }
        assert_eq!(have.len(), want.len(), "{}", file.display());
    }
}

#[test]
fn acquisition_is_as_checked_in() {
    check("acquisition", &acquisition::report());
}

#[test]
fn amplifier_is_as_checked_in() {
    check("amplifier", &amplifier::report());
}

#[test]
fn nmi_is_as_checked_in() {
    check("nmi", &nmi::report().expect("every touch is found"));
}
