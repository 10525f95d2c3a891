//! The link under every kind of fault: delivered messages equal the sent ones, lost ones are counted exactly,
//! and those untouched by faults arrive. `cargo xtask campaign --only link` sends ten million messages
//! through each.

use fastrand::Rng;
use taxel::client::{Client, Event};
use taxel_core::format::Micros;
use taxel_core::wire::{RegionNames, Report, SyncReport, encode};

/// Messages per batch.
const BATCH: usize = 64;
/// One in this many batches has no fault.
const SPARED: usize = 8;

/// A fault of the bytes on a link.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fault {
    Bit,
    Byte,
    Lost,
    Zeroed,
    Inserted,
    Swapped,
    Repeated,
    Noise,
    Cut,
}

const FAULTS: [Fault; 9] = [
    Fault::Bit,
    Fault::Byte,
    Fault::Lost,
    Fault::Zeroed,
    Fault::Inserted,
    Fault::Swapped,
    Fault::Repeated,
    Fault::Noise,
    Fault::Cut,
];

impl Fault {
    /// Most bytes that it affects.
    fn reach(self, random: &mut Rng) -> usize {
        match self {
            Fault::Bit | Fault::Byte | Fault::Zeroed | Fault::Inserted => 1,
            Fault::Swapped => 2,
            Fault::Lost | Fault::Repeated => random.usize(1..8),
            Fault::Noise | Fault::Cut => random.usize(1..200),
        }
    }

    /// Applies the fault to some bytes.
    fn on(self, bytes: &[u8], random: &mut Rng) -> Vec<u8> {
        let mut bytes = bytes.to_vec();
        match self {
            Fault::Bit => bytes[0] ^= 1 << random.u8(..8),
            Fault::Byte => bytes[0] = random.u8(..),
            Fault::Zeroed => bytes[0] = 0,
            Fault::Inserted => bytes.insert(0, random.u8(..)),
            Fault::Swapped => bytes.reverse(),
            Fault::Repeated => bytes.extend(bytes.clone()),
            Fault::Noise => bytes.iter_mut().for_each(|byte| *byte = random.u8(..)),
            Fault::Lost | Fault::Cut => bytes.clear(),
        }
        bytes
    }
}

/// The message with this number, which determines its contents.
fn message(seq: u32) -> SyncReport {
    let mixed = u64::from(seq).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let received = Micros(mixed >> 8);
    SyncReport { token: (mixed >> 32) as u32, received, sent: Micros(mixed >> (mixed & 15)) }
}

/// Counts of messages.
#[derive(Debug, Default)]
struct Outcome {
    sent: u64,
    delivered: u64,
    lost: u64,
    /// Messages affected by a fault.
    touched: u64,
}

/// A link with one kind of fault.
struct Link {
    fault: Fault,
    client: Client,
    random: Rng,
    seq: u32,
    outcome: Outcome,
    last: Option<u32>,
}

impl Link {
    fn new(fault: Fault, seed: u64) -> Link {
        let (client, random) = (Client::new(), Rng::with_seed(seed));
        Link { fault, client, random, seq: 0, outcome: Outcome::default(), last: None }
    }

