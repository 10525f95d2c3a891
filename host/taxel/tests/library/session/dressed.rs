//! A garment that is set while something touches the board.

use super::restored::{garment, until};
use super::rig::{Rig, source};
use std::sync::{Arc, Mutex};
use taxel::client::Event;
use taxel::session::{Returns, Session};
use taxel_core::format::Code;
use taxel_core::wire::Request;

#[test]
fn a_contact_ends_with_its_garment_even_if_the_next_one_is_the_same() {
    let rig = Arc::new(Mutex::new(Rig::with_garment(garment())));
    let mut session = Session::new(source(&rig), Returns::Always);
    session.parts().0.start(8).unwrap();
    let tare = Request::Tare { frames: 8 }.number();
    until(&mut session, |event| matches!(event, Event::Answer { request, .. } if *request == tare));
    [17, 18, 33, 34].iter().for_each(|taxel| rig.lock().unwrap().codes[*taxel] = Code(2_000));
    let touched = |event: &Event| matches!(event, Event::Contacts { .. });
    until(&mut session, touched);
    let (client, _) = session.parts();
    let [touch] = client.contacts() else { panic!("{:?}", client.contacts()) };
    let id = touch.contact.id;
    client.request(&Request::SetGarment(&postcard::to_allocvec(&garment()).unwrap())).unwrap();
    until(
        &mut session,
        |event| matches!(event, Event::Contacts { released, .. } if released.iter().any(|end| end.contact.id == id)),
    );
    assert!(session.client().contacts().iter().all(|placed| placed.contact.id != id));
    // It is felt anew.
    until(&mut session, touched);
    assert!(session.client().contacts().iter().all(|placed| placed.contact.id > id));
}
