//! State that one board has reported: its contacts, present and just ended, and what it announces.

use super::body_part::{BodyPart, PartFlags};
use super::felt::{BoardPlacement, FeltContact};
use super::mover::{Approach, BasePlace, Mover};
use super::place::BodyPlace;
use super::probe::ProbeCourse;
use super::speeds::{LinkSpeeds, LinksAt};
use crate::fcm::robot_source::PartWords;
use std::sync::Arc;
use taxel_core::format::Q15;
use taxel_core::intent::Leading;
use taxel_core::wire::IntentReport;

/// Time for which a contact that has ended still counts, and within which its greatest force does, us: a
/// board announces what a touch meant for 0.6 s, and the arms of a hug open one after the other.
const HELD_US: u64 = 1_200_000;
/// Time within which two contacts begin together, us; also that within which joints are sent that were read
/// before an onset.
pub(super) const TOGETHER_US: u64 = 150_000;

/// A contact that is present, or was until a moment ago.
#[derive(Debug, Clone, PartialEq)]
pub struct SensedTouch {
    /// The contact, as it was reported last.
    pub felt: FeltContact,
    /// Host time at which it was first reported, us.
    pub since_us: u64,
    /// Host time at which it was no longer reported, us; none while it is present.
    pub ended_us: Option<u64>,
    /// Greatest load so far.
    pub most: u32,
    /// Greatest load within [`HELD_US`], and the host's time of that, us.
    pub(super) recent: (u32, u64),
    /// Motion of the robot's surface before the onset; none if it is not known.
    pub approach: Option<Approach>,
    /// Motion that has caused it.
    pub mover: Mover,
    /// Course of the touch on the object, if the robot has moved into it.
    pub course: ProbeCourse,
    /// Parts of the body of which its place is.
    parts: PartFlags,
    /// Place in the base when it was reported last, and the host's time of that, us; none if it is not known.
    pub(super) in_base: Option<(BasePlace, u64)>,
    /// Number of times that joints had been sent when it was found whose motion has caused it.
    judged: Option<u64>,
}

impl SensedTouch {
    /// True if it lies on this part.
    pub(super) fn is_of(&self, part: BodyPart<'_>) -> bool {
        part.has(&self.felt.place, &self.parts)
    }

    /// True if it is present or has ended within [`HELD_US`].
    fn counts(&self, now_us: u64) -> bool {
        self.ended_us.is_none_or(|ended| now_us.saturating_sub(ended) < HELD_US)
    }

    /// Takes the load of now.
    fn load(&mut self, host_us: u64) {
        let (recent, at_us) = self.recent;
        if self.felt.load >= recent || host_us.saturating_sub(at_us) >= HELD_US {
            self.recent = (self.felt.load, host_us);
        }
    }

    /// Finds whose motion has caused it, unless nothing was sent of the joints since that was found.
    fn judge(&mut self, speeds: Option<&LinkSpeeds>) {
        let taken = speeds.map(LinkSpeeds::taken);
        if taken.is_some() && taken == self.judged {
            return;
        }
        self.judged = taken;
        self.approach = self.felt.spot.as_ref().zip(speeds).and_then(|(spot, speeds)| {
            // Where the contact is later says nothing of how it began.
            spot.approach(speeds, self.since_us)
        });
        self.mover = self.approach.map_or(Mover::Unsure, Approach::mover);
    }
}

/// Time at which contacts are reported, and what is known of the robot then.
pub(super) struct ListedAt<'a> {
    /// The host's time, us.
    pub(super) host_us: u64,
    /// The robot's motion; none without a description of it.
    pub(super) speeds: Option<&'a LinkSpeeds>,
    /// Places of its links then; none if it is not known.
    pub(super) links: Option<&'a LinksAt<'a>>,
    /// Parts of the body that have a number.
    pub(super) parts: &'a [PartWords],
}

/// State that a board has reported.
#[derive(Debug, Clone, Default)]
pub(super) struct SensedBoard {
    /// Host time of what it said last, us; none while it is not there.
    pub(super) heard_us: Option<u64>,
    pub(super) placement: Option<BoardPlacement>,
    /// Places of the garment, and the parts of the body of which each is.
    places: Vec<(Arc<BodyPlace>, PartFlags)>,
    /// Present contacts, and those that have ended within [`HELD_US`].
    pub(super) contacts: Vec<SensedTouch>,
    pub(super) report: Option<Box<IntentReport>>,
}

impl SensedBoard {
    /// Age of what it has said, ms, unless it is not there or silent for too long.
    pub(super) fn age_ms(&self, timeout_ms: Option<u32>, now_us: u64) -> Option<u32> {
        let age_ms = u32::try_from(now_us.saturating_sub(self.heard_us?) / 1000).unwrap_or(u32::MAX);
        timeout_ms.is_none_or(|timeout_ms| age_ms < timeout_ms).then_some(age_ms)
    }

