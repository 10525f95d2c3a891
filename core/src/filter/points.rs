//! Points: taxels that stand out from their neighbours, in this frame and in the previous one.

use crate::format::WIDE;
use crate::garment::Area;
use crate::image::rows::Rows;
use heapless::Vec;

/// Most points stored per frame, over all panels. Further ones, in the order of taxel numbers, are smoothed
/// in the next frame as if they were new. Each point may become a contact, and twice as many leave no time
/// for a frame.
pub const POINTS: usize = 24;

/// A taxel is a point if it exceeds its greatest neighbour by more than a sixteenth of it plus this many
/// counts. A smaller excess may be noise, or unevenness of the pressing object, and loses little by
/// smoothing.
pub const MARGIN: u16 = 64;

/// True if a taxel is a point, given its smoothed value.
#[inline(always)]
pub const fn stands_out(value: u16, smooth: u16) -> bool {
    let smooth = smooth as u32;
    value as u32 > smooth + (smooth >> 4) + MARGIN as u32
}

#[derive(Debug, Clone, Copy)]
struct StoredPoint {
    taxel: u16,
    value: u16,
}

/// Points of two frames, ascending by taxel number.
#[derive(Debug, Clone)]
pub(crate) struct Points {
    lists: [Vec<StoredPoint, POINTS, u8>; 2],
    /// True if the second list holds the points of this frame.
    second: bool,
    /// Number of the previous frame's points that have been compared.
    compared: u8,
}

impl Points {
    pub const fn new() -> Self {
        Points { lists: [Vec::new(), Vec::new()], second: false, compared: 0 }
    }

    /// Begins a frame: its points become those of the previous frame.
    pub fn begin(&mut self) {
        self.second = !self.second;
        self.compared = 0;
        let [first, second] = &mut self.lists;
        if self.second { second.clear() } else { first.clear() }
    }

    /// Forgets all points, so that there is no previous frame.
    pub fn forget(&mut self) {
        self.lists.iter_mut().for_each(Vec::clear);
    }

    /// Restores each point of a panel to the lesser of its values in the previous frame and in this one.
    /// `values` are unfiltered, `out` smoothed; `marks` says where they may be non-zero.
    #[inline(never)] // M0+: out of line
    pub fn restore(&mut self, values: &[u16], out: &mut [u16], area: &Area, marks: &Rows) {
        let columns = usize::from(area.columns);
        let (first, end) = (area.first_row, area.first_row.saturating_add(area.rows));
        let mut next = first;
        while let Some(number) = marks.next(next..end) {
            if self.is_done() {
                return;
            }
            next = number + 1;
            let start = usize::from(number - first) * columns;
            let row = start..start + columns;
            let (Some(values), Some(out)) = (values.get(row.clone()), out.get_mut(row)) else { return };
            if !WIDE || has_points(values, out) {
                self.restore_row(values, out, usize::from(area.base) + start);
            }
        }
    }

    /// True if no further point can be stored or restored.
    fn is_done(&self) -> bool {
        let [first, second] = &self.lists;
        let (before, now) = if self.second { (first, second) } else { (second, first) };
        now.len() == POINTS && self.compared as usize >= before.len()
    }

    #[inline(never)]
    fn restore_row(&mut self, values: &[u16], out: &mut [u16], first: usize) {
        for (taxel, (value, out)) in (first..).zip(values.iter().zip(out)) {
            // Most taxels are left as they are by smoothing.
            if value != out && stands_out(*value, *out) {
                self.restore_taxel(taxel, *value, out);
            }
        }
    }

    #[inline(never)] // M0+: leaves the registers to the search
    fn restore_taxel(&mut self, taxel: usize, value: u16, out: &mut u16) {
        *out = self.take(StoredPoint { taxel: taxel as u16, value }).max(*out);
    }

    /// Stores a point whose number is above that of the last one. Returns the lesser of its value and that in
    /// the previous frame; 0 if it was no point then.
    fn take(&mut self, point: StoredPoint) -> u16 {
        let [first, second] = &mut self.lists;
        let (before, now) = if self.second { (first, second) } else { (second, first) };
        let _ = now.push(point);
        while let Some(old) = before.get(usize::from(self.compared))
            && old.taxel <= point.taxel
        {
            self.compared += 1;
            if old.taxel == point.taxel {
                return old.value.min(point.value);
            }
        }
        0
    }
}

/// True if a row has a point. Without a branch per taxel, so that SIMD compares many at once.
fn has_points(values: &[u16], out: &[u16]) -> bool {
    values.iter().zip(out).fold(false, |any, (value, out)| any | stands_out(*value, *out))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn take(points: &mut Points, all: &[(u16, u16)]) -> [u16; 3] {
        points.begin();
        let mut had = [0; 3];
        for ((taxel, value), had) in all.iter().zip(&mut had) {
            *had = points.take(StoredPoint { taxel: *taxel, value: *value });
        }
        had
    }

    #[test]
    fn a_point_has_what_it_has_in_two_frames() {
        let mut points = Points::new();
        assert_eq!(take(&mut points, &[(3, 900), (70, 500), (2000, 4000)]), [0; 3]);
        assert_eq!(take(&mut points, &[(2, 800), (70, 700), (2000, 3000)]), [0, 500, 3000]);
        assert_eq!(take(&mut points, &[(70, 600), (71, 600)]), [600, 0, 0]);
        points.forget();
        assert_eq!(take(&mut points, &[(70, 600)]), [0; 3]);
    }

    #[test]
    fn those_that_are_too_many_are_forgotten() {
        let mut points = Points::new();
        for expected in [0, 700] {
            points.begin();
            for taxel in 0..POINTS as u16 + 1 {
                let had = points.take(StoredPoint { taxel, value: 700 });
                assert_eq!(had, if usize::from(taxel) < POINTS { expected } else { 0 });
            }
        }
    }
}
