//! Schedule of the watch: a group of taxels begins in every frame, and the one that began [`FRAMES`] frames
//! ago is complete. So no frame costs more than another.

use super::seen::Seen;
use crate::format::Code;

/// Number of frames in which a taxel is seen before it is judged.
pub(super) const FRAMES: usize = 11;
/// Number of taxels that begin together: a group.
pub(super) const GROUP: usize = 23;

/// The watched groups in a ring; the last to begin is in `slot`, the one before it in the slot before.
#[derive(Debug, Clone)]
pub(super) struct Watch {
    seen: [Seen; GROUP * FRAMES],
    /// Number of the group that began last.
    group: u16,
    slot: u8,
    /// Number of groups that have begun since the watch did, at most [`FRAMES`].
    begun: u8,
    /// Number of groups, padded with empty ones to at least [`FRAMES`].
    groups: u16,
}

impl Watch {
    /// State before the first frame. All bytes are 0.
    pub const fn new() -> Self {
        Watch { seen: [Seen::BLANK; GROUP * FRAMES], group: 0, slot: 0, begun: 0, groups: 0 }
    }

    /// Restarts the watch with the next frame.
    pub fn again(&mut self) {
        self.begun = 0;
    }

    /// Takes a frame of that many taxels. Returns true if a group is now complete: the one of age
    /// `FRAMES - 1`.
    pub fn take(&mut self, codes: &[Code], taxels: usize) -> bool {
        if self.begun == 0 {
            self.seen.fill(Seen::NOTHING);
            (self.group, self.slot) = (0, 0);
            self.groups = taxels.div_ceil(GROUP).max(FRAMES) as u16;
        } else {
            self.group = if self.group + 1 < self.groups { self.group + 1 } else { 0 };
            self.slot = if usize::from(self.slot) + 1 < FRAMES { self.slot + 1 } else { 0 };
        }
        let codes = codes.get(..taxels).unwrap_or(codes);
        let slot = usize::from(self.slot);
        if let Some(seen) = self.seen.get_mut(slot * GROUP..(slot + 1) * GROUP) {
            let codes = codes.get(usize::from(self.group) * GROUP..).unwrap_or(&[]);
            seen.iter_mut().zip(codes).for_each(|(seen, code)| seen.begin(*code));
        }
        // Groups that have not begun yet are updated, too; their beginning resets them.
        self.go_on(codes, 0, slot, slot);
        self.go_on(codes, slot + 1, FRAMES, FRAMES - 1);
        self.begun = (self.begun + 1).min(FRAMES as u8);
        usize::from(self.begun) == FRAMES
    }

    /// Takes the codes of the groups in slots `from .. to`; the first of them began `age` frames ago. Their
    /// taxels are consecutive, except that the first group follows the last of all.
    fn go_on(&mut self, codes: &[Code], mut from: usize, to: usize, age: usize) {
        let mut group = self.at(age).0;
        while from < to {
            let end = to.min(from + usize::from(self.groups).saturating_sub(group).max(1));
            let codes = codes.get(group * GROUP..).unwrap_or(&[]);
            see(self.seen.get_mut(from * GROUP..end * GROUP).unwrap_or(&mut []), codes);
            (from, group) = (end, 0);
        }
    }

    /// Number and slot of the group that began `age` frames ago, fewer than [`FRAMES`].
    fn at(&self, age: usize) -> (usize, usize) {
        let group = (usize::from(self.group) + usize::from(self.groups)).saturating_sub(age);
        let group = group.checked_sub(usize::from(self.groups)).unwrap_or(group);
        let slot = usize::from(self.slot);
        (group, if slot < age { slot + FRAMES - age } else { slot - age })
    }

    /// First taxel of the group of that age, and its statistics; those past the last taxel are empty.
    pub fn group(&self, age: usize) -> (usize, &[Seen]) {
        let (group, slot) = self.at(age);
        (group * GROUP, self.seen.get(slot * GROUP..(slot + 1) * GROUP).unwrap_or(&[]))
    }

    /// Statistics of a taxel, if it was seen in at least half of its frames.
    pub fn seen(&self, taxel: usize) -> Option<&Seen> {
        (FRAMES / 2..FRAMES).map(|age| self.group(age)).find_map(|(first, seen)| {
            let index = taxel.checked_sub(first)?;
            seen.get(index)
        })
    }
}

/// Takes the next code of each taxel: some hundred in every frame, four at a time.
// M0+: out of line
#[inline(never)]
fn see(seen: &mut [Seen], codes: &[Code]) {
    let count = seen.len().min(codes.len());
    let (Some(seen), Some(codes)) = (seen.get_mut(..count), codes.get(..count)) else { return };
    let ((fours, last), (four_codes, last_codes)) = (seen.as_chunks_mut::<4>(), codes.as_chunks::<4>());
    for ([a, b, c, d], [e, f, g, h]) in fours.iter_mut().zip(four_codes) {
        a.see(*e);
        b.see(*f);
        c.see(*g);
        d.see(*h);
    }
    last.iter_mut().zip(last_codes).for_each(|(seen, code)| seen.see(*code));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_is_seen_once() {
        for (taxels, count) in [(0, 5), (1, 1), (3, 9), (4, 4), (23, 23), (23, 40), (46, 30), (9, 6)] {
            let mut seen = [Seen::NOTHING; 46];
            seen.iter_mut().for_each(|seen| seen.begin(Code(100)));
            let codes: [Code; 46] = core::array::from_fn(|at| Code(101 + at as u16));
            see(&mut seen[..taxels], &codes[..count]);
            for (at, seen) in seen.iter().enumerate() {
                let travel = if at < taxels.min(count) { 1 + at as u16 } else { 0 };
                assert_eq!(seen.travel(), travel, "{taxels} {count} {at}");
            }
        }
    }
}
