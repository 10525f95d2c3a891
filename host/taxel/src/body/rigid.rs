//! Measured points that move as one rigid piece.

use super::config::PatchOffset;
use super::form::Axes;
use super::taxel_place::TaxelPlace;
use glam::{DQuat, DVec2, DVec3};

/// Least length of the mean of the normals: of taxels all around a link it is 0.
const ONE_SIDE: f64 = 0.2;

/// The plane that touches the taxels of a panel at their middle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rigid {
    pub middle: DVec3,
    pub axes: Axes,
}

impl Rigid {
    /// The plane of taxels in rows; none if they lie all around the link, or on one line.
    pub fn of(rows: &[Vec<Option<TaxelPlace>>]) -> Option<Rigid> {
        let every = || {
            let row = |(row, places): (usize, &'_ Vec<Option<TaxelPlace>>)| {
                let of = move |place: &Option<TaxelPlace>| place.map(|place| (row as f64, place));
                places.iter().filter_map(of).collect::<Vec<_>>()
            };
            rows.iter().enumerate().flat_map(row)
        };
        let count = every().count().max(1) as f64;
        let middle = every().map(|(_, place)| place.at).sum::<DVec3>() / count;
        let normal = every().map(|(_, place)| place.normal).sum::<DVec3>() / count;
        let row = every().map(|(row, _)| row).sum::<f64>() / count;
        let down = every().map(|(at, place)| (place.at - middle) * (at - row)).sum::<DVec3>();
        let is_one_side = normal.length() >= ONE_SIDE;
        Some(Rigid { middle, axes: is_one_side.then(|| Axes::new(down, normal)).flatten()? })
    }

    /// A point in the plane, m to the right and down from the middle, and its height above the plane.
    pub fn flat(&self, at: DVec3) -> (DVec2, f64) {
        let Axes { right, down, out } = self.axes;
        let from = at - self.middle;
        (DVec2::new(from.dot(right), from.dot(down)), from.dot(out))
    }

    /// A taxel, turned about the middle and shifted in the plane.
    pub fn moved(&self, place: &TaxelPlace, offset: &PatchOffset) -> TaxelPlace {
        let Axes { right, down, out } = self.axes;
        // Clockwise as seen from outside is against the sense about the normal.
        let turn = DQuat::from_axis_angle(out, -offset.radians());
        let shift = right * offset.right + down * offset.down;
        let at = self.middle + turn * (place.at - self.middle) + shift;
        TaxelPlace { at, normal: turn * place.normal, ..*place }
    }
}
