//! Rims of contacts: the taxels beside a contact, each of which feels too little to be a part of it.
//!
//! The outermost taxels of a touch lie below the threshold of a contact's taxels. Together they feel some 60 to
//! 80 mN of any touch, which is much of a light one. The signed sum of code less baseline over the ring of
//! taxels around a contact has it back: noise is as often above as below, and adds nothing to the mean.
//!
//! A taxel of a contact is in no rim. One beside several contacts is in the rim of the one whose centroid is
//! nearest, among those of its own panel if there are any. A rim crosses seams. Taxels on which the garment's
//! folds press are left out: their doubt is more than a rim. So is a taxel that stands out, as an impulse does.

use super::LINKS;
use crate::baseline::feedback::Pressed;
use crate::contact::{Contact, ContactState, Slot};
use crate::garment::{Area, Layout, PANELS, Place, Rect, Side};
use crate::image::taxel_bits::TaxelBits;

/// Most columns of a strip: with one more on each side they fit a word.
const STRIP: u16 = 30;

/// Sums over the rims of a frame's contacts, counts.
#[derive(Debug, Clone)]
pub struct Rims<const CONTACTS: usize> {
    /// Of each present contact, on the link of its home panel.
    own: [i16; CONTACTS],
    /// Of all contacts on each link that is not the one of their home panels.
    away: [i16; LINKS],
}

/// A frame whose rims are summed up.
struct RimFrame<'a, const CONTACTS: usize, const RUNS: usize, const LABELS: usize, S, Felt> {
    contact: &'a ContactState<CONTACTS, RUNS, LABELS, S>,
    layout: &'a Layout,
    /// Link of each panel.
    links: &'a [u8; PANELS],
    /// Pressure of a taxel, counts; below 0 beyond its baseline.
    felt: Felt,
    /// Taxels of contacts.
    pressed: TaxelBits,
    /// Taxels of rims so far, if some contact reaches a seam.
    taken: Option<TaxelBits>,
    own: [i32; CONTACTS],
    away: [i32; LINKS],
}

impl<const CONTACTS: usize> Rims<CONTACTS> {
    /// Nothing beside any contact.
    pub const NONE: Rims<CONTACTS> = Rims { own: [0; CONTACTS], away: [0; LINKS] };

    /// Sums up the rims of a frame's contacts. `felt` returns the pressure of a taxel, counts, below 0 beyond
    /// its baseline; `links` has the link of each panel.
    #[inline(never)] // M0+: own registers and stack
    pub(crate) fn of<const RUNS: usize, const LABELS: usize, S: Slot>(
        contact: &ContactState<CONTACTS, RUNS, LABELS, S>,
        layout: &Layout,
        links: &[u8; PANELS],
        felt: impl Fn(usize) -> i32,
    ) -> Self {
        let mut pressed = TaxelBits::NONE;
        contact.each_pressed(layout, |runs| {
            runs.each().for_each(|(first, run)| pressed.mark(first, run.rebased(), (1, 0)));
        });
        let is_sewn = layout.joints().iter().any(|joint| {
            contact.touches(joint.a, joint.edge_a.side) || contact.touches(joint.b, joint.edge_b.side)
        });
        let taken = is_sewn.then_some(TaxelBits::NONE);
        let (own, away) = ([0; CONTACTS], [0; LINKS]);
        let mut frame = RimFrame { contact, layout, links, felt, pressed, taken, own, away };
        for (index, slot) in contact.present().iter().enumerate() {
            let rect = slot.contact().bounds;
            frame.around(index, &rect, frame.is_crowded(index, &rect));
        }
        for Pressed { rect, .. } in &contact.feedback().beyond {
            if let Some(index) = frame.contact_in(rect) {
                frame.around(index, rect, true);
            }
        }
        frame.cross_seams();
        let short = |sum: i32| sum.clamp(i16::MIN.into(), i16::MAX.into()) as i16;
        Rims { own: frame.own.map(short), away: frame.away.map(short) }
    }

    /// Rim of a present contact on the link of its home panel, counts.
    pub(super) fn of_contact(&self, index: u8) -> i32 {
        self.own.get(usize::from(index)).copied().unwrap_or(0).into()
    }

    /// Rims on each link, of contacts whose home panels lie on others, counts.
    pub(super) fn away(&self) -> impl Iterator<Item = i32> {
        self.away.iter().map(|sum| i32::from(*sum))
    }
}

