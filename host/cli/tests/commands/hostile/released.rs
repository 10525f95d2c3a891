//! A board that releases contacts and never sends an image.

use super::stage::{events, frame, hello};
use taxel::client::Client;
use taxel_core::body::Placed;
use taxel_core::contact::Phase;
use taxel_core::format::Micros;
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;
use taxel_core::wire::{ContactList, Report};

/// A contact without any values.
fn at_rest() -> Placed {
    postcard::take_from_bytes(&[0; 512]).unwrap().0
}

#[test]
fn what_has_gone_is_kept_in_bounded_memory() {
    let mut client = Client::new();
    events(&mut client, &hello(0, &Garment::reference(), &Scene::shipped(), "taxel"));
    let mut id = 0;
    for number in 1..2000 {
        let gone = std::iter::repeat_with(|| {
            id += 1;
            let mut placed = at_rest();
            (placed.contact.id, placed.contact.phase) = (id, Phase::Released);
            placed
        });
        let contacts = gone.take(20).collect();
        let list = ContactList { frame: number, time: Micros(5), contacts, ..ContactList::default() };
        events(&mut client, &frame(number, &Report::Contacts(list)));
    }
    let kept = client.released();
    assert!(kept.len() <= 1024, "{} ids are kept", kept.len());
    assert_eq!(kept.last(), Some(&id), "those that went last are known");
}
