//! The pattern of pressure inside a contact, and its displacement.
//!
//! A small picture of the middle of the contact is kept as an anchor, and each frame is compared with it
//! ([`Flow`]). Because displacement is measured from a fixed picture, the noise of the frames does not add
//! up, and slow creep is found. After half a taxel of displacement, a new picture is taken.

use super::album::{Album, LEAST_AREA, Leaf, Picture};
use super::flow::{Flow, Pictures};
use super::gradient::SIDE;
use crate::garment::{Area, Rect};
use crate::image::view::Image;
use crate::measure::component::Component;
use crate::segment::threshold::touched;

/// Displacement along x and y, in 2^-16 taxel.
pub(crate) type Way = [i32; 2];

/// Fewest taxels clear of the outline: with fewer than six by six, a wave of pressure cannot be distinguished
/// from a slope.
const LEAST_INNER: u32 = 36;
/// Frames for which a contact without a pattern is not examined.
const PAUSE: u8 = 8;
/// Consecutive mismatches that are tolerated before such a pause.
const PATIENCE: u8 = 3;
/// Displacement after which a new picture is taken: half a taxel.
const FAR: i32 = 1 << 15;

/// A row in which nothing touches.
const NOTHING: [u16; SIDE] = [0; SIDE];

/// The pattern of a contact.
#[derive(Debug, Clone)]
pub(crate) struct Pattern {
    /// Place of its picture; none without one.
    taken: Option<Leaf>,
    /// Displacement since it was taken.
    moved: Way,
    /// Last step.
    step: Way,
    pause: u8,
    /// Consecutive frames that did not match the picture.
    lost: u8,
}

impl Pattern {
    pub const fn new() -> Self {
        Pattern { taken: None, moved: [0; 2], step: [0; 2], pause: 0, lost: 0 }
    }

    /// Gives its picture back.
    pub fn drop_picture(&mut self, album: &mut Album) {
        if let Some(leaf) = self.taken.take() {
            album.free(leaf);
        }
    }

    /// Drops the picture, so that the next frame is compared with nothing.
    pub fn forget(&mut self, album: &mut Album) {
        self.drop_picture(album);
        self.pause = 0;
        self.lost = 0;
        self.step = [0; 2];
    }

    /// Returns the displacement of the pattern since the last frame; without a pattern that of the contact's
    /// centroid, `step`.
    pub fn follow(
        &mut self,
        component: &Component,
        (album, area, image): (&mut Album, &Area, &Image),
        low: u16,
        step: Way,
    ) -> Way {
        if self.pause > 0 {
            self.pause -= 1;
            self.step = step;
            return step;
        }
        let flow = self.compare(component, (album, area, image), step);
        if let Some(Flow::Moved(moved)) = flow {
            self.step = [moved[0] - self.moved[0], moved[1] - self.moved[1]];
            (self.moved, self.lost) = (moved, 0);
            if moved.iter().any(|way| way.abs() > FAR) {
                self.take(component, (album, area, image), low);
            }
            return self.step;
        }
        self.lost = if flow.is_some() { self.lost + 1 } else { 0 };
        if flow == Some(Flow::Flat) || self.lost > PATIENCE {
            self.drop_picture(album);
            (self.pause, self.lost) = (PAUSE, 0);
        } else {
            self.take(component, (album, area, image), low);
        }
        if self.lost != 1 {
            // A first mismatch may be due to the picture; a second one is due to the prediction.
            self.step = step;
        }
        step
    }

    /// Displacement since the picture was taken. Returns none if there is no picture, or if the contact's
    /// total or panel has changed: more pressure raises the pattern, which must not be taken for motion.
    fn compare(
        &self,
        component: &Component,
        (album, area, image): (&Album, &Area, &Image),
        step: Way,
    ) -> Option<Flow> {
        let Picture { anchor, inner, window, total, peak } = album.picture(self.taken?)?;
        let same = total.abs_diff(component.total) <= total / 16 && window.panel == component.bounds.panel;
        if !same {
            return None;
        }
        let sum = |step: Way| [self.moved[0].saturating_add(step[0]), self.moved[1].saturating_add(step[1])];
        // Expected to go on as before, unless the whole contact has moved farther than the comparison
        // reaches.
        let outline = sum(step);
        let start =
            if step.iter().any(|way| way.unsigned_abs() > 3 << 14) { outline } else { sum(self.step) };
        let within = |start: i32, first: u16, last: u16, size: u16| {
            let (least, most) = (-i32::from(first), i32::from(size) - 1 - i32::from(last));
            ((start + (1 << 15)) >> 16).min(most).max(least)
        };
        let x = within(start[0], window.left, window.right, area.columns);
        let y = within(start[1], window.top, window.bottom, area.rows);
        let columns = usize::from(window.right.saturating_sub(window.left)) + 1;
        let rows = window.bottom.saturating_sub(window.top) + 1;
        let (left, top) =
            (window.left.wrapping_add_signed(x as i16), window.top.wrapping_add_signed(y as i16));
        let cut = Cut { image, area, left: left.into(), columns };
        let mut now: [&[u16]; SIDE] = [&[]; SIDE];
        for (now, row) in now.iter_mut().zip(0..rows) {
            *now = cut.row(top.wrapping_add(row));
        }
        let pictures = Pictures {
            before: anchor,
            now,
            rows: rows.into(),
            columns,
            inner,
            peak: (*peak).max(component.peak),
        };
        let shift = [x << 16, y << 16];
        let expected = [outline[0].saturating_sub(shift[0]), outline[1].saturating_sub(shift[1])];
        Some(match Flow::of(&pictures, expected) {
            Flow::Moved(rest) => Flow::Moved([shift[0] + rest[0], shift[1] + rest[1]]),
            other => other,
        })
    }

