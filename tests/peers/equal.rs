//! The core and imageproc find the same contacts with the same sums: what `cargo xtask peers` times is the
//! same work. The check compares with what imageproc found, in `tests/reference/contacts.json`; TAXEL_BLESS=1
//! updates it.

use proptest::prelude::*;
use taxel_peers::ours::Sums;
use taxel_peers::{chains, scenes};

const FOUND: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../reference/contacts.json");

#[test]
fn the_reference_is_what_imageproc_finds() {
    let found: Vec<Vec<Sums>> = scenes::panels().iter().map(|values| chains::found(values).1).collect();
    let lines: Vec<String> = found.iter().map(|panel| serde_json::to_string(panel).unwrap()).collect();
    let text = format!("[\n{}\n]\n", lines.join(",\n"));
    if std::env::var_os("TAXEL_BLESS").is_some() {
        std::fs::write(FOUND, &text).unwrap();
    }
    let kept = std::fs::read_to_string(FOUND).unwrap();
    assert!(kept == text, "{FOUND} is not what TAXEL_BLESS=1 writes");
    println!("{} panels of the reference: imageproc finds the same", found.len());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]
    #[test]
    fn on_any_panel(values in proptest::collection::vec(prop_oneof![3 => Just(0), 4 => 0u8..40, 5 => any::<u8>()], 2048)) {
        let (ours, theirs) = chains::found(&values);
        // The core keeps the 64 greatest.
        prop_assume!(theirs.len() <= 64);
        prop_assert_eq!(ours, theirs);
    }
}
