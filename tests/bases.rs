//! Bases of shapes as files: whatever is in them, they are read or refused with one sentence, and what is read recognises.

use proptest::prelude::*;
use taxel::shapes::base::{Base, SHIPPED_NAMES};
use taxel_core::shape::{Descriptor, MEASURES};

fn shipped() -> Vec<Base> {
    SHIPPED_NAMES.iter().map(|name| Base::open(name.as_ref()).expect("it ships")).collect()
}

#[test]
fn what_ships_knows_its_own_prototypes() {
    for base in shipped() {
        assert_eq!(Base::parse(&base.text().unwrap()).unwrap(), base);
        let gallery = &base.gallery;
        assert!(gallery.prototypes.len() <= 200 && gallery.names.len() > 1);
        let classes = 0..gallery.names.len();
        assert!(
            classes.clone().all(|class| gallery.prototypes.iter().any(|p| usize::from(p.class) == class))
        );
        let right: u32 = classes.map(|class| base.card.confusion[class][class]).sum();
        let all: u32 = base.card.confusion.iter().flatten().sum();
        assert!((f64::from(right) / f64::from(all) - base.card.accuracy).abs() < 1e-9);
    }
}

#[test]
fn what_is_wrong_is_said_in_one_sentence() {
    let text = shipped()[0].text().unwrap();
    let refused = |from: &str, to: &str, why: &str| {
        let error = format!("{:#}", Base::parse(&text.replacen(from, to, 1)).unwrap_err());
        assert!(error.contains(why) && !error.contains('\n'), "{error}");
    };
    refused("taxel shapes 1", "taxel shapes 9", "expected \"taxel shapes 1\"");
    refused("nmi_s2", "nmi_s3", "other measures");
    refused("\"k\":3", "\"k\":0", "shapes.k");
    refused("\"weights\":[", "\"weights\":[[],", "no base of shapes");
    refused("\"reject\":", "\"reject\":-", "no base of shapes");
    refused("\"prototypes\":[{\"class\":0", "\"prototypes\":[{\"class\":31", "shapes.names");
    for length in [0, 1, 100, text.len() / 2, text.len() - 3] {
        let error = format!("{:#}", Base::parse(&text[..length]).unwrap_err());
        assert!(error.starts_with("is no base of shapes"), "{error}");
    }
    let many = "{\"class\":0,\"at\":[0,0,0,0,0,0,0,0,0,0,0,0]},".repeat(201);
    refused("\"prototypes\":[", &format!("\"prototypes\":[{many}"), "at most 200");
}

proptest! {
    #[test]
    fn a_changed_byte_is_refused_or_harmless(at in 0usize..20_000, byte in 0u8..128, seed in any::<i16>()) {
        for base in shipped() {
            let mut bytes = base.text().unwrap().into_bytes();
            let at = at % bytes.len();
            bytes[at] = byte;
            let Ok(base) = Base::parse(&String::from_utf8_lossy(&bytes)) else { continue };
            let descriptor: Descriptor = std::array::from_fn(|i| seed.wrapping_mul(i as i16 * 77 + 1));
            let found = base.gallery.recognise(&descriptor);
            prop_assert!(found.class.is_none_or(|class| usize::from(class) < base.gallery.names.len()));
        }
    }

    #[test]
    fn any_descriptor_has_an_answer(values in prop::array::uniform24(any::<i16>())) {
        let descriptor: [i16; MEASURES] = values;
        for base in shipped() {
            let found = base.gallery.recognise(&descriptor);
            prop_assert!((0..=32_768).contains(&found.confidence.0) && (0..=32_768).contains(&found.share.0));
        }
    }
}
