//! When a decision is announced: what leads on the edge of two classes does not flicker.

use super::stage::Decision;
use crate::format::Micros;

/// What was announced of a touch, and what may follow it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Announced {
    class: Option<u8>,
    candidate: u8,
    since: Micros,
}

impl Default for Announced {
    fn default() -> Self {
        Self::new()
    }
}

impl Announced {
    /// Nothing yet.
    pub const fn new() -> Announced {
        Announced { class: None, candidate: u8::MAX, since: Micros(0) }
    }

    /// The class that was announced.
    pub const fn class(&self) -> Option<u8> {
        self.class
    }

    /// Takes a decision at `now`; the class, if it is announced with that. It must have led in all decisions for `onset_us`, and
    /// to take the place of another it must lead by at least `lead` (Q18) now.
    pub fn take(&mut self, decision: &Decision, now: Micros, onset_us: u64, lead: u32) -> Option<u8> {
        let class = decision.class as u8;
        if class != self.candidate {
            (self.candidate, self.since) = (class, now);
        }
        let new = self.class != Some(class);
        let clear = self.class.is_none() || decision.lead >= lead;
        if !(new && clear && now.since(self.since) >= onset_us) {
            return None;
        }
        self.class = Some(class);
        Some(class)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_class_must_lead_for_its_time_and_clearly_to_displace_another() {
        let mut announced = Announced::new();
        let mut take = |class: usize, lead: u32, ms: u64| {
            let decision = Decision { class, scores: [0; 8], lead };
            announced.take(&decision, Micros(1000 * ms), 200_000, 50)
        };
        assert_eq!((take(2, 1, 0), take(2, 1, 199), take(2, 1, 200)), (None, None, Some(2)));
        assert_eq!(take(2, 1, 900), None, "it is announced already");
        // To and fro within the time: nothing.
        for ms in (1000..3000).step_by(100) {
            assert_eq!(take(usize::from(ms % 200 == 0), 99, ms), None);
        }
        assert_eq!((take(4, 49, 3000), take(4, 49, 3300), take(4, 50, 3400)), (None, None, Some(4)));
    }
}