    /// Sends a batch. Its first and last messages are spared, so that all losses are between two that arrive.
    fn batch(&mut self, spared: bool) {
        let first = self.seq;
        let (mut wire, mut ends) = (Vec::new(), Vec::new());
        for _ in 0..BATCH {
            let mut room = [0; 64];
            wire.extend_from_slice(encode(&(self.seq, Report::Sync(message(self.seq))), &mut room).unwrap());
            ends.push(wire.len());
            self.seq += 1;
        }
        let mut touched = [false; BATCH];
        if !spared {
            self.harm(&mut wire, &ends, &mut touched);
        }
        let mut arrived = [false; BATCH];
        for byte in wire {
            if let Some(Event::Sync(report)) = self.client.push(byte) {
                let reported = (first..self.seq).find(|seq| message(*seq) == report);
                let seq = reported.unwrap_or_else(|| panic!("{:?}: {report:?} was never sent", self.fault));
                assert!(
                    self.last.is_none_or(|last| last < seq),
                    "{:?}: {seq} after {:?}",
                    self.fault,
                    self.last
                );
                self.last = Some(seq);
                arrived[(seq - first) as usize] = true;
            }
        }
        for (at, (arrived, touched)) in arrived.iter().zip(touched).enumerate() {
            let seq = first + at as u32;
            assert!(
                *arrived || touched,
                "{:?}: nothing has touched message {seq}, and it is lost",
                self.fault
            );
            self.outcome.delivered += u64::from(*arrived);
            self.outcome.touched += u64::from(touched);
        }
        self.outcome.sent += BATCH as u64;
    }

    /// Applies faults to the bytes, from the last to the first.
    fn harm(&mut self, wire: &mut Vec<u8>, ends: &[usize], touched: &mut [bool; BATCH]) {
        let mut to = ends[BATCH - 2];
        loop {
            let reach = self.fault.reach(&mut self.random);
            let gap = self.random.usize(..300);
            let Some(from) = to.checked_sub(reach + gap).filter(|from| *from >= ends[0]) else { break };
            let range = from..from + reach;
            for (at, end) in ends.iter().enumerate() {
                let begin = at.checked_sub(1).map_or(0, |before| ends[before]);
                // The delimiter before a message belongs to it: without it, two messages become one.
                touched[at] |= range.start < *end && range.end > begin.saturating_sub(1);
            }
            let harmed = self.fault.on(&wire[range.clone()], &mut self.random);
            wire.splice(range, harmed);
            to = from;
        }
    }
}

#[test]
fn nothing_wrong_is_delivered_and_every_loss_is_counted() {
    let messages = if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 10_000_000 } else { 20_000 };
    println!(
        "{:<10}{:>12}{:>12}{:>12}{:>12}{:>12}",
        "fault", "sent", "touched", "delivered", "lost", "counted"
    );
    for (seed, fault) in (7..).zip(FAULTS) {
        let mut link = Link::new(fault, seed);
        for batch in 0..messages / BATCH {
            link.batch(batch % SPARED == 0);
        }
        link.batch(true);
        let (sent, delivered) = (link.outcome.sent, link.outcome.delivered);
        let counted = link.client.counts().lost;
        link.outcome.lost = sent - delivered;
        assert_eq!(counted, link.outcome.lost, "{fault:?}");
        assert_eq!(link.client.counts().restarts, 0, "{fault:?}");
        assert!(link.outcome.lost > 0 && link.outcome.lost <= link.outcome.touched, "{:?}", link.outcome);
        let fault = format!("{fault:?}").to_lowercase();
        println!(
            "{fault:<10}{sent:>12}{:>12}{delivered:>12}{:>12}{counted:>12}",
            link.outcome.touched, link.outcome.lost
        );
    }
}

#[test]
fn messages_that_belong_to_the_next_one_are_there_with_it() {
    let sync = |token| Report::Sync(SyncReport { token, received: Micros(1), sent: Micros(2) });
    let names = || Report::RegionNames(RegionNames { names: Default::default() });
    let reports = [sync(1), names(), names(), sync(2), sync(3)];
    let (mut client, mut reported) = (Client::new(), Vec::new());
    let mut frames = Vec::new();
    for (seq, report) in reports.iter().enumerate() {
        let frame = encode(&(seq as u32, report), &mut [0; 64]).unwrap().to_vec();
        for byte in &frame {
            if client.push(*byte).is_some() {
                reported.push(client.lines().collect::<Vec<_>>().concat());
            }
        }
        frames.push(frame);
    }
    assert_eq!(reported, [frames[0].clone(), frames[1..4].concat(), frames[4].clone()]);
}
