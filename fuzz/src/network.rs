//! Bytes from the network, before they reach a viewer's client or a board: all readers of them that need no
//! network themselves.

use crate::bytes::Bytes;
use std::collections::VecDeque;
use std::time::{Duration, Instant};
use taxel::network::{
    AskedFrame, BoardPlace, FrameCutter, PieceKind, PieceOrder, PieceStamp, WirePiece, words,
};
use taxel_core::wire::{Request, encode};

/// Most bytes that wait on the two ways, with a frame that comes when one is all but full.
const WAITING: usize = 2 * ((1 << 20) + (1 << 15));

/// Reads the bytes as what the first of them chooses.
pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    match bytes.byte() % 5 {
        0 => follow(&mut bytes),
        1 => cut(bytes.rest()),
        2 => ask(bytes.rest()),
        3 => name(&String::from_utf8_lossy(bytes.rest())),
        _ => {
            let words = words(bytes.rest());
            assert!(words.chars().count() <= 200 && !words.chars().any(char::is_control), "{words:?}");
        }
    }
}

/// Samples of any attachment and payload, in any order, at any time: a viewer's client gets frames in the order in
/// which they were published.
fn follow(bytes: &mut Bytes<'_>) {
    let (mut order, mut now) = (PieceOrder::new(0), Instant::now());
    let (mut stamp, mut got) = (PieceStamp { publisher: 0, main: 0, images: 0 }, VecDeque::new());
    while !bytes.is_empty() {
        let kind = if bytes.byte().is_multiple_of(2) { PieceKind::Main } else { PieceKind::Image };
        match bytes.byte() % 8 {
            0 => stamp.main = stamp.main.wrapping_add(1 << (bytes.byte() % 64)),
            1 => stamp.images = stamp.images.wrapping_sub(1 << (bytes.byte() % 64)),
            2 => now += Duration::from_micros(bytes.short().into()),
            3 => _ = WirePiece::read(kind, bytes.piece(), bytes.piece()),
            4 => sample(&mut order, now, kind, stamp, bytes.piece()),
            5 => sample(&mut order, now, kind, stamp, &vec![7; bytes.short().into()]),
            6 => got.extend(order.next(now).map(|piece| (piece.kind, piece.stamp))),
            _ => {
                let below_end = |number: u64| number.min(u64::MAX - 1);
                let (main, images) = (below_end(stamp.main), below_end(stamp.images));
                stamp = PieceStamp { main, images, ..stamp }.next(kind);
                let piece = if kind == PieceKind::Main { [2, 1, 0].as_slice() } else { &[3, 7, 1, 0] };
                sample(&mut order, now, kind, stamp, piece);
            }
        }
        assert!(order.bytes() <= WAITING, "{} bytes wait", order.bytes());
    }
    now += Duration::from_secs(1);
    got.extend(std::iter::from_fn(|| order.next(now)).map(|piece| (piece.kind, piece.stamp)));
    in_order(&got);
}

/// A sample comes; the network waits while there is no room.
fn sample(order: &mut PieceOrder, now: Instant, kind: PieceKind, stamp: PieceStamp, payload: &[u8]) {
    let Ok(piece) = WirePiece::read(kind, &stamp.to_bytes(), payload) else { return };
    assert_eq!((piece.stamp, piece.kind), (stamp, kind));
    one_piece(kind, &piece.bytes);
    if kind == PieceKind::Image || !order.is_full() {
        _ = order.push(now, piece);
    }
}

/// Each way has its own order, and no image comes behind what was published after it.
fn in_order(got: &VecDeque<(PieceKind, PieceStamp)>) {
    let (mut main, mut images) = (0, 0);
    for (kind, stamp) in got {
        match kind {
            PieceKind::Main => assert!(stamp.main > main, "{stamp:?} behind {main}"),
            PieceKind::Image => assert!(stamp.images > images, "{stamp:?} behind {images}"),
        }
        (main, images) = (main.max(stamp.main), images.max(stamp.images));
    }
}

/// Reads a piece that a program which offers a board publishes as one sample.
fn one_piece(kind: PieceKind, bytes: &[u8]) {
    let mut pieces = Vec::new();
    FrameCutter::default().push(bytes, |kind, piece| pieces.push((kind, piece.to_vec())));
    assert_eq!(pieces, [(kind, bytes.to_vec())]);
}

/// Any bytes of a board: all are passed on, and each piece is read by a viewer.
fn cut(bytes: &[u8]) {
    let (mut cutter, mut all) = (FrameCutter::default(), Vec::new());
    let stamp = PieceStamp { publisher: 1, main: 1, images: 1 };
    for part in bytes.chunks(7) {
        cutter.push(part, |kind, piece| {
            let read = WirePiece::read(kind, &stamp.to_bytes(), piece);
            assert_eq!(read.map(|read| read.bytes), Ok(piece.to_vec()));
            all.extend_from_slice(piece);
        });
    }
    assert!(bytes.starts_with(&all), "no byte is changed");
    assert!(bytes.len() - all.len() < 16 << 10, "nothing endless waits");
}

/// A request of anybody: what is handed over is one that can be sent again.
fn ask(frame: &[u8]) {
    let mut asked = AskedFrame::default();
    let Ok(request) = asked.read(frame) else { return };
    let mut room = vec![0; 2 * frame.len() + 64];
    let again = encode(&request, &mut room).expect("it has room").to_vec();
    let mut asked = AskedFrame::default();
    assert_eq!(asked.read(&again), Ok::<Request<'_>, String>(request));
}

/// Names and keys.
fn name(text: &str) {
    if let Some(id) = BoardPlace::publisher(text) {
        assert!(text.ends_with(&format!("/{id:016x}")), "{text}");
    }
    let Ok(place) = text.parse::<BoardPlace>() else { return };
    assert_eq!(place.to_string(), text);
    let key = place.alive(7);
    assert_eq!((key.split('/').count(), BoardPlace::publisher(&key)), (5, Some(7)));
    assert!(!key.contains(['*', '$', '#', '?', ' ']), "{key}");
}