    /// A board that begins, with this garment.
    pub(super) fn begin(placement: &BoardPlacement, parts: &[PartWords]) -> SensedBoard {
        let flags = |place: &Arc<BodyPlace>| (place.clone(), place.parts(parts));
        let places = placement.places.iter().map(flags).collect();
        SensedBoard { placement: Some(placement.clone()), places, ..SensedBoard::default() }
    }

    /// Forgets all that it said: the board is lost.
    pub(super) fn forget(&mut self) {
        let (placement, places) = (self.placement.take(), std::mem::take(&mut self.places));
        *self = SensedBoard { placement, places, ..SensedBoard::default() };
    }

    /// True if its garment covers some of this part.
    pub(super) fn covers(&self, part: BodyPart<'_>) -> bool {
        self.places.iter().any(|(place, flags)| part.has(place, flags))
    }

    /// Contacts on a part that are present or have ended within [`HELD_US`].
    pub(super) fn touches<'a>(
        &'a self,
        part: BodyPart<'a>,
        now_us: u64,
    ) -> impl Iterator<Item = &'a SensedTouch> {
        let counts = move |touch: &&SensedTouch| touch.counts(now_us);
        self.contacts.iter().filter(counts).filter(move |touch| touch.is_of(part))
    }

    /// Takes its present contacts. Whose motion has caused one is found anew while joints may still be sent
    /// that were read before.
    pub(super) fn list(&mut self, contacts: &[FeltContact], reported: &ListedAt<'_>) {
        let ListedAt { speeds, links, host_us, .. } = *reported;
        let is_recent =
            |touch: &SensedTouch| touch.ended_us.is_none_or(|ended| host_us.saturating_sub(ended) < HELD_US);
        self.contacts.retain(is_recent);
        for touch in self.contacts.iter_mut().filter(|touch| touch.ended_us.is_none()) {
            if !contacts.iter().any(|felt| felt.contact == touch.felt.contact) {
                touch.ended_us = Some(host_us);
            }
        }
        for felt in contacts {
            let in_base = felt.spot.as_ref().zip(links).and_then(|(spot, links)| spot.in_base(links));
            let in_base = in_base.map(|place| (place, host_us));
            let known = self.contacts.iter_mut().find(|touch| touch.felt.contact == felt.contact);
            match known {
                Some(touch) => {
                    let is_new = host_us.saturating_sub(touch.since_us) < TOGETHER_US;
                    if !Arc::ptr_eq(&touch.felt.place, &felt.place) {
                        touch.parts = flags(&self.places, &felt.place, reported.parts);
                    }
                    (touch.felt, touch.ended_us, touch.in_base) = (felt.clone(), None, in_base);
                    touch.most = touch.most.max(felt.load);
                    touch.load(host_us);
                    touch.course.take(felt, links, host_us);
                    if is_new && touch.mover != Mover::Own {
                        touch.judge(speeds);
                    }
                }
                None => {
                    let mut touch = SensedTouch {
                        felt: felt.clone(),
                        since_us: host_us,
                        ended_us: None,
                        most: felt.load,
                        recent: (felt.load, host_us),
                        approach: None,
                        mover: Mover::Unsure,
                        course: ProbeCourse::begin(felt, links, host_us),
                        parts: flags(&self.places, &felt.place, reported.parts),
                        in_base,
                        judged: None,
                    };
                    touch.judge(speeds);
                    self.contacts.push(touch);
                }
            }
        }
    }

    /// Share of the force that the robot's own motion has caused, of present contacts and of those that have
    /// just ended, 2^-15; none if nothing touches or nothing is known of the motion.
    pub(super) fn own(&self) -> Option<i32> {
        let known = self.contacts.iter().any(|touch| touch.approach.is_some());
        let most = |touch: &SensedTouch| u64::from(touch.most);
        let all: u64 = self.contacts.iter().map(most).sum();
        let own: u64 = self.contacts.iter().filter(|touch| touch.mover == Mover::Own).map(most).sum();
        (known && all > 0).then(|| (own as f64 / all as f64 * f64::from(Q15::ONE.0)).round() as i32)
    }

    /// Activation of the intention that it announces; none if it announces another.
    pub(super) fn announces(&self, leading: Leading) -> Option<Q15> {
        let report = self.report.as_ref().filter(|report| report.leading == leading)?;
        let concepts = &self.placement.as_ref()?.map.as_ref()?.concept;
        let at = concepts.iter().position(|concept| concept.name == leading.as_str())?;
        report.concepts.get(at).copied()
    }
}

/// The parts of which a place is, mostly one of those of the board.
fn flags(known: &[(Arc<BodyPlace>, PartFlags)], place: &Arc<BodyPlace>, parts: &[PartWords]) -> PartFlags {
    let mut known = known.iter().filter(|(other, _)| Arc::ptr_eq(other, place));
    known.next().map_or_else(|| place.parts(parts), |(_, flags)| flags.clone())
}
