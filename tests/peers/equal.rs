//! The core and imageproc find the same contacts with the same sums: what `cargo xtask peers` times is the
//! same work.

use proptest::prelude::*;
use taxel_core::format::Code;
use taxel_peers::{chains, scenes};

#[test]
fn the_same_contacts_with_the_same_sums() {
    for scene in scenes::all() {
        let (ours, theirs) = chains::found(&scene.values);
        assert_eq!(ours, theirs, "{}", scene.name);
        assert_eq!(ours.len(), scene.contacts, "{}", scene.name);
        let codes: Vec<Code> = scene.values.iter().map(|value| Code(u16::from(*value))).collect();
        assert_eq!(chains::Ours::default().follow(&codes), scene.contacts, "{}", scene.name);
    }
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
