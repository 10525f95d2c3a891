//! Two programs that offer one board.

use crate::stage::{Network, Offered, place, wait_for, wait_for_words};
use taxel::client::Event;
use taxel::error::{ErrorKind, UsageError};
use taxel::network::{self, NetworkEnd, PieceStamp};
use taxel::offer::BoardOffer;
use zenoh::Wait;

#[test]
fn the_second_is_refused_at_its_start() {
    let network = Network::new();
    let _offered = Offered::begin(&network);
    let mut viewer = network.view();
    wait_for(&mut viewer, "a Hello", |event| *event == Event::Hello);
    let session = network::open(NetworkEnd::Offer, Some(&network.client)).unwrap();
    let Err(error) = BoardOffer::open(&session, &place()) else { panic!("it is offered twice") };
    assert!(matches!(error.kind(), ErrorKind::Usage(UsageError::Argument(_))));
    assert!(error.to_string().starts_with("arm/left is offered by another program ("), "{error}");
    assert!(BoardOffer::open(&session, &"arm/right".parse().unwrap()).is_ok());
}

#[test]
fn a_viewer_stays_with_one_of_two_and_says_so() {
    let network = Network::new();
    let _offered = Offered::begin(&network);
    let mut viewer = network.view();
    wait_for(&mut viewer, "a Hello", |event| *event == Event::Hello);
    // As after a network that was in two parts: the other one has its own numbers.
    let other = network.other();
    let _token = other.liveliness().declare_token(place().alive(7)).wait().unwrap();
    let reported = wait_for_words(&mut viewer, "it is offered twice");
    assert!(reported.ends_with("and 0000000000000007 is not"), "{reported}");
    for main in 0..200 {
        let stamp = PieceStamp { publisher: 7, main, images: 0 };
        other
            .put(place().main(), [1, 2, 0].as_slice())
            .attachment(stamp.to_bytes().as_slice())
            .wait()
            .unwrap();
    }
    let mut images = 0;
    wait_for(&mut viewer, "images", |event| {
        images += usize::from(matches!(event, Event::Frame { .. }));
        images == 100
    });
    let counts = viewer.client().counts();
    assert_eq!((counts.refused(), counts.restarts), (0, 0));
}
