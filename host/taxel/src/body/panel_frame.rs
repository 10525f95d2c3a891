//! The frame of a panel on the link that it lies on.

use super::form::Axes;
use super::pose::Pose;
use super::rigid::Rigid;
use super::surface::Surface;
use glam::{DMat3, DQuat, DVec3};
use taxel_core::garment::{Area, Layout};

/// Half a taxel.
const HALF: f64 = 0.5;

impl Surface {
    /// Frame of a panel, and the index of its link: the panel as if it were flat, in the plane that touches it at its
    /// middle. The origin is the panel's first taxel, x runs along the columns, y along the rows, and z into the
    /// robot, as of a camera that looks at it. None without a patch, and for a panel of a single taxel.
    pub(crate) fn panel_frame(&self, layout: &Layout, panel: u8) -> Option<(usize, Pose)> {
        let area = layout.areas().get(usize::from(panel))?;
        let link = self.panel(area).into_iter().flatten().flatten().next()?.link;
        // Where the middle has no taxel, the plane of those that there are.
        let plane = self.touching(layout, panel, area).or_else(|| Rigid::of(&self.panel(area)))?;
        let Axes { right, down, out } = plane.axes;
        let half = |count: u16, pitch_um: u32| HALF * f64::from(count - 1) * f64::from(pitch_um) * 1e-6;
        let [x_um, y_um] = area.pitch_um;
        let at = plane.middle - right * half(area.columns, x_um) - down * half(area.rows, y_um);
        let turn = DQuat::from_mat3(&DMat3::from_cols(right, down, -out));
        Some((link, Pose { at, turn }))
    }

    /// The plane that touches a panel at its middle.
    fn touching(&self, layout: &Layout, panel: u8, area: &Area) -> Option<Rigid> {
        let [x, y] = [area.columns, area.rows].map(|count| HALF * f64::from(count - 1));
        let middle = self.at(layout, panel, x, y)?;
        let along = |dx: f64, dy: f64| -> Option<DVec3> {
            let ends = [-HALF, HALF].map(|step| self.at(layout, panel, x + step * dx, y + step * dy));
            Some(ends[1]?.at - ends[0]?.at)
        };
        // A single row has no direction of its own.
        let down = if area.rows > 1 { along(0.0, 1.0)? } else { along(1.0, 0.0)?.cross(middle.normal) };
        Some(Rigid { middle: middle.at, axes: Axes::new(down, middle.normal)? })
    }
}
