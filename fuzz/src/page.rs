//! Bytes that a browser sends to the page's port: the head of a request, and what follows it on a WebSocket.

use crate::bytes::Bytes;
use std::sync::{Mutex, OnceLock};
use std::time::Duration;
use taxel::source::{self, Source, SourceOptions};
use taxel_cli::serve::http::{self, Sites};
use taxel_cli::view::{Mailbox, PageHand, PageHub, hear};

/// Orders that wait at most, as the hub says.
const ORDERS: usize = 64;
/// Baselines that wait at most.
const TARES: usize = 2;

/// Sends the bytes: all of them as they are, or pieces of them in frames behind a good request, as the first
/// byte says.
pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let mut sent = match bytes.byte() % 2 {
        0 => bytes.rest().to_vec(),
        _ => asked(&mut bytes),
    };
    // The head may end in any read.
    let split = usize::from(sent.first().copied().unwrap_or(0)).min(sent.len());
    let follows = sent.split_off(split);
    let mut stream = std::io::Read::chain(sent.as_slice(), follows.as_slice());
    match http::read(&mut stream, Sites::Own) {
        Some(Ok(request)) if request.key.is_some() => talk(stream, request),
        Some(Err(refusal)) => {
            let mut answer = Vec::new();
            http::refuse(&mut answer, refusal).expect("there is memory");
            assert!(answer.starts_with(b"HTTP/1.1 4"), "{refusal:?}");
        }
        _ => {}
    }
}

fn talk(stream: impl std::io::Read, request: http::Request) {
    let mut answer = Vec::new();
    http::upgrade(&mut answer, &request.key.unwrap_or_default(), None).expect("there is memory");
    let text = String::from_utf8(answer).expect("an answer is a text");
    assert_eq!(text.matches("\r\n\r\n").count(), 1, "a key adds no line of its own: {text:?}");
    let (hub, mailbox) = (PageHub::default(), Mailbox::default());
    hub.hand(PageHand::new(hand()));
    hear(stream, request.rest, &hub, &mailbox);
    assert!(std::iter::from_fn(|| hub.tare()).count() <= TARES);
    let orders = hub.orders(Duration::ZERO);
    assert!(hand().waiting() <= source::HAND_ORDERS, "orders of the hand");
    let touches = hub.touches().expect("there is a hand").expect("they are finite");
    assert!(!touches.contains("nan") && !touches.contains("inf"), "{touches}");
    assert!(orders.len() <= ORDERS && orders.iter().all(|order| order.is_sound()), "{orders:?}");
}

/// Presses a simulated board, which has not begun: it takes no order.
fn hand() -> source::Hand {
    static BOARD: OnceLock<Mutex<Source>> = OnceLock::new();
    let open = || source::open(&"sim:idle".parse().expect("it is a source"), &SourceOptions::default());
    let board = BOARD.get_or_init(|| Mutex::new(open().expect("it is simulated")));
    board.lock().expect("nothing panics").hand.clone().expect("it is simulated")
}

/// A request for the socket, and frames after it.
fn asked(bytes: &mut Bytes<'_>) -> Vec<u8> {
    let mut sent =
        b"GET /socket HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n\
        Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
            .to_vec();
    while !bytes.is_empty() {
        match bytes.byte() {
            0 => sent.extend_from_slice(bytes.piece()),
            1 => sent.extend(frame(0x81, bytes.piece())),
            head => sent.extend(frame(head, bytes.piece())),
        }
    }
    sent
}

/// A frame of a WebSocket as browsers send it: its payload is masked.
fn frame(head: u8, payload: &[u8]) -> Vec<u8> {
    const MASK: [u8; 4] = [0x1d, 0xa7, 0x02, 0xe6];
    let length = payload.len() as u16;
    let mut frame = vec![head];
    match length {
        0..126 => frame.push(0x80 | length as u8),
        _ => frame.extend([&[0xfe][..], &length.to_be_bytes()].concat()),
    }
    frame.extend(MASK);
    frame.extend(payload.iter().zip(MASK.iter().cycle()).map(|(byte, mask)| byte ^ mask));
    frame
}