impl<const CONTACTS: usize, const RUNS: usize, const LABELS: usize, S: Slot, Felt: Fn(usize) -> i32>
    RimFrame<'_, CONTACTS, RUNS, LABELS, S, Felt>
{
    /// Adds the rim of a contact around the taxels of it that lie in a rectangle.
    #[inline(never)] // M0+: own registers
    fn around(&mut self, contact: usize, rect: &Rect, is_crowded: bool) {
        let Some(area) = self.layout.areas().get(usize::from(rect.panel)) else { return };
        let (mut column, end) = (rect.left.saturating_sub(1), rect.right.saturating_add(2).min(area.columns));
        let mut sum = 0;
        while column < end {
            let count = (end - column).min(STRIP);
            sum += self.strip((contact, rect, is_crowded), area, column, count);
            column += count;
        }
        self.add(contact, rect.panel, sum);
    }

    /// Sum over `count` columns of a contact's rim, counts.
    fn strip(
        &mut self,
        (contact, rect, is_crowded): (usize, &Rect, bool),
        area: &Area,
        column: u16,
        count: u16,
    ) -> i32 {
        let columns = usize::from(area.columns);
        // Bit 0 for the column before the first one, if there is one; so for the last.
        let before = u32::from(column > 0);
        let after = u32::from(column + count < area.columns) << (count + 1);
        let inside = ((1 << count) - 1) << 1;
        let all = before | inside | after;
        let mut start = usize::from(area.base) + usize::from(rect.top) * columns + usize::from(column);
        let bits = |of: &TaxelBits, start: usize| match column {
            0 => of.from(start) << 1 & all,
            _ => of.from(start - 1) & all,
        };
        let next = |row: u16, start: usize, of: &TaxelBits| {
            if row + 1 < area.rows { bits(of, start + columns) } else { 0 }
        };
        let mut row = rect.top;
        if row > 0 {
            (row, start) = (row - 1, start - columns);
        }
        // Beyond the row above the first one nothing of this contact presses.
        let (mut above, mut here) = (0, bits(&self.pressed, start));
        let mut below = next(row, start, &self.pressed);
        let mut sum = 0;
        let last = rect.bottom.saturating_add(1).min(area.rows - 1);
        while row <= last {
            let near = above | here | below;
            let mut rim = (near | near << 1 | near >> 1) & !here & inside;
            let mut taxel = start;
            rim >>= 1;
            while rim != 0 {
                if rim & 1 == 1 && (!is_crowded || self.is_nearest(contact, taxel)) {
                    if let Some(taken) = &mut self.taken {
                        taken.mark(taxel, 1, (1, 0));
                    }
                    sum += (self.felt)(taxel);
                }
                (rim, taxel) = (rim >> 1, taxel + 1);
            }
            (row, start) = (row + 1, start + columns);
            (above, here) = (here, below);
            below = next(row, start, &self.pressed);
        }
        sum
    }

    /// Adds to the rims what lies beyond seams, and is in none yet.
    fn cross_seams(&mut self) {
        let Some(mut taken) = self.taken.take() else { return };
        for joint in self.layout.joints() {
            let sides: [(u8, Side); 2] = [(joint.a, joint.edge_a.side), (joint.b, joint.edge_b.side)];
            if !sides.iter().any(|(panel, side)| self.contact.touches(*panel, *side)) {
                continue;
            }
            for (a, b) in joint.neighbours() {
                for ((here, from), (there, to)) in
                    [((joint.a, a), (joint.b, b)), ((joint.b, b), (joint.a, a))]
                {
                    let (Some((_, here)), Some((taxel, _))) = (self.at(here, from), self.at(there, to))
                    else {
                        continue;
                    };
                    if self.pressed.has(taxel) || taken.has(taxel) {
                        continue;
                    }
                    if let Some(contact) = self.contact.contact_at(self.layout, here) {
                        taken.mark(taxel, 1, (1, 0));
                        self.add(contact, there, (self.felt)(taxel));
                    }
                }
            }
        }
    }

    /// Number and place of a taxel of a panel.
    fn at(&self, panel: u8, (x, y): (i32, i32)) -> Option<(usize, Place)> {
        let place = Place { panel, row: u16::try_from(y).ok()?, column: u16::try_from(x).ok()? };
        Some((self.layout.taxel(place)?, place))
    }

    /// Adds to the rim of a contact what was found on a panel.
    fn add(&mut self, contact: usize, panel: u8, sum: i32) {
        let home = self.contact.present().get(contact).map_or(panel, |slot| slot.contact().panel);
        let link = |panel: u8| self.links.get(usize::from(panel)).copied();
        let to = match link(panel) {
            here if here == link(home) => self.own.get_mut(contact),
            here => here.and_then(|link| self.away.get_mut(usize::from(link))),
        };
        if let Some(to) = to {
            *to = to.saturating_add(sum);
        }
    }

    /// True if a taxel beside a contact, which lies in this rectangle, may be beside another one, too.
    fn is_crowded(&self, contact: usize, rect: &Rect) -> bool {
        let is_near = |other: &Rect| {
            let apart = |last: u16, first: u16| first > last.saturating_add(2);
            !(other.panel != rect.panel
                || apart(rect.right, other.left)
                || apart(other.right, rect.left)
                || apart(rect.bottom, other.top)
                || apart(other.bottom, rect.top))
        };
        let others = self.contact.present().iter().enumerate();
        let mut others =
            others.filter(|(index, _)| *index != contact).map(|(_, slot)| &slot.contact().bounds);
        others.any(is_near) || self.contact.feedback().beyond.iter().any(|beyond| is_near(&beyond.rect))
    }

    /// True if a taxel is beside a contact, and beside none that is nearer.
    #[inline(never)] // seldom
    fn is_nearest(&self, contact: usize, taxel: usize) -> bool {
        let Some(place) = self.layout.place(taxel) else { return false };
        let present = self.contact.present();
        let distance = |index: usize| {
            let of = present.get(index).map(S::contact).filter(|contact| contact.panel == place.panel);
            (of.map_or(u32::MAX, |contact| distance(contact, &place)), index)
        };
        let mut is_beside = false;
        let rows = place.row.saturating_sub(1)..=place.row.saturating_add(1);
        for row in rows {
            for column in place.column.saturating_sub(1)..=place.column.saturating_add(1) {
                let beside = Place { row, column, ..place };
                let is_pressed = |taxel: &usize| self.pressed.has(*taxel);
                let pressed = self.layout.taxel(beside).filter(is_pressed);
                let other = pressed.and_then(|_| self.contact.contact_at(self.layout, beside));
                let Some(other) = other else { continue };
                if other == contact {
                    is_beside = true;
                } else if distance(other) < distance(contact) {
                    return false;
                }
            }
        }
        is_beside
    }

    /// Contact that has taxels in a rectangle: the part of one beyond a seam.
    fn contact_in(&self, rect: &Rect) -> Option<usize> {
        let column = rect.left;
        let at = |row: u16| self.contact.contact_at(self.layout, Place { panel: rect.panel, row, column });
        (rect.top..=rect.bottom).find_map(at)
    }
}

