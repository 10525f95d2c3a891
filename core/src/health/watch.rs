//! Which taxels are watched when: some begin in every frame, and those that began [`FRAMES`] frames ago have been seen for
//! long enough. So no frame costs more than another.

use super::seen::Seen;
use crate::format::Code;

/// Frames in which a taxel is seen before it is judged.
pub(super) const FRAMES: usize = 11;
/// Taxels that begin together: a group.
pub(super) const GROUP: usize = 23;

/// The groups that are watched, the last one to begin in `slot`, the one before it in the slot before.
#[derive(Debug, Clone)]
pub(super) struct Watch {
    seen: [[Seen; GROUP]; FRAMES],
    /// Number of the group that began last.
    group: u16,
    slot: u8,
    /// Groups that have begun since the watch did, at most [`FRAMES`].
    begun: u8,
    /// Groups there are, and those that are waited for where there are fewer than [`FRAMES`].
    groups: u16,
}

impl Watch {
    /// Nothing has been seen.
    pub const fn new() -> Self {
        Watch { seen: [[Seen::NOTHING; GROUP]; FRAMES], group: 0, slot: 0, begun: 0, groups: 0 }
    }

    /// Begins anew with the next frame.
    pub fn again(&mut self) {
        self.begun = 0;
    }

    /// Takes a frame of that many taxels. Whether a group has now been seen for long enough: that of age `FRAMES - 1`.
    pub fn take(&mut self, codes: &[Code], taxels: usize) -> bool {
        if self.begun == 0 {
            (self.group, self.slot) = (0, 0);
            self.groups = taxels.div_ceil(GROUP).max(FRAMES) as u16;
        } else {
            self.group = if self.group + 1 < self.groups { self.group + 1 } else { 0 };
            self.slot = if usize::from(self.slot) + 1 < FRAMES { self.slot + 1 } else { 0 };
        }
        let codes = codes.get(..taxels).unwrap_or(codes);
        let (mut group, mut slot) = (usize::from(self.group), usize::from(self.slot));
        for age in 0..usize::from(self.begun).min(FRAMES - 1) + 1 {
            let codes = codes.get(group * GROUP..).unwrap_or(&[]);
            let Some(seen) = self.seen.get_mut(slot) else { continue };
            if age == 0 {
                seen.iter_mut().zip(codes).for_each(|(seen, code)| seen.begin(*code));
            } else {
                see(seen, codes);
            }
            // The one that began a frame earlier.
            group = group.checked_sub(1).unwrap_or(usize::from(self.groups) - 1);
            slot = slot.checked_sub(1).unwrap_or(FRAMES - 1);
        }
        self.begun = (self.begun + 1).min(FRAMES as u8);
        usize::from(self.begun) == FRAMES
    }

    /// First taxel and slot of the group that began so many frames ago, fewer than [`FRAMES`].
    fn at(&self, age: usize) -> (usize, usize) {
        let group = (usize::from(self.group) + usize::from(self.groups)).saturating_sub(age);
        let group = group.checked_sub(usize::from(self.groups)).unwrap_or(group);
        let slot = usize::from(self.slot);
        (group * GROUP, if slot < age { slot + FRAMES - age } else { slot - age })
    }

    /// First taxel of the group of that age, and what was seen of it; past the last taxel nothing was.
    pub fn group(&self, age: usize) -> (usize, &[Seen]) {
        let (first, slot) = self.at(age);
        (first, self.seen.get(slot).map_or(&[], |seen| seen))
    }

    /// What was seen of a taxel in at least half as many frames as it is to be.
    pub fn seen(&self, taxel: usize) -> Option<&Seen> {
        (FRAMES / 2..FRAMES).map(|age| self.group(age)).find_map(|(first, seen)| {
            let index = taxel.checked_sub(first)?;
            seen.get(index)
        })
    }
}

/// Not inlined: on its own it has registers enough.
#[inline(never)]
fn see(seen: &mut [Seen; GROUP], codes: &[Code]) {
    seen.iter_mut().zip(codes).for_each(|(seen, code)| seen.see(*code));
}
