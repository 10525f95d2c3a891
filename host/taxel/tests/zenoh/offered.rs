//! What a board sends arrives unchanged, in its order, and only where somebody listens.

use crate::stage::{Network, Offered, place, state, wait_for};
use std::sync::mpsc;
use std::time::Duration;
use taxel::client::{Event, ImageNews};
use taxel::error::ErrorKind;
use taxel::network::{FrameCutter, PieceKind, PieceStamp};
use taxel::session::Poll;
use taxel_core::format::Code;
use zenoh::Wait;

/// Frames of these bytes.
fn frames(bytes: &[u8]) -> Vec<(PieceKind, Vec<u8>)> {
    let (mut cutter, mut all) = (FrameCutter::default(), Vec::new());
    cutter.push(bytes, |kind, frame| {
        let frame = frame.iter().copied().skip_while(|byte| *byte == 0);
        all.push((kind, frame.collect()));
    });
    all
}

#[test]
fn a_board_arrives_unchanged_and_losses_are_counted_exactly() {
    let network = Network::new();
    let offered = Offered::begin(&network);
    let mut viewers = [network.view(), network.view()];
    let mut received = [Vec::new(), Vec::new()];
    for turn in 0..600_usize {
        if turn % 60 == 0 {
            offered.rig.lock().unwrap().codes = [Code(if turn % 120 == 0 { 900 } else { 100 }); 64];
        }
        for (viewer, received) in viewers.iter_mut().zip(&mut received) {
            while let Poll::Event(_) = viewer.poll().unwrap() {
                viewer.client().lines().for_each(|line| received.extend_from_slice(line));
            }
        }
    }
    let sent = frames(&offered.sent.lock().unwrap());
    for (viewer, received) in viewers.iter().zip(&received) {
        let got = frames(received);
        let counts = viewer.client().counts();
        assert!(got.len() > 500, "{} frames", got.len());
        let first = sent.iter().position(|frame| *frame == got[0]).unwrap();
        let last = sent.iter().rposition(|frame| *frame == got[got.len() - 1]).unwrap();
        // Each is one that was sent, in that order; what is missing is an image, and counted.
        let mut among = sent[first..=last].iter();
        let mut missing = 0;
        for frame in &got {
            let skipped = among.by_ref().take_while(|sent| *sent != frame);
            missing += skipped.inspect(|(kind, _)| assert_eq!(*kind, PieceKind::Image)).count() as u64;
        }
        assert_eq!(among.next(), None);
        assert_eq!((counts.lost, counts.refused(), counts.restarts), (missing, 0, 0));
        assert!(missing * 20 < got.len() as u64, "{missing} images are missing beside {}", got.len());
    }
}

#[test]
fn images_leave_the_machine_only_if_somebody_listens() {
    let network = Network::new();
    let _offered = Offered::begin(&network);
    let other = network.other();
    let (sender, reported) = mpsc::channel();
    let of_main = sender.clone();
    let listen = |key: String, sender: mpsc::Sender<PieceStamp>| {
        let heard = other.declare_subscriber(key).callback(move |sample| {
            let stamp = sample.attachment().map(|bytes| bytes.to_bytes().into_owned());
            let _ = sender.send(PieceStamp::from_bytes(&stamp.unwrap()).unwrap());
        });
        heard.wait().unwrap()
    };
    let _main = listen(place().main(), of_main);
    for _ in 0..50 {
        assert_eq!(reported.recv_timeout(Duration::from_secs(10)).unwrap().images, 0);
    }
    let _images = listen(place().images(), sender);
    let begun = std::iter::from_fn(|| reported.recv_timeout(Duration::from_secs(10)).ok()).take(500);
    assert!(begun.into_iter().any(|stamp| stamp.images > 10), "no images come");
}

#[test]
fn state_and_health_are_there_for_other_programs() {
    let network = Network::new();
    let _offered = Offered::begin(&network);
    let mut viewer = network.view();
    wait_for(&mut viewer, "an image", |event| matches!(event, Event::Frame { image: ImageNews::Whole, .. }));
    let other = network.other();
    let state = state(&other);
    assert_eq!(
        (&state["robot"], &state["board"], &state["live"]),
        (&"arm".into(), &"left".into(), &true.into())
    );
    assert_eq!((&state["taxels"], &state["firmware"]), (&64.into(), &"test".into()));
    let health = other.declare_subscriber(place().health()).wait().unwrap();
    let reported = health.recv_timeout(Duration::from_secs(10)).unwrap().unwrap();
    let reported: serde_json::Value = serde_json::from_slice(&reported.payload().to_bytes()).unwrap();
    assert_eq!((&reported["type"], &reported["lost"]), (&"health".into(), &0.into()));
}

#[test]
fn times_stay_within_their_bounds_across_the_network() {
    let network = Network::new();
    let offered = Offered::begin(&network);
    let mut viewer = network.view();
    let mut answers = 0;
    wait_for(&mut viewer, "five answers to Sync", |event| {
        answers += usize::from(matches!(event, Event::Sync(_)));
        answers == 20
    });
    let client = viewer.client();
    let reported = client.host_time(client.board_time().unwrap()).unwrap();
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap().as_micros() as u64;
    assert!(
        reported.us <= now + reported.uncertainty_us && reported.uncertainty_us < 50_000,
        "{reported:?} at {now}"
    );
    drop(offered);
    let Err(error) = network.source() else { panic!("nobody offers it") };
    assert!(matches!(error.kind(), ErrorKind::Source(_)), "{error}");
}