/// Square of the distance of a contact's centroid from a taxel of its panel, in 1/16 taxels.
fn distance(contact: &Contact, place: &Place) -> u32 {
    let apart = |at: i32, index: u16| (at >> 12).abs_diff(i32::from(index) << 4).min(u16::MAX.into());
    let [x, y] = [apart(contact.x.0, place.column), apart(contact.y.0, place.row)];
    (x * x).saturating_add(y * y)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::contact::{ContactConfig, Contacts};
    use crate::format::Micros;
    use crate::garment::Garment;
    use crate::image::rows::Rows;
    use crate::image::view::Image;
    use std::vec;
    use std::vec::Vec;

    type RimContacts = ContactState<16, 1024>;

    /// Contacts of an image in which each of some rectangles presses by a count that is its own.
    fn contacts(layout: &Layout, random: &mut impl FnMut(u16) -> u16) -> RimContacts {
        let stage: Contacts = ContactConfig { low: 1, high: 1, ..ContactConfig::default() }.build().unwrap();
        let mut values = vec![0; layout.taxels()];
        for _ in 0..1 + random(7) {
            let area = &layout.areas()[usize::from(random(layout.areas().len() as u16))];
            let [top, left] = [random(area.rows), random(area.columns)];
            let [rows, columns] = [1 + random(5), 1 + random(if area.columns > 40 { 40 } else { 5 })];
            for row in top..area.rows.min(top + rows) {
                for column in left..area.columns.min(left + columns) {
                    values[usize::from(area.base + row * area.columns + column)] = 100 + random(50);
                }
            }
        }
        let mut state = RimContacts::new();
        stage.process(
            &mut state,
            layout,
            &Image { values: &values, rows: &Rows::of(layout, &values) },
            Micros(0),
        );
        state
    }

    fn noise() -> impl FnMut(u16) -> u16 {
        let mut state = 1u32;
        move |end| {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            (u32::from(end) * (state >> 16) >> 16) as u16
        }
    }

    fn felt(taxel: usize) -> i32 {
        (taxel * 7919 % 41) as i32 - 15
    }

    /// Contacts beside a taxel on its own panel, none if it is of a contact.
    fn beside(state: &RimContacts, layout: &Layout, taxel: usize) -> Vec<usize> {
        let Place { panel, row, column } = layout.place(taxel).unwrap();
        let at = |down: i16, right: i16| {
            let (row, column) = (row.checked_add_signed(down)?, column.checked_add_signed(right)?);
            state.contact_at(layout, Place { panel, row, column })
        };
        let around = || (-1..=1).flat_map(|down| (-1..=1).map(move |right| (down, right)));
        let mut all: Vec<usize> = around().filter_map(|(down, right)| at(down, right)).collect();
        all.retain(|_| at(0, 0).is_none());
        all.sort_unstable();
        all.dedup();
        all
    }

    #[test]
    fn a_taxel_beside_contacts_is_in_the_rim_of_the_nearest_one() {
        let mut random = noise();
        let mut shared = 0;
        for garment in
            [Garment::mat(), Garment::block(), Garment::recorded(20, 27), Garment::recorded(9, 100)]
        {
            let layout = Layout::build(&garment, 2048, u16::MAX).unwrap();
            for _ in 0..200 {
                let state = contacts(&layout, &mut random);
                let mut wanted = [0; 16];
                for taxel in 0..layout.taxels() {
                    let all = beside(&state, &layout, taxel);
                    let place = layout.place(taxel).unwrap();
                    let nearest =
                        all.iter().min_by_key(|index| (distance(&state.present()[**index], &place), **index));
                    shared += usize::from(all.len() > 1);
                    if let Some(index) = nearest {
                        wanted[*index] += felt(taxel);
                    }
                }
                let rims = Rims::of(&state, &layout, &[0; PANELS], felt);
                assert_eq!(rims.own.map(i32::from), wanted, "{}: {:?}", garment.name, state.present());
            }
        }
        assert!(shared > 500, "{shared}");
    }

    #[test]
    fn rims_cross_seams_and_count_no_taxel_twice() {
        let mut random = noise();
        let layout = Layout::build(&Garment::reference(), 2048, u16::MAX).unwrap();
        let mut crossed = 0;
        for _ in 0..300 {
            let state = contacts(&layout, &mut random);
            let is_pressed =
                |(taxel, place): (usize, Place)| (taxel, state.contact_at(&layout, place).is_some());
            let mut rim: Vec<usize> =
                (0..layout.taxels()).filter(|taxel| !beside(&state, &layout, *taxel).is_empty()).collect();
            for joint in layout.joints() {
                let at = |panel: u8, (x, y): (i32, i32)| {
                    let place = Place { panel, row: y as u16, column: x as u16 };
                    (layout.taxel(place).unwrap(), place)
                };
                for (a, b) in joint.neighbours() {
                    match [is_pressed(at(joint.a, a)), is_pressed(at(joint.b, b))] {
                        [(_, true), (taxel, false)] | [(taxel, false), (_, true)] => rim.push(taxel),
                        _ => {}
                    }
                }
            }
            let before = rim.len();
            rim.sort_unstable();
            rim.dedup();
            crossed += usize::from(rim.len() != before);
            let wanted: i32 = rim.iter().map(|taxel| felt(*taxel)).sum();
            // All panels on one link, and each on its own.
            for links in [[0; PANELS], core::array::from_fn(|panel| panel as u8)] {
                let rims = Rims::of(&state, &layout, &links, felt);
                let all = rims.own.iter().chain(&rims.away).map(|sum| i32::from(*sum)).sum::<i32>();
                assert_eq!(all, wanted, "{:?}", state.present());
            }
        }
        assert!(crossed > 20, "{crossed}");
    }
}
