//! Messages that a recording lacks, and why.

use super::served::{Happened, Sent};
use std::fmt;
use std::time::Duration;
use taxel_core::wire::{self, Report};

/// Time of messages in transit when a link broke or a board restarted: the last bytes of a reset connection
/// are not read.
const UNDER_WAY: Duration = Duration::from_millis(500);

/// Missing frames and contact lists.
#[derive(Debug, Default)]
pub struct Loss {
    sent: usize,
    damaged: usize,
    under_way: usize,
    /// Missing before the first one on a new link: the host waits for a `Hello`.
    before: usize,
    pub unexplained: usize,
}

/// Compares sent and recorded messages, both in order.
pub fn judge(happened: &[Happened], kept: &[Vec<u8>]) -> Loss {
    let mut loss = Loss::default();
    let mut kept = kept.iter().filter(|bytes| counts(bytes)).peekable();
    let mut has_met = false;
    for (index, event) in happened.iter().enumerate() {
        let sent = match event {
            Happened::Opened | Happened::Broken(_) => {
                has_met = false;
                continue;
            }
            Happened::Sent(sent) if counts(&sent.bytes) => sent,
            Happened::Sent(_) => continue,
        };
        loss.sent += 1;
        if kept.next_if(|bytes| **bytes == sent.bytes).is_some() {
            has_met = true;
        } else if sent.is_damaged {
            loss.damaged += 1;
        } else if breaks_soon(sent, &happened[index..]) {
            loss.under_way += 1;
        } else if !has_met {
            loss.before += 1;
        } else {
            loss.unexplained += 1;
        }
    }
    // Recorded but never sent messages would be worse.
    loss.unexplained += kept.count();
    loss
}

/// True for a frame or a list of contacts; other messages may be for the host alone.
fn counts(frame: &[u8]) -> bool {
    let mut bytes = frame.strip_suffix(&[0]).unwrap_or(frame).to_vec();
    let report = wire::open(&mut bytes).and_then(wire::decode::<(u32, Report<'_>)>);
    matches!(report, Ok((_, Report::Frame(_) | Report::Contacts(_))))
}

/// True if the link breaks soon after, or nothing more is sent.
fn breaks_soon(sent: &Sent, after: &[Happened]) -> bool {
    for event in after {
        match event {
            Happened::Broken(at) => return at.duration_since(sent.at) < UNDER_WAY,
            Happened::Opened => return true,
            Happened::Sent(next) if next.at.duration_since(sent.at) >= UNDER_WAY => return false,
            Happened::Sent(_) => {}
        }
    }
    true
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Loss { sent, damaged, under_way, before, unexplained } = self;
        write!(
            f,
            "of {sent} frames and contacts that were sent {damaged} were damaged, {under_way} under way when a link broke, {before} sent before the host knew the board; {unexplained} unexplained"
        )
    }
}
