//! The same board on this machine, and the contacts that it told of.

use taxel::bench::case::Step;
use taxel_core::body::Placed;
use taxel_core::wire::{Receiver, Report, decode};
use taxel_suite::chain::{Chain, Said};

/// The longest frame that the board sends, and more.
const LONGEST: usize = 8192;

/// A board on this machine.
pub struct Twin {
    chain: Box<Chain>,
    receiver: Box<Receiver<LONGEST>>,
}

/// What it did in a step.
pub struct Told {
    /// What it said.
    pub said: Said,
    /// The contacts, if it told of any.
    pub contacts: Vec<Placed>,
    /// Contacts that it could not follow.
    pub dropped: u16,
}

impl Twin {
    /// As the image makes it.
    pub fn new() -> Twin {
        let setup = Chain::setup().expect("what ships fits");
        Twin { chain: Box::new(Chain::with(setup)), receiver: Box::new(Receiver::new()) }
    }

    /// Does a step.
    pub fn perform(&mut self, step: &Step) -> Told {
        let mut told = Told { said: Said::default(), contacts: Vec::new(), dropped: 0 };
        let mut sent = Vec::new();
        told.said = match step {
            Step::Receive(bytes) => bytes.iter().fold(told.said, |_, byte| self.chain.receive(&[*byte])),
            Step::Scan(codes) => self.chain.scanned(codes, &mut (), |bytes| sent.extend_from_slice(bytes)),
        };
        for byte in sent {
            let Some(body) = self.receiver.push(byte) else { continue };
            let (_, report) = decode::<(u32, Report<'_>)>(body.expect("a whole frame")).expect("a message");
            if let Report::Contacts(list) = report {
                told.contacts = list.contacts.iter().cloned().collect();
                told.dropped = list.dropped;
            }
        }
        told
    }
}
