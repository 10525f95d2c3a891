//! The pattern of pressure inside a contact, and how far it has moved.
//!
//! A small picture of the middle of the contact is kept as an anchor, and each frame is compared with it
//! ([`Flow`]): displacement is measured from a fixed picture, so that the noise of the frames does not add
//! up, and a pattern that creeps is seen. Where it has moved by half a taxel, the picture is taken anew.

use super::component::Component;
use super::flow::{Flow, Pictures};
use super::slopes::SIDE;
use crate::condition::Image;
use crate::garment::{Area, Rect};

/// Way in 2^-16 taxel along x and y.
pub(super) type Way = [i32; 2];

/// Smallest contact whose pattern is looked at: a square of ten has six by six taxels that are clear of its
/// outline. With less, a wave of pressure is not told from a slope.
const LEAST_AREA: u16 = 100;
const LEAST_INNER: u32 = 36;
/// Frames for which a contact without a pattern is left alone.
const PAUSE: u8 = 8;
/// Pictures in a row that need not fit before that.
const PATIENCE: u8 = 3;
/// Displacement from which the picture is taken anew: half a taxel.
const FAR: i32 = 1 << 15;

/// A row in which nothing touches.
const NOTHING: [u16; SIDE] = [0; SIDE];

/// A picture of the middle of a contact.
#[derive(Debug, Clone)]
pub(super) struct Pattern {
    anchor: [[u16; SIDE]; SIDE],
    /// Columns of each row that are looked at: two taxels clear of the contact's outline.
    inner: [u16; SIDE],
    /// Where the picture was taken.
    window: Rect,
    /// Sum and peak of the contact when it was taken; none: there is no picture.
    taken: Option<(u32, u16)>,
    /// Way since then.
    moved: Way,
    /// Last step.
    step: Way,
    pause: u8,
    /// Pictures in a row that did not fit.
    lost: u8,
}

impl Pattern {
    pub const fn new() -> Self {
        Pattern {
            anchor: [[0; SIDE]; SIDE],
            inner: [0; SIDE],
            window: Rect { panel: 0, top: 0, bottom: 0, left: 0, right: 0 },
            taken: None,
            moved: [0; 2],
            step: [0; 2],
            pause: 0,
            lost: 0,
        }
    }

    /// There is nothing to compare the next frame with.
    pub fn forget(&mut self) {
        self.taken = None;
        self.pause = 0;
        self.lost = 0;
        self.step = [0; 2];
    }

    /// The step of the pattern since the last frame where there is one, else `step`, that of the contact's
    /// centroid.
    pub fn follow(&mut self, component: &Component, area: &Area, image: &Image, low: u16, step: Way) -> Way {
        if self.pause > 0 {
            self.pause -= 1;
            self.step = step;
            return step;
        }
        let flow = self.compare(component, area, image, step);
        if let Some(Flow::Moved(moved)) = flow {
            self.step = [moved[0] - self.moved[0], moved[1] - self.moved[1]];
            (self.moved, self.lost) = (moved, 0);
            if moved.iter().any(|way| way.abs() > FAR) {
                self.take(component, area, image, low);
            }
            return self.step;
        }
        self.lost = if flow.is_some() { self.lost + 1 } else { 0 };
        if flow == Some(Flow::Flat) || self.lost > PATIENCE {
            (self.taken, self.pause, self.lost) = (None, PAUSE, 0);
        } else {
            self.take(component, area, image, low);
        }
        if self.lost != 1 {
            // Once it may have been the picture; then it was the prediction.
            self.step = step;
        }
        step
    }

