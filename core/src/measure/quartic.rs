//! Moments of the fourth order about the centroid, which distinguish corners from round ends.
//!
//! Moments of the second order cannot distinguish a rectangle from the ellipse with the same axes. Those of the
//! fourth order can: they weigh what is far from the centroid, and how it lies around it. Taken as complex
//! moments, with z = x + iy from the centroid, their lengths do not change when the contact turns, so that no
//! direction has to be known.

use super::component::Component;
use super::frame_view::FrameView;
use super::ratios::{PRODUCT, Ratios};
use crate::format::Fixed16;
use crate::garment::Area;
use crate::segment::run::Run;

/// Ratios of the fourth order in 1/512, with r^2 = x^2 + y^2 and J = sum r^2 f; all 0 for a contact that was
/// not measured. They depend neither on pressure and size nor on place and direction.
///
/// J and sum r^4 f count the width of the taxels themselves. Of a contact of more than 400 taxels in at least
/// 24 rows, every second row is taken. A contact that crosses a seam is not measured: together with its
/// contour it would cost more than a frame has left. Nor is one that has more than seven groups of taxels in a
/// run, which is none of the shapes that this distinguishes.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Quartic {
    /// `m sum r^4 f / J^2`: 4/3 for a disc of even pressure, 7/5 for a square, 1 for a ring
    pub kurtosis: i16,
    /// `m abs(sum z^2 r^2 f) / J^2`: 0 for a disc or square, 9/5 for a line
    pub two: i16,
    /// `m abs(sum z^4 f) / J^2`: 0 for a disc, 3/5 for a square, 9/5 for a line
    pub four: i16,
}

/// Most groups of taxels of a run.
const GROUPS: u32 = 7;

/// Number of groups of taxels side by side.
fn groups(run: &Run) -> u32 {
    if run.right - run.left < run.area {
        return 1;
    }
    let taxels = run.rebased();
    (taxels & !(taxels << 1)).count_ones()
}

/// Bits of a coordinate without its sign.
const COORDINATE: u32 = 10;

/// Bits that are cut from a square.
const SQUARE: u32 = 8;

/// Half of what is cut from a product.
const HALF: u32 = 1 << (PRODUCT - 1);

/// Conversion of taxels into coordinates from the centroid, in units that the contact's extent fills, and of
/// their pressure into few bits.
///
/// About the centroid, the mean of x^4 is at most 1/12 of the fourth power of the extent. With a mass below
/// 2^16, all sums of a contact therefore fit in 32 bits.
struct View<'a> {
    values: &'a [u16],
    /// The panel's first taxel, its first row and its columns.
    base: u16,
    first_row: u16,
    columns: u16,
    /// Rows from one that is taken to the next, less one; a mask.
    skipped: u16,
    /// The centroid, in the panel's coordinates.
    x: Fixed16,
    y: Fixed16,
    /// Bits of a place (16 fraction bits) that are cut.
    cut: u32,
    /// Units from a taxel to the next.
    step: i32,
    /// Bits of the pressure that are cut.
    down: u32,
    /// Variance of a taxel, along x and y together, in the units of a square.
    pixel: u32,
}

impl<'a> View<'a> {
    fn of(component: &Component, area: &Area, values: &'a [u16]) -> View<'a> {
        let bounds = &component.bounds;
        let (width, height) =
            (bounds.right.saturating_sub(bounds.left), bounds.bottom.saturating_sub(bounds.top));
        let bits = 32 - u32::from(width | height).leading_zeros();
        // An extent of more than 1,024 taxels takes more bits, so that the mass must have less.
        let (fine, beyond) = (COORDINATE.saturating_sub(bits), bits.saturating_sub(COORDINATE));
        let skipped = u16::from(component.area > 400 && height >= 23);
        // (1 + stride^2) / 12
        let taxel = if skipped == 0 { 2 * 5461 } else { 5 * 5461 };
        View {
            values,
            base: area.base,
            first_row: area.first_row,
            columns: area.columns,
            skipped,
            x: component.x,
            y: component.y,
            cut: 16 - fine,
            step: 1 << fine,
            down: (16 + 4 * beyond).saturating_sub(component.total.leading_zeros()),
            pixel: (((1 << fine << fine) >> 6) * taxel + (1 << 17)) >> 18,
        }
    }

    /// Coordinate of a column or row whose distance from the panel's first is `place`.
    #[inline(always)]
    fn at(&self, place: u16, centre: Fixed16) -> i32 {
        (i32::from(place) << 16).wrapping_sub(centre.0) >> self.cut
    }
}

/// Sums over taxels side by side, of a pressure times a power of x.
#[derive(Default, Clone, Copy)]
struct RowSums {
    /// sum a f, with a = x^2 / 2^8
    second: u32,
    /// sum x a f / 2^8
    third: i32,
    /// sum a^2 f / 2^8
    fourth: u32,
}

impl RowSums {
    /// Sums over values, the first of them at x.
    #[inline(always)]
    fn of(values: &[u16], mut x: i32, view: &View<'_>) -> RowSums {
        let RowSums { mut second, mut third, mut fourth } = RowSums::default();
        let (step, down) = (view.step, view.down);
        for value in values {
            let f = u32::from(*value).wrapping_shr(down);
            let a = (x.wrapping_mul(x) as u32) >> SQUARE;
            let weight = f.wrapping_mul(a);
            second = second.wrapping_add(weight);
            let weight = weight.wrapping_add(HALF) >> PRODUCT;
            third = third.wrapping_add((weight as i32).wrapping_mul(x));
            fourth = fourth.wrapping_add(weight.wrapping_mul(a));
            x = x.wrapping_add(step);
        }
        RowSums { second, third, fourth }
    }

