//! Distances between points of panels, over the shortest seam.

use crate::format::Fixed16;
use crate::garment::{Layout, SEAMS, Transform};
use heapless::Vec;

/// Longest distance along an axis, 2047 taxels in 1/16 taxel: two squares fit in 32 bits.
pub(crate) const LONGEST: i32 = 32767;

/// A point of a panel in 1/16 taxel: fine enough to compare distances, and in 32 bits.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PanelPoint {
    pub panel: u8,
    pub x: i32,
    pub y: i32,
}

impl PanelPoint {
    /// Point with coordinates in Q16.
    pub fn of(panel: u8, x: Fixed16, y: Fixed16) -> PanelPoint {
        PanelPoint { panel, x: x.0 >> 12, y: y.0 >> 12 }
    }

    /// Lists the point, and its images on the panels beyond every seam.
    pub fn list_images(self, layout: &Layout, images: &mut PointImages) {
        images.clear();
        let mut add = |panel, (x, y)| {
            let _ = images.push(PanelPoint { panel, x, y });
        };
        add(self.panel, (self.x, self.y));
        for joint in layout.joints() {
            if joint.b == self.panel {
                add(joint.a, self.through(&joint.b_to_a));
            }
            if joint.a == self.panel {
                add(joint.b, self.through(&joint.b_to_a.inverse()));
            }
        }
    }

    fn through(self, way: &Transform) -> (i32, i32) {
        // Like `Transform::apply`, in 32 bits: coordinates and shifts are below 2^20.
        (way.xx * self.x + way.xy * self.y + way.dx * 16, way.yx * self.x + way.yy * self.y + way.dy * 16)
    }
}

/// A point, and its images on the panels that seams join to its own.
pub(crate) type PointImages = Vec<PanelPoint, { 1 + 2 * SEAMS }>;

/// Returns the transform between two panels (none within one panel, else over one seam) that brings `from`
/// closest to `to`, and the squared distance that is left.
pub(crate) fn nearest_way(
    layout: &Layout,
    from: PanelPoint,
    to: PanelPoint,
) -> Option<(Option<Transform>, u32)> {
    let squared = |(x, y): (i32, i32)| {
        let square = |apart: i32| (apart.clamp(-LONGEST, LONGEST).pow(2)) as u32;
        square(x - to.x) + square(y - to.y)
    };
    let mut best = (from.panel == to.panel).then(|| (None, squared((from.x, from.y))));
    let mut consider = |way: Transform| {
        let left = squared(from.through(&way));
        if best.is_none_or(|(_, least)| left < least) {
            best = Some((Some(way), left));
        }
    };
    for joint in layout.joints() {
        if (joint.b, joint.a) == (from.panel, to.panel) {
            consider(joint.b_to_a);
        }
        if (joint.a, joint.b) == (from.panel, to.panel) {
            consider(joint.b_to_a.inverse());
        }
    }
    best
}
