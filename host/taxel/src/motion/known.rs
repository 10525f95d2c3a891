//! Touches that are present, or have just ended, and what the robot does about each.

use super::config::{BehaviourConfig, ForceLimitConfig, TouchAction, WhenConfig};
use super::input::{MotionInput, MotionTouch};
use crate::mind::Mover;
use taxel_core::intent::Leading;

/// Time for which a touch that has ended still counts, us: what it meant is known only then.
const HELD_US: u64 = 1_000_000;
/// Time for which a touch may be gone and still be the same, us: a contact flickers where cloth slides.
const FLICKERS_US: u64 = 50_000;
/// Most touches that are kept: a hundred boards have fewer.
const MOST: usize = 1024;

/// A touch, and what is known of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RecentTouch {
    /// As it was reported last.
    pub touch: MotionTouch,
    /// Time of its onset, us.
    pub since_us: u64,
    /// Time at which it was seen last, us.
    pub seen_us: u64,
    /// Greatest force, N.
    pub most: f64,
    /// True if it is pressed now.
    pub is_present: bool,
}

/// Why the robot does something about a touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Chosen {
    pub action: TouchAction,
    /// Factor on the speed of the robot's own motion.
    pub factor: f64,
    /// Number of the row of `when`; none: a limit of force is near.
    pub row: Option<usize>,
}

/// Takes the touches of a cycle; what has ended long ago is forgotten.
pub(super) fn take(known: &mut Vec<RecentTouch>, input: &MotionInput<'_>) {
    let now_us = input.now_us;
    known.iter_mut().for_each(|it| it.is_present = false);
    for touch in input.touches {
        let has_room = known.len() < MOST;
        match known.iter_mut().find(|it| it.touch.touch == touch.touch) {
            Some(it) => {
                if now_us.saturating_sub(it.seen_us) > FLICKERS_US {
                    (it.since_us, it.most) = (now_us, touch.newtons);
                }
                it.most = it.most.max(touch.newtons);
                (it.touch, it.seen_us, it.is_present) = (touch.clone(), now_us, true);
            }
            None if has_room => known.push(RecentTouch {
                touch: touch.clone(),
                since_us: now_us,
                seen_us: now_us,
                most: touch.newtons,
                is_present: true,
            }),
            None => {}
        }
    }
    known.retain(|it| now_us.saturating_sub(it.seen_us) < HELD_US);
}

impl RecentTouch {
    /// Action of the robot about it; none if nothing fits. A touch that has ended counts only for what it meant.
    pub fn chosen(&self, config: &BehaviourConfig, leading: Leading) -> Option<Chosen> {
        let newtons = if self.is_present { self.touch.newtons } else { self.most };
        let of = |part: &[String]| self.touch.place.is_of(part);
        let is_near =
            |limit: &&ForceLimitConfig| of(&limit.part) && newtons >= config.retreat.begin * limit.newtons;
        if self.is_present && config.limits.iter().any(|limit| is_near(&limit)) {
            return Some(Chosen { action: TouchAction::Retreat, factor: 0.0, row: None });
        }
        // What is not sure counts as done to the robot.
        let is_moved_by = |mover: Mover| (mover == Mover::Own) == (self.touch.mover == Mover::Own);
        let fits = |when: &WhenConfig| {
            of(&when.part)
                && newtons >= when.newtons
                && when.meaning.is_none_or(|meaning| meaning == leading)
                && when.mover.is_none_or(is_moved_by)
                && (self.is_present || when.meaning.is_some_and(|meaning| meaning != Leading::None))
        };
        let (row, when) = config.when.iter().enumerate().find(|(_, when)| fits(when))?;
        let factor = match when.action {
            TouchAction::Slow => when.factor.unwrap_or(0.0),
            TouchAction::Ignore => 1.0,
            _ => 0.0,
        };
        Some(Chosen { action: when.action, factor, row: Some(row) })
    }
}
