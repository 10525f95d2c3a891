//! Events of contacts: every onset and release is reported, however many there are in a frame.

use std::collections::BTreeMap;
use taxel_core::acquire::{Scan, ScanReport};
use taxel_core::board::{BoardInfo, Input, Shipped};
use taxel_core::capacity::TAXELS;
use taxel_core::condition::Filter;
use taxel_core::contact::Phase;
use taxel_core::format::{Code, Micros};
use taxel_core::garment::Garment;
use taxel_core::pipeline::CONTACTS;
use taxel_core::scene::Scene;
use taxel_core::wire::{self, Receiver, Report, Request};

/// A mat, whose taxels show what is drawn at once.
struct MatAndHost {
    board: Box<Shipped>,
    receiver: Box<Receiver<8192>>,
    now: u64,
}

/// Phases of the events that were reported of each contact.
type ReportedPhases = BTreeMap<u32, Vec<Phase>>;

impl MatAndHost {
    fn new() -> MatAndHost {
        let mut scene = Scene::shipped();
        scene.condition.filter = Filter::Off;
        // cm: a touch two taxels away is another one.
        scene.contact.gate = 1;
        scene.react.clear();
        let board = Shipped::new(BoardInfo::feather("test 1.0"), Garment::mat(), scene).unwrap();
        let mut bench = MatAndHost { board: Box::new(board), receiver: Box::default(), now: 0 };
        for request in [Request::Start, Request::Tare { frames: 1 }] {
            let mut frame = [0; 64];
            let frame = wire::encode(&request, &mut frame).unwrap();
            bench.board.step(Micros(0), Input::Received(frame), &mut ());
        }
        bench.scan(None);
        bench
    }

    /// Scans as many single taxels as there is room for contacts, the first of them at column `first`.
    fn scan(&mut self, first: Option<usize>) {
        self.now += 5_000;
        let is_dot = |taxel: usize| {
            let (row, column) = (taxel / 32, taxel % 32);
            first.is_some_and(|first| row % 16 == 0 && column % 4 == first)
        };
        let codes: Vec<Code> = (0..TAXELS).map(|taxel| Code(if is_dot(taxel) { 900 } else { 0 })).collect();
        let report =
            ScanReport { start: Micros(self.now), duration_us: 4_000, overruns: 0, temperature: None };
        let scan = Scan { codes: &codes, report };
        self.board.step(Micros(self.now), Input::Scanned(Ok(scan)), &mut ());
    }

    /// Reads all that is pending.
    fn read(&mut self, reported: &mut ReportedPhases) {
        loop {
            let bytes = self.board.pending(Micros(self.now), &mut ()).to_vec();
            if bytes.is_empty() {
                return;
            }
            self.board.sent(bytes.len());
            for byte in bytes {
                let Some(frame) = self.receiver.push(byte) else { continue };
                let (_, report): (u32, Report) = wire::decode(frame.unwrap()).unwrap();
                let Report::Symbols(list) = report else { continue };
                for event in list.events {
                    reported.entry(event.contact).or_default().push(event.phase);
                }
            }
        }
    }
}

#[test]
fn in_a_frame_all_contacts_end_and_as_many_begin() {
    let (mut bench, mut reported) = (MatAndHost::new(), ReportedPhases::new());
    for first in [0, 2, 0, 2] {
        bench.scan(Some(first));
        bench.read(&mut reported);
    }
    for _ in 0..2 {
        bench.scan(None);
        bench.read(&mut reported);
    }
    assert_eq!((reported.len(), bench.board.health().lost), (4 * CONTACTS, 0));
    for (contact, phases) in reported {
        assert_eq!(phases, [Phase::Onset, Phase::Released], "{contact}");
    }
}
