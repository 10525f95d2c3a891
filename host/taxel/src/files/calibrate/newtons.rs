//! Newtons of a board's pressure.

use super::basis::ForceBasis;
use super::force::Forces;
use taxel_core::contact::Contact;
use taxel_core::garment::{Area, Layout, Place, Rect};

/// Newtons of a board's pressure now.
#[derive(Debug, Clone)]
pub struct Newtons {
    /// Curves of the calibration in force.
    forces: Option<Forces>,
    /// Counts per newton.
    straight: Option<f64>,
    basis: Option<ForceBasis>,
}

impl Newtons {
    /// Newtons by curves, else by counts per newton, on this basis.
    pub(super) fn new(
        forces: Option<Forces>,
        counts_per_newton: Option<f32>,
        basis: Option<ForceBasis>,
    ) -> Newtons {
        Newtons { forces, straight: counts_per_newton.map(f64::from), basis }
    }

    /// The basis of these forces; none if they are unknown.
    pub fn basis(&self) -> Option<ForceBasis> {
        self.basis
    }

    /// Counts per newton, for sums over taxels of any panel: with a calibration, the mean over its panels.
    pub fn counts_per_newton(&self) -> Option<f64> {
        self.straight
    }

    /// Force on a taxel of a panel at these counts, N; none if it is unknown.
    pub fn taxel(&self, panel: usize, counts: u16) -> Option<f64> {
        match &self.forces {
            Some(forces) => forces.taxel(panel, counts),
            None => self.straight.map(|scale| f64::from(counts) / scale),
        }
    }

    /// Normal force of a contact, N: its total times [`Newtons::per_count`]; none if it is unknown.
    pub fn contact(&self, layout: &Layout, image: &[u16], low: u16, contact: &Contact) -> Option<f64> {
        let total = f64::from(contact.total);
        match self.forces {
            Some(_) if contact.total == 0 => Some(0.0),
            Some(_) => Some(total * self.per_count(layout, image, low, &contact.bounds)?),
            None => self.straight.map(|counts| total / counts),
        }
    }

    /// Newtons per count of the totals of contacts in a box; none if it is unknown. By the curves of a calibration:
    /// the force on the box's taxels and those around it in an image (counts by taxel) for the counts of those that
    /// reach `low`, as a contact's total counts them.
    pub fn per_count(&self, layout: &Layout, image: &[u16], low: u16, bounds: &Rect) -> Option<f64> {
        let Some(forces) = &self.forces else { return self.straight.map(|counts| 1.0 / counts) };
        let newtons = forces.contact(layout, image, bounds)?;
        let places = (bounds.top..=bounds.bottom).flat_map(|row| {
            (bounds.left..=bounds.right).map(move |column| Place { panel: bounds.panel, row, column })
        });
        let values = places.filter_map(|place| image.get(layout.taxel(place)?).copied());
        let counts: u32 = values.filter(|value| *value >= low).map(u32::from).sum();
        (counts > 0).then(|| newtons / f64::from(counts))
    }

    /// Force on each panel of an image, N; none where a panel has none. None if forces are unknown.
    pub fn panels(&self, layout: &Layout, image: &[u16]) -> Option<Vec<Option<f64>>> {
        if let Some(forces) = &self.forces {
            return Some(forces.panels(layout, image));
        }
        let counts = self.straight?;
        let sum = |values: &[u16]| values.iter().map(|value| f64::from(*value)).sum::<f64>() / counts;
        let panel = |area: &Area| {
            let start = usize::from(area.base);
            image.get(start..start + usize::from(area.rows) * usize::from(area.columns)).map(sum)
        };
        Some(layout.areas().iter().map(panel).collect())
    }
}
