//! Boards of other versions: what they say in common is understood, and another protocol is named.

use taxel::client::{Client, Event};
use taxel_core::format::{Celsius, Micros};
use taxel_core::wire::{MAGIC, REPORTS, Report, Temperature, encode};

/// All events of messages, each a number and its body.
fn events(messages: &[(u32, &[u8])]) -> Vec<Event> {
    let mut client = Client::new();
    let mut events = Vec::new();
    for (seq, (number, body)) in messages.iter().enumerate() {
        // Tuples and fixed arrays are written without a length.
        let message: Vec<u8> = [&postcard::to_allocvec(&(seq as u32, number)).unwrap()[..], body].concat();
        let mut wire = vec![0; 200];
        let frame = encode(&Plain(&message), &mut wire).unwrap();
        events.extend(frame.iter().filter_map(|byte| client.push(*byte)));
    }
    assert_eq!(client.counts().messages, messages.len() as u64);
    events
}

/// Bytes as they are.
struct Plain<'a>(&'a [u8]);

impl serde::Serialize for Plain<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeTuple;
        let mut bytes = serializer.serialize_tuple(self.0.len())?;
        self.0.iter().try_for_each(|byte| bytes.serialize_element(byte))?;
        bytes.end()
    }
}

fn hello(protocol: u16) -> Vec<u8> {
    let mut body = MAGIC.to_vec();
    body.extend(postcard::to_allocvec(&protocol).unwrap());
    body
}

#[test]
fn another_protocol_is_named_with_what_to_do() {
    let cases = [
        (
            1,
            "the board speaks protocol 1, this program 2: flash the firmware of this version (`taxel flash`)",
        ),
        (3, "the board speaks protocol 3, this program 2: update this program"),
    ];
    for (protocol, sentence) in cases {
        let later = [&hello(protocol)[..], b"and then something else"].concat();
        for body in [&hello(protocol), &later] {
            let reported = events(&[(Report::HELLO, body)]);
            assert!(matches!(&reported[..], [Event::Unusable(why)] if why == sentence), "{reported:?}");
        }
    }
}

#[test]
fn messages_and_fields_of_a_later_version_are_passed_over() {
    let temperature = Temperature { time: Micros(7), celsius: Celsius(2_500) };
    let mut later = postcard::to_allocvec(&temperature).unwrap();
    later.extend([1, 2, 3]);
    let reported = events(&[
        (REPORTS.len() as u32, &[1, 2, 3]),
        (Report::TEMPERATURE, &later),
        (1_000_000, b"of whichever length, and whatever it holds"),
    ]);
    assert!(matches!(&reported[..], [Event::Temperature(read)] if *read == temperature), "{reported:?}");
}
