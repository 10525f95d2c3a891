//! Ends of what was present when the board was lost or restarted, reported by the host.

use super::Client;
use super::event::Event;
use taxel_core::body::Placed;
use taxel_core::contact::Phase;
use taxel_core::format::{Micros, Q15};
use taxel_core::intent::{Leading, Outcome};
use taxel_core::wire::IntentReport;

impl Client {
    /// The link is lost, for this reason, and was last heard at this time of the host, us. What was present ends.
    pub fn lost(&mut self, why: String, since_us: u64) {
        self.end_all();
        self.say(Event::Lost { why, since_us });
    }

    /// Ends what the board has reported to be present: it has forgotten it, or can no longer say that it ends. Events
    /// say so, at the time and with the number of the scan that were reported last.
    pub(super) fn end_all(&mut self) {
        let (frame, time) = (self.contacts_of, self.board_time().unwrap_or(Micros(0)));
        let ids = self.contacts.iter().map(|placed| placed.contact.id).collect();
        let mut released = std::mem::take(&mut self.contacts);
        for Placed { contact, .. } in &mut released {
            (contact.phase, contact.total) = (Phase::Released, 0);
        }
        if !released.is_empty() {
            self.growths.feel(&[], &released);
            self.say(Event::Contacts { frame, time, dropped: 0, released, doubted: Vec::new() });
        }
        let ends = self.ongoing.end(ids, frame, time);
        ends.into_iter().for_each(|event| self.say(event));
        if let Some(report) = self.intention.take()
            && (report.leading != Leading::None || report.concepts.iter().any(|value| *value != Q15(0)))
        {
            let concepts = report.concepts.iter().map(|_| Q15(0)).collect();
            let (leading, outcome) = (Leading::None, Outcome::Fixed);
            let none = IntentReport { frame, time, leading, outcome, steps: 0, concepts };
            self.say(Event::Intent(Box::new(none)));
        }
        (self.picture, self.led, self.gesture) = Default::default();
        self.form_ages.clear();
        [&mut self.released, &mut self.unsure].into_iter().for_each(Vec::clear);
        self.regions.clear();
        self.raw.clear();
    }
}