    /// Takes a new picture, if the contact is large enough and clear of its outline.
    fn take(&mut self, component: &Component, (album, area, image): (&mut Album, &Area, &Image), low: u16) {
        self.moved = [0; 2];
        if component.area >= LEAST_AREA {
            album.busy = true;
            let leaf = self.taken.take().or_else(|| album.take());
            let picture = leaf.and_then(|leaf| album.picture_mut(leaf));
            self.taken = leaf;
            if picture.is_some_and(|picture| picture.take(component, area, image, low)) {
                return;
            }
            self.pause = PAUSE;
        }
        self.drop_picture(album);
    }
}

impl Picture {
    /// Takes the picture of a contact; returns true if enough of it is clear of the outline.
    fn take(&mut self, component: &Component, area: &Area, image: &Image, low: u16) -> bool {
        let bounds = &component.bounds;
        let (left, right) = middle(component.x.0, bounds.left, bounds.right);
        let (top, bottom) = middle(component.y.0, bounds.top, bounds.bottom);
        // Rows and columns of the picture and one on each side: bit 0 is the column before the first.
        let mut held = [0u16; SIDE + 2];
        for (held, row) in held.iter_mut().zip(top..=bottom.saturating_add(2)) {
            let row = row.checked_sub(1).map_or(&[][..], |row| image.row(area, row));
            let start = usize::from(left.saturating_sub(1));
            let first = usize::from(left == 0);
            let values = row.get(start..row.len().min(start + SIDE + 2 - first)).unwrap_or(&[]);
            *held = (touched(values, low) as u16) << first;
        }
        let columns = (1u16 << (right - left).min(SIDE as u16 - 1)) - 1;
        let once = eroded(&held);
        self.inner = [0; SIDE];
        let mut count = 0;
        let twice = eroded(&once);
        let rows = self.inner.iter_mut().zip(twice.iter().skip(1)).zip(top..bottom);
        for (number, ((inner, row), _)) in rows.enumerate().skip(1) {
            // Without the border of the picture.
            let clear = row >> 1 & columns & !1;
            count += clear.count_ones();
            // Every other row: rows are smoothed with their neighbours, so the rest would add cost but no
            // information.
            *inner = if number % 2 == 1 { clear } else { 0 };
        }
        if count < LEAST_INNER {
            return false;
        }
        self.window = Rect { panel: bounds.panel, top, bottom, left, right };
        for (anchor, row) in self.anchor.iter_mut().zip(top..=bottom) {
            let row = image.row(area, row).get(usize::from(left)..=usize::from(right)).unwrap_or(&[]);
            anchor.iter_mut().zip(row).for_each(|(kept, value)| *kept = *value);
        }
        (self.total, self.peak) = (component.total, component.peak);
        true
    }
}

/// Columns of an image.
struct Cut<'a> {
    image: &'a Image<'a>,
    area: &'a Area,
    left: usize,
    columns: usize,
}

impl<'a> Cut<'a> {
    /// Returns the columns of a row, as zeros if the row is inactive.
    #[inline(never)] // M0+: out of line
    fn row(&self, row: u16) -> &'a [u16] {
        // The image has no values of an inactive row: even those from column 0 on are missing.
        let values = self.image.row(self.area, row).get(self.left..self.left + self.columns);
        values.or(NOTHING.get(..self.columns)).unwrap_or(&[])
    }
}

/// Returns at most [`SIDE`] of the places `first ..= last`, around `centre` (in 2^-16).
fn middle(centre: i32, first: u16, last: u16) -> (u16, u16) {
    let side = SIDE as u16 - 1;
    if last.saturating_sub(first) <= side {
        return (first, last.max(first));
    }
    let centre = ((centre >> 16).max(0) as u16).saturating_sub(side / 2);
    let start = centre.min(last - side).max(first);
    (start, start + side)
}

/// Returns the taxels whose eight neighbours are in the set too (morphological erosion).
fn eroded<const ROWS: usize>(rows: &[u16; ROWS]) -> [u16; ROWS] {
    let mut inner = [0; ROWS];
    for (inner, rows) in inner.iter_mut().skip(1).zip(rows.windows(3)) {
        let all = rows.iter().fold(u16::MAX, |all, row| all & row);
        *inner = all & all << 1 & all >> 1;
    }
    inner
}
