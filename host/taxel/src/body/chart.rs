//! Points of a link in the coordinates of a patch: its surface, unrolled.

use super::config::Patch;
use super::form::{Axes, Cone, Laid};
use super::rigid::Rigid;
use super::surface::Surface;
use super::taxel_place::TaxelPlace;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;
use taxel_core::garment::{Area, Layout};

/// A point of a patch's surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Charted {
    /// Distance from the middle of the patch, m, along the surface: to the right and down.
    pub at: DVec2,
    /// Height above the surface, m.
    pub height: f64,
}

/// The surface of a patch as a map: where points of the panel are in it, and where points of the link.
#[derive(Debug)]
pub(super) struct Chart<'a> {
    sheet: Sheet<'a>,
    area: &'a Area,
    /// The patch's own turn, rad.
    turn: f64,
}

#[derive(Debug)]
enum Sheet<'a> {
    /// A surface by its formula.
    Form(Laid<'a>),
    /// Measured points, in the plane that touches them.
    Points(Rigid, &'a Surface, &'a Layout, u8),
}

impl<'a> Chart<'a> {
    /// The chart of a patch on a surface that was built of it with no offsets. None if the
    /// measured points have no plane that touches them.
    pub fn of(patch: &'a Patch, still: &'a Surface, layout: &'a Layout, panel: u8) -> Option<Chart<'a>> {
        let area = layout.areas().get(usize::from(panel))?;
        let sheet = match Laid::new(&patch.on).ok()? {
            Some(Laid::Grid(_)) | None => Sheet::Points(Rigid::of(&still.panel(area))?, still, layout, panel),
            Some(laid) => Sheet::Form(laid),
        };
        Some(Chart { sheet, area, turn: patch.turn.to_radians() })
    }

    /// A point between taxels: `(x, y)` in taxels of the panel. None where there are no taxels.
    pub fn touched(&self, x: f64, y: f64) -> Option<Charted> {
        match &self.sheet {
            Sheet::Form(_) => {
                let area = self.area;
                let pitch = DVec2::from(area.pitch_um.map(|um| f64::from(um) * 1e-6));
                let last = DVec2::new(f64::from(area.columns - 1), f64::from(area.rows - 1));
                let from_middle = (DVec2::new(x, y) - last / 2.0) * pitch;
                Some(Charted { at: DVec2::from_angle(self.turn).rotate(from_middle), height: 0.0 })
            }
            Sheet::Points(rigid, still, layout, panel) => {
                let TaxelPlace { at, .. } = still.at(layout, *panel, x, y)?;
                let (at, height) = rigid.flat(at);
                Some(Charted { at, height })
            }
        }
    }

    /// A point of the link, m: once, or as often as one comes to it around an axis.
    pub fn point(&self, at: DVec3) -> Vec<Charted> {
        let (axes, from, cone) = match &self.sheet {
            Sheet::Points(rigid, ..) => {
                let (at, height) = rigid.flat(at);
                return vec![Charted { at, height }];
            }
            Sheet::Form(Laid::Plane(plane, axes)) => {
                let from = at - plane.at;
                let flat = DVec2::new(from.dot(axes.right), from.dot(axes.down));
                return vec![Charted { at: flat, height: from.dot(axes.out) }];
            }
            Sheet::Form(Laid::Cylinder(cylinder, axes)) => {
                let (along, away, around) = round(axes, at - cylinder.at);
                let turns = [around, around + TAU, around - TAU];
                let height = away - cylinder.radius;
                let at = |around: f64| Charted { at: DVec2::new(cylinder.radius * around, along), height };
                return turns.map(at).to_vec();
            }
            Sheet::Form(Laid::Cone(cone, axes)) => (axes, at - cone.at, *cone),
            // `of` makes points of it.
            Sheet::Form(Laid::Grid(_)) => return Vec::new(),
        };
        let (along, away, around) = round(axes, from);
        unrolled(cone, along, away, around)
    }
}

/// A point around an axis: its length along it, its distance from it, and its angle about it.
fn round(axes: &Axes, from: DVec3) -> (f64, f64, f64) {
    let (side, front) = (from.dot(axes.right), from.dot(axes.out));
    (from.dot(axes.down), side.hypot(front), side.atan2(front))
}

/// Unrolls a cone into a sector about its apex: the inverse of [`Cone::spot`].
fn unrolled(cone: &Cone, along: f64, away: f64, around: f64) -> Vec<Charted> {
    let (sin, cos) = cone.angle.to_radians().sin_cos();
    let apex = cone.radius / sin;
    let (way, height) = {
        let out = away - cone.radius;
        (along * cos - out * sin, along * sin + out * cos)
    };
    let to_apex = (apex - way) * sin.signum();
    if to_apex <= 0.0 {
        return Vec::new();
    }
    let at = |around: f64| {
        let (side, front) = (around * sin.abs()).sin_cos();
        Charted { at: DVec2::new(to_apex * side, apex - sin.signum() * to_apex * front), height }
    };
    [around, around + TAU, around - TAU].map(at).to_vec()
}
