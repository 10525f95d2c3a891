//! A base of shapes is exchanged while something touches: no class is reported under the names of another base.

use crate::board::{BoardAndHost, FINGER};
use taxel_core::scene::Scene;
use taxel_core::shape::{Class, ConfidenceTable, Exemplar, GalleryHead, Space};
use taxel_core::wire::{Report, Request};

/// Classes of the contacts in lists that come after the base was reported, and the last frame of them.
fn reported(bench: &mut BoardAndHost) -> Vec<(u32, Class)> {
    let (mut exchanged, mut classes) = (false, Vec::new());
    bench.drain(usize::MAX, |report| match report {
        Report::Shapes(_) => exchanged = true,
        Report::Contacts(list) if exchanged => {
            classes.extend(list.contacts.iter().map(|placed| (list.frame, placed.shape.class)));
        }
        _ => {}
    });
    assert!(exchanged, "the base was not reported");
    classes
}

#[test]
fn a_class_of_one_base_is_never_reported_as_one_of_another() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.ask(&Request::Start);
    bench.ask(&Request::Tare { frames: 1 });
    bench.scan();
    bench.drain(usize::MAX, |_| ());

    let names = ["cube", "ball"].into_iter().map(taxel_core::format::name).collect();
    let space = Space { origin: [0; 24], weights: core::iter::once([0; 24]).collect(), shift: 0 };
    let head = GalleryHead {
        names,
        space,
        k: 1,
        reject: 100,
        confidence: ConfidenceTable::default(),
        prototypes: 1,
    };
    let head = postcard::to_allocvec(&head).unwrap();
    let prototypes = postcard::to_allocvec(&vec![Exemplar { class: 1, at: [0; 12] }]).unwrap();

    // The list that reports the onset is still to be sent when the base arrives: it was made with the one
    // before.
    bench.press(&FINGER, 900);
    bench.scan();
    bench.ask(&Request::SetShapes(&head));
    bench.ask(&Request::AddShapes(&prototypes));
    let classes = reported(&mut bench);
    assert!(!classes.is_empty() && classes.iter().all(|(_, class)| *class == Class::UNKNOWN), "{classes:?}");
    (0..8).for_each(|_| bench.scan());
    bench.ask(&Request::Start);
    assert!(reported(&mut bench).iter().all(|(_, class)| *class == Class(2)));

    // Another head arrives: from here on the built-in base is in force again, and this is reported.
    bench.press(&FINGER, 0);
    bench.press(&[44, 45, 60, 61], 900);
    bench.scan();
    bench.ask(&Request::SetShapes(&head));
    let classes = reported(&mut bench);
    assert!(!classes.is_empty() && classes.iter().all(|(_, class)| *class == Class::UNKNOWN), "{classes:?}");
}