    /// The way since the picture was taken; none if there is no picture, or the contact is not what it was:
    /// more pressure makes the pattern higher, which is not to be taken for a way.
    fn compare(&self, component: &Component, area: &Area, image: &Image, step: Way) -> Option<Flow> {
        let (total, peak) = self.taken?;
        let same =
            total.abs_diff(component.total) <= total / 16 && self.window.panel == component.bounds.panel;
        let window = &self.window;
        if !same {
            return None;
        }
        let sum = |step: Way| [self.moved[0].saturating_add(step[0]), self.moved[1].saturating_add(step[1])];
        // It goes on as before, unless all of the contact has gone farther than the comparison reaches.
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
            before: &self.anchor,
            now,
            rows: rows.into(),
            columns,
            inner: &self.inner,
            peak: peak.max(component.peak),
        };
        let shift = [x << 16, y << 16];
        let expected = [outline[0].saturating_sub(shift[0]), outline[1].saturating_sub(shift[1])];
        Some(match Flow::of(&pictures, expected) {
            Flow::Moved(rest) => Flow::Moved([shift[0] + rest[0], shift[1] + rest[1]]),
            other => other,
        })
    }

    /// Takes the picture.
    fn take(&mut self, component: &Component, area: &Area, image: &Image, low: u16) {
        self.taken = None;
        self.moved = [0; 2];
        if component.area < LEAST_AREA {
            return;
        }
        let bounds = &component.bounds;
        let (left, right) = middle(component.x.0, bounds.left, bounds.right);
        let (top, bottom) = middle(component.y.0, bounds.top, bounds.bottom);
        self.window = Rect { panel: bounds.panel, top, bottom, left, right };
        for (anchor, row) in self.anchor.iter_mut().zip(top..=bottom) {
            let row = image.row(area, row).get(usize::from(left)..=usize::from(right)).unwrap_or(&[]);
            anchor.iter_mut().zip(row).for_each(|(kept, value)| *kept = *value);
        }
        // Rows of the picture and one on each side, and so its columns: bit 0 is the column before the first.
        let mut held = [0u16; SIDE + 2];
        for (held, row) in held.iter_mut().zip(top..=bottom.saturating_add(2)) {
            let row = row.checked_sub(1).map_or(&[][..], |row| image.row(area, row));
            let start = usize::from(left.saturating_sub(1));
            let first = u16::from(left == 0);
            for (bit, value) in (first..SIDE as u16 + 2).zip(row.get(start..).unwrap_or(&[])) {
                *held |= u16::from(*value >= low) << bit;
            }
        }
        let columns = (1u16 << (right - left).min(SIDE as u16 - 1)) - 1;
        let once = eroded(&held);
        self.inner = [0; SIDE];
        let mut count = 0;
        let twice = eroded(&once);
        let rows = self.inner.iter_mut().zip(twice.iter().skip(1)).zip(top..bottom);
        for (number, ((inner, row), _)) in rows.enumerate().skip(1) {
            // Not the border of the picture.
            let clear = row >> 1 & columns & !1;
            count += clear.count_ones();
            // Every other row: each is smoothed with its neighbours, so that the rest adds cost, not knowledge.
            *inner = if number % 2 == 1 { clear } else { 0 };
        }
        if count >= LEAST_INNER {
            self.taken = Some((component.total, component.peak));
        } else {
            self.pause = PAUSE;
        }
    }
}

/// Some columns of an image.
struct Cut<'a> {
    image: &'a Image<'a>,
    area: &'a Area,
    left: usize,
    columns: usize,
}

impl<'a> Cut<'a> {
    /// Those of a row; none where the panel has none.
    #[inline(never)] // the few registers of an M0+ are for this
    fn row(&self, row: u16) -> &'a [u16] {
        // A row in which nothing touches is not in the image.
        let row = self.image.row(self.area, row).get(self.left..).unwrap_or(&NOTHING);
        row.get(..self.columns).unwrap_or(&[])
    }
}

/// At most [`SIDE`] of the places `first ..= last`, around `centre` (in 2^-16).
fn middle(centre: i32, first: u16, last: u16) -> (u16, u16) {
    let side = SIDE as u16 - 1;
    if last.saturating_sub(first) <= side {
        return (first, last.max(first));
    }
    let centre = ((centre >> 16).max(0) as u16).saturating_sub(side / 2);
    let start = centre.min(last - side).max(first);
    (start, start + side)
}

/// The taxels whose eight neighbours are in the set too.
fn eroded<const ROWS: usize>(rows: &[u16; ROWS]) -> [u16; ROWS] {
    let mut inner = [0; ROWS];
    for (inner, rows) in inner.iter_mut().skip(1).zip(rows.windows(3)) {
        let all = rows.iter().fold(u16::MAX, |all, row| all & row);
        *inner = all & all << 1 & all >> 1;
    }
    inner
}
