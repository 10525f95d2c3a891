//! Median 3x3, Sobel, threshold, labels and moments of a panel by the core; its own tests use this file, too.

use super::scenes::{COLUMNS, ROWS, THRESHOLD};
use taxel_core::condition::{Condition, ConditionConfig, ConditionState, Filter, Sampled};
use taxel_core::contact::{ContactConfig, ContactState, Contacts};
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Layout};

/// A contact as both report it: sum f, sum x f, sum y f.
pub type Sums = (u64, i64, i64);

const TAXELS: usize = ROWS * COLUMNS;

/// The core's stage condition, and of the stage contact what finds and measures. Their Sobel operator is
/// applied where it is used, on the contours; what they do besides (baseline, gain, peaks, bounds) is timed
/// with it.
pub struct Ours {
    layout: Layout,
    condition: Condition,
    contact: Contacts,
    state: (Box<ConditionState<TAXELS>>, Box<ContactState<64, { TAXELS / 2 }>>),
    frame: u64,
}

impl Default for Ours {
    /// Before the first frame, with the panel at rest.
    fn default() -> Ours {
        let layout =
            Layout::build(&Garment::recorded(ROWS as u16, COLUMNS as u16), TAXELS, u16::MAX).unwrap();
        let condition = ConditionConfig { floor: 1, filter: Filter::Median, ..Default::default() };
        let threshold = u16::from(THRESHOLD);
        let contact = ContactConfig { low: threshold, high: threshold, ..Default::default() };
        let mut state = (Box::new(ConditionState::new()), Box::new(ContactState::new()));
        state.0.reset(&layout, Code(0));
        Ours {
            layout,
            condition: condition.build().unwrap(),
            contact: contact.build().unwrap(),
            state,
            frame: 0,
        }
    }
}

impl Ours {
    /// One frame, and the sums of what it found.
    pub fn segment(&mut self, codes: &[Code]) -> impl Iterator<Item = Sums> {
        let (condition, contact) = &mut self.state;
        let sampled = Sampled { codes, falling: false, panels: 1, now: Micros(0) };
        let image = self.condition.process(condition, &self.layout, &sampled, contact.feedback());
        let found = self.contact.segment(contact, &self.layout, &image);
        found.iter().map(|found| (found.moments.m, found.moments.sx, found.moments.sy))
    }

    /// One frame with all that the stages do: axes, ids, velocities, slip. How many contacts it has.
    pub fn follow(&mut self, codes: &[Code]) -> usize {
        self.frame += 1;
        let (condition, contact) = &mut self.state;
        let now = Micros(self.frame * 5128);
        let sampled = Sampled { codes, falling: false, panels: 1, now };
        let image = self.condition.process(condition, &self.layout, &sampled, contact.feedback());
        self.contact.process(contact, &self.layout, &image, now).present.len()
    }
}
