//! Announcement of decisions: a debounce, so that a touch between two classes does not flicker.

use super::certainty::Certainty;
use super::stage::Decision;
use crate::format::Micros;

/// Conditions for the announcement of a decision.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Demand {
    /// Time for which the class must have led in all decisions, us.
    pub onset_us: u64,
    /// Lead that is needed to displace another class, Q18.
    pub lead: u32,
    /// Confidence that is needed.
    pub certainty: Certainty,
}

/// The announced class of a touch, and the candidate to follow it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Announced {
    class: Option<u8>,
    candidate: Option<u8>,
    since: Micros,
}

impl Default for Announced {
    fn default() -> Self {
        Self::new()
    }
}

impl Announced {
    /// State without an announcement.
    pub const fn new() -> Announced {
        Announced { class: None, candidate: None, since: Micros(0) }
    }

    /// The class that was announced.
    pub const fn class(&self) -> Option<u8> {
        self.class
    }

    /// Takes a decision at `now`. Returns the class if this decision is announced.
    pub fn take(&mut self, decision: &Decision, now: Micros, demand: &Demand) -> Option<u8> {
        let class = decision.class as u8;
        if self.candidate != Some(class) {
            (self.candidate, self.since) = (Some(class), now);
        }
        let new = self.class != Some(class);
        let clear = self.class.is_none() || decision.lead >= demand.lead;
        let certain = demand.certainty.allows(decision.confidence);
        if !(new && clear && certain && now.since(self.since) >= demand.onset_us) {
            return None;
        }
        self.class = Some(class);
        Some(class)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::Q15;

    #[test]
    fn a_class_must_lead_for_its_time_and_clearly_to_displace_another() {
        let mut announced = Announced::new();
        let mut take = |class: usize, lead: u32, ms: u64| {
            let decision = Decision { class, scores: [0; 8], lead, confidence: None };
            let demand = Demand { onset_us: 200_000, lead: 50, certainty: Certainty::default() };
            announced.take(&decision, Micros(1000 * ms), &demand)
        };
        assert_eq!((take(2, 1, 0), take(2, 1, 199), take(2, 1, 200)), (None, None, Some(2)));
        assert_eq!(take(2, 1, 900), None, "it is announced already");
        // A change back and forth within the onset time is not announced.
        for ms in (1000..3000).step_by(100) {
            assert_eq!(take(usize::from(ms % 200 == 0), 99, ms), None);
        }
        assert_eq!((take(4, 49, 3000), take(4, 49, 3300), take(4, 50, 3400)), (None, None, Some(4)));
    }
    #[test]
    fn what_is_not_certain_enough_waits() {
        let mut announced = Announced::new();
        let mut take = |class: usize, confidence: Option<i32>, ms: u64| {
            let decision = Decision { class, scores: [0; 8], lead: 99, confidence: confidence.map(Q15) };
            let demand = Demand { onset_us: 0, lead: 50, certainty: Certainty::of(600).unwrap() };
            announced.take(&decision, Micros(1000 * ms), &demand)
        };
        assert_eq!((take(2, None, 0), take(2, Some(19_660), 100)), (None, None));
        assert_eq!(take(2, Some(19_661), 200), Some(2));
        assert_eq!((take(3, Some(19_660), 300), take(3, Some(30_000), 400)), (None, Some(3)));
    }
}
