//! The chain on this machine: its output, its cost, and its contacts.

use super::case::Step;
use std::time::Instant;
use taxel_core::body::Placed;
use taxel_core::pipeline::{Probe, Stage};
use taxel_core::wire::{Checksum, Receiver, Report, decode};
use taxel_suite::chain::{Chain, Said};
use taxel_suite::kernel::Bench;

/// Number of stages, as in the marks.
pub const STAGES: usize = Stage::Scan as usize;

/// Upper limit of a frame from the board.
const LONGEST: usize = 8192;

/// A board on this machine.
pub struct Twin {
    chain: Box<Chain>,
    bench: Box<Bench>,
    receiver: Box<Receiver<LONGEST>>,
}

/// Result of a step.
#[derive(Debug, Clone, Default)]
pub struct StepResult {
    /// Output.
    pub said: Said,
    /// Nanoseconds by stage.
    pub spent: [u64; STAGES],
    /// Contacts, if there was a list.
    pub contacts: Vec<Placed>,
    /// Contacts dropped.
    pub dropped: u16,
}

/// Sums the time of each stage.
#[derive(Debug, Default)]
struct Watch {
    spent: [u64; STAGES],
    under_way: Option<(usize, Instant)>,
}

impl Checksum for Watch {}

impl Probe for Watch {
    fn begin(&mut self, stage: Stage) {
        let now = Instant::now();
        if let Some((stage, since)) = self.under_way.replace((stage as usize, now))
            && let Some(spent) = self.spent.get_mut(stage)
        {
            *spent += (now - since).as_nanos() as u64;
        }
    }
}

impl Default for Twin {
    fn default() -> Twin {
        let mut chain = Box::new(Chain::bare());
        chain.ship().expect("what ships fits");
        Twin { chain, bench: Box::new(Bench::default()), receiver: Box::new(Receiver::new()) }
    }
}

impl Twin {
    /// Performs a step.
    pub fn perform(&mut self, step: &Step) -> StepResult {
        let (mut results, mut watch, mut sent) = (StepResult::default(), Watch::default(), Vec::new());
        results.said = match step {
            Step::Receive(bytes) => bytes.iter().fold(results.said, |_, byte| self.chain.receive(&[*byte])),
            Step::Scan(codes) => self.chain.scanned(codes, &mut watch, |bytes| sent.extend_from_slice(bytes)),
            Step::Fold(on) => {
                self.chain.fold(*on);
                Said::default()
            }
            Step::Kernel(kernel, codes) => {
                Said { bytes: 0, digest: kernel.run(&mut self.bench, codes, &mut watch) }
            }
        };
        results.spent = watch.spent;
        for byte in sent {
            let Some(body) = self.receiver.push(byte) else { continue };
            let (_, report) = decode::<(u32, Report<'_>)>(body.expect("a whole frame")).expect("a message");
            if let Report::Contacts(list) = report {
                results.contacts = list.contacts.iter().cloned().collect();
                results.dropped = list.dropped;
            }
        }
        results
    }
}