    /// Sums over the values whose bit is set, group by group.
    #[cold]
    #[inline(never)]
    fn of_groups(mut taxels: u32, values: &[u16], x: i32, view: &View<'_>) -> RowSums {
        let mut sums = RowSums::default();
        while taxels != 0 {
            let first = taxels.trailing_zeros();
            let length = (taxels >> first).trailing_ones();
            let group = values.get(first as usize..(first + length) as usize).unwrap_or(&[]);
            let more = RowSums::of(group, x.wrapping_add(view.step.wrapping_mul(first as i32)), view);
            sums.second = sums.second.wrapping_add(more.second);
            sums.third = sums.third.wrapping_add(more.third);
            sums.fourth = sums.fourth.wrapping_add(more.fourth);
            // The lowest group is carried out by adding its lowest bit.
            taxels &= taxels.wrapping_add(1 << first);
        }
        sums
    }
}

/// Sums over a contact, with a = x^2 / 2^8 and b = y^2 / 2^8.
#[derive(Default)]
struct QuarticSums {
    /// sum f
    m: u32,
    /// sum (a + b) f
    j: u32,
    /// sum a^2 f / 2^8, and so on
    xxxx: u32,
    xxyy: u32,
    yyyy: u32,
    /// sum a x y f / 2^16
    xxxy: i32,
    /// sum b x y f / 2^16
    xyyy: i32,
}

impl QuarticSums {
    /// Adds a run.
    #[inline(never)] // M0+: out of line
    fn add(&mut self, run: &Run, view: &View<'_>) {
        let row = run.row - view.first_row;
        let (x, y) = (view.at(run.left, view.x), view.at(row, view.y));
        // One comparison: sums of 17 bits and a few cannot overflow.
        let from = usize::from(view.base + row * view.columns) + usize::from(run.left);
        let length = usize::from(run.right - run.left) + 1;
        let values = view.values.get(from..from + length).unwrap_or(&[]);
        let RowSums { second, third, fourth } = if length == usize::from(run.area) {
            RowSums::of(values, x, view)
        } else {
            RowSums::of_groups(run.rebased(), values, x, view)
        };
        let b = (y.wrapping_mul(y) as u32) >> SQUARE;
        let m = run.sums.s0.wrapping_shr(view.down);
        let beyond = run.sums.s1.wrapping_sub(run.sums.s0).wrapping_shr(view.down);
        let first = x.wrapping_mul(m as i32).wrapping_add(view.step.wrapping_mul(beyond as i32));
        let mb = m.wrapping_mul(b);
        let xb = (first >> 7).wrapping_mul(b as i32) >> (PRODUCT - 7);
        self.m = self.m.wrapping_add(m);
        self.j = self.j.wrapping_add(second).wrapping_add(mb);
        self.xxxx = self.xxxx.wrapping_add(fourth);
        self.xxyy = self.xxyy.wrapping_add((second >> PRODUCT).wrapping_mul(b));
        self.yyyy = self.yyyy.wrapping_add((mb.wrapping_add(HALF) >> PRODUCT).wrapping_mul(b));
        self.xxxy = self.xxxy.wrapping_add((third >> SQUARE).wrapping_mul(y));
        self.xyyy = self.xyyy.wrapping_add((xb >> SQUARE).wrapping_mul(y));
    }

    fn quartic(&self, pixel: u32) -> Quartic {
        let QuarticSums { m, j, xxxx, xxyy, yyyy, xxxy, xyyy } = *self;
        let own = pixel.wrapping_mul(m);
        let inertia = j.wrapping_add(own);
        // sum (r^2 + pixel)^2 f
        let more = pixel.wrapping_mul((j >> PRODUCT).wrapping_mul(2).wrapping_add(own >> PRODUCT));
        let r4 = xxxx.wrapping_add(xxyy.wrapping_mul(2)).wrapping_add(yyyy).wrapping_add(more);
        // z^2 r^2 = x^4 - y^4 + 2i (x^3 y + x y^3), z^4 = x^4 + y^4 - 6 x^2 y^2 + 4i (x^3 y - x y^3)
        let two = [xxxx.wrapping_sub(yyyy), (xxxy.wrapping_add(xyyy) as u32).wrapping_mul(2)];
        let even = xxxx.wrapping_add(yyyy).wrapping_sub(xxyy.wrapping_mul(6));
        let four = [even, (xxxy.wrapping_sub(xyyy) as u32).wrapping_mul(4)];
        let ratios = Ratios::of(m, inertia, r4);
        let [two, four] = [two, four].map(|sum| ratios.of_vector(sum));
        Quartic { kurtosis: ratios.of_sum(r4), two, four }
    }
}

impl Quartic {
    /// Measures contact number `index`, which continues as `component`.
    #[inline(never)] // own frame: locals stay within short SP offsets
    pub(super) fn of<const RUNS: usize, const LABELS: usize>(
        index: u16,
        component: &Component,
        frame: &FrameView<'_, RUNS, LABELS>,
    ) -> Quartic {
        let area = frame.layout.areas().get(usize::from(component.bounds.panel));
        let Some(area) = area.filter(|_| !component.joined) else { return Quartic::default() };
        let (view, mut sums) = (View::of(component, area, frame.image.values), QuarticSums::default());
        for (_, run) in component.runs(frame.labeller, frame.layout) {
            let label = frame.labeller.labels.get(usize::from(run.label));
            if label.is_none_or(|label| label.contact != index) || run.row & view.skipped != 0 {
                continue;
            }
            if groups(run) > GROUPS {
                return Quartic::default();
            }
            sums.add(run, &view);
        }
        sums.quartic(view.pixel)
    }
}
