//! Files of shape bases: any content is either read or refused with one sentence, and a base that was read
//! recognises shapes.

use proptest::prelude::*;
use taxel::files::bases::{Base, shipped_names};
use taxel::learn::confusion::Confusion;
use taxel_core::board::{Board, BoardInfo, Input};
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Pins};
use taxel_core::scene::Scene;
use taxel_core::shape::{Descriptor, Exemplar, GalleryHead, MEASURES};
use taxel_core::wire::{Receiver, Report, Request, decode, encode};

fn shipped() -> Vec<Base> {
    shipped_names().map(|name| Base::open(name.as_ref()).expect("it ships")).collect()
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
fn the_cards_are_in_the_docs() {
    let docs = concat!(
        include_str!("../../../../docs/guides/shapes.md"),
        include_str!("../../../../docs/evidence/shapes.md")
    );
    for (name, base) in shipped_names().zip(shipped()) {
        let (confusion, names) = (base.card.confusion.clone(), base.names());
        let confusion = Confusion { counts: confusion, ..Confusion::new(&names, &names) };
        let table: String = confusion.table().lines().map(|line| format!("  {line}\n")).collect();
        let card = format!("\n`{name}`:\n\n```text\n{table}```\n");
        assert!(docs.contains(&card), "docs/evidence/shapes.md does not hold:{card}");
        let accuracy = format!("{:.1} %", 100.0 * base.card.accuracy);
        let row = docs.lines().find(|line| line.starts_with(&format!("| `{name}` |"))).unwrap();
        assert!(row.contains(&accuracy), "{row}: {accuracy}");
    }
}

#[test]
fn a_grid_has_a_base_of_its_own() {
    let best = |classes: &[&str], grid| {
        let classes: Vec<String> = classes.iter().map(ToString::to_string).collect();
        Base::shipped_for(&classes, grid).map(|(name, _)| name)
    };
    assert_eq!(best(&["disc", "finger"], Some((16, 16))).unwrap(), "drawn-16x16");
    assert_eq!(best(&["disc", "finger"], Some((28, 50))).unwrap(), "drawn");
    assert_eq!(best(&["disc", "finger"], None).unwrap(), "drawn");
    assert_eq!(best(&["finger", "ball"], Some((16, 16))).unwrap(), "objects");
    assert!(best(&["cloud"], Some((16, 16))).unwrap_err().to_string().contains("classes cloud"));
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
    refused("\"weights\":[", "\"weights\":[[],", "not a base of shapes");
    refused("\"reject\":", "\"reject\":-", "not a base of shapes");
    refused("\"prototypes\":[{\"class\":0", "\"prototypes\":[{\"class\":31", "shapes.names");
    for length in [0, 1, 100, text.len() / 2, text.len() - 3] {
        let error = format!("{:#}", Base::parse(&text[..length]).unwrap_err());
        assert!(error.starts_with("is not a base of shapes"), "{error}");
    }
    let many = "{\"class\":0,\"at\":[0,0,0,0,0,0,0,0,0,0,0,0]},".repeat(201);
    refused("\"prototypes\":[", &format!("\"prototypes\":[{many}"), "at most 200");
}

#[test]
fn a_bad_base_is_refused_by_the_board_in_one_sentence() {
    let info =
        BoardInfo { firmware: "", chip: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 1_000_000 };
    let mut board = Box::new(Board::<64, 32>::new(info, Garment::block(), Scene::shipped()).unwrap());
    let mut ask = |request: &Request<'_>| {
        let mut wire = [0; 4096];
        let frame = encode(request, &mut wire).unwrap().to_vec();
        board.step(Micros(0), Input::Received(&frame), &mut ());
        let (mut refusal, mut receiver) = (None, Box::new(Receiver::<8192>::new()));
        while let [byte, ..] = board.pending(Micros(0), &mut ()) {
            if let Some(body) = receiver.push(*byte)
                && let (_, Report::Answer(answer)) = decode::<(u32, Report<'_>)>(body.unwrap()).unwrap()
            {
                refusal = answer.refusal.map(String::from);
            }
            board.sent(1);
        }
        refusal
    };
    let gallery = shipped().remove(0).gallery;
    let head = |prototypes: u16, k: u8, reject: u16| {
        let (names, space, confidence) =
            (gallery.names.clone(), gallery.space.clone(), gallery.confidence.clone());
        postcard::to_allocvec(&GalleryHead { names, space, k, reject, confidence, prototypes }).unwrap()
    };
    let examples = |count: usize, class: u8| {
        let one = Exemplar { class, ..gallery.prototypes[0] };
        postcard::to_allocvec(&vec![one; count]).unwrap()
    };
    let one = head(1, 3, 100);
    assert_eq!(
        ask(&Request::AddShapes(&examples(1, 0))).as_deref(),
        Some("shapes.prototypes must be as many as the gallery's head says")
    );
    for (begun, added, why) in [
        (&head(201, 3, 100), None, "shapes.prototypes must be 1 to 200 on this board"),
        (&one[..one.len() - 1].to_vec(), None, "shapes: these"),
        (&[&one[..], &[0]].concat(), None, "shapes: bytes after its end"),
        (&head(1, 0, 100), Some(examples(1, 0)), "shapes.k must be 1 to 9"),
        (&head(1, 3, 0), Some(examples(1, 0)), "shapes.reject must be at least 1"),
        (&one, Some(examples(1, 31)), "shapes.names must name the class of every prototype"),
        (&one, Some(examples(2, 0)), "shapes.prototypes must be as many as the gallery's head says"),
        (&one, Some(examples(65, 0)), "prototypes: these"),
        (&one, Some(examples(1, 0)[..5].to_vec()), "prototypes: these"),
    ] {
        let refusal = match (ask(&Request::SetShapes(begun)), added) {
            (None, Some(added)) => ask(&Request::AddShapes(&added)),
            (refusal, None) => refusal,
            (refusal, Some(_)) => panic!("refused already: {refusal:?}"),
        };
        assert!(refusal.as_deref().is_some_and(|it| it.starts_with(why)), "{refusal:?}, expected {why}");
    }
    assert_eq!((ask(&Request::SetShapes(&one)), ask(&Request::AddShapes(&examples(1, 0)))), (None, None));
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
