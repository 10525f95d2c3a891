//! Computes forces of images by a calibration.

use super::curve::{Curve, PARTS};
use super::file::Calibration;
use crate::error::{Result, SettingError};
use taxel_core::garment::{Layout, Place, Rect};

/// Curves of a garment's panels.
#[derive(Debug, Clone)]
pub struct Forces {
    curves: Vec<Option<Curve>>,
}

impl Forces {
    /// Forces by a calibration for this garment. Error if it is for another garment.
    pub fn new(calibration: &Calibration, layout: &Layout) -> Result<Forces> {
        require!(
            calibration.gains.len() == layout.taxels(),
            SettingError::Calibration,
            "the calibration {} is of a garment of {} taxels, this one has {}",
            calibration.id,
            calibration.gains.len(),
            layout.taxels()
        );
        let curve = |name: &str| calibration.panels.iter().find(|p| p.name == name).map(|p| p.knots.clone());
        Ok(Forces { curves: layout.areas().iter().map(|area| curve(area.name.as_str())).collect() })
    }

    /// Force on a taxel of a panel at these counts, N; none if the panel is not calibrated.
    pub fn taxel(&self, panel: usize, counts: u16) -> Option<f64> {
        let curve = self.curves.get(panel)?.as_ref()?;
        Some(curve.micronewtons(u32::from(counts) * PARTS) as f64 / 1e6)
    }

    /// Force on the taxels of a rectangle, N, from an image by taxel number (counts); none if the panel is
    /// not calibrated.
    pub fn within(&self, layout: &Layout, image: &[u16], bounds: &Rect) -> Option<f64> {
        let curve = self.curves.get(usize::from(bounds.panel))?.as_ref()?;
        let mut sum = 0;
        for row in bounds.top..=bounds.bottom {
            for column in bounds.left..=bounds.right {
                let taxel = layout.taxel(Place { panel: bounds.panel, row, column });
                let value = taxel.and_then(|taxel| image.get(taxel)).copied().unwrap_or(0);
                sum += curve.micronewtons(u32::from(value) * PARTS);
            }
        }
        Some(sum as f64 / 1e6)
    }

    /// Force of a contact with these bounds, N. Their surroundings are included, because a contact continues
    /// below its threshold.
    pub fn contact(&self, layout: &Layout, image: &[u16], bounds: &Rect) -> Option<f64> {
        let area = layout.areas().get(usize::from(bounds.panel))?;
        let wider = Rect {
            panel: bounds.panel,
            top: bounds.top.saturating_sub(1),
            bottom: (bounds.bottom + 1).min(area.rows.saturating_sub(1)),
            left: bounds.left.saturating_sub(1),
            right: (bounds.right + 1).min(area.columns.saturating_sub(1)),
        };
        self.within(layout, image, &wider)
    }

    /// Force on each panel, N; none for panels that are not calibrated.
    pub fn panels(&self, layout: &Layout, image: &[u16]) -> Vec<Option<f64>> {
        let whole = |(panel, area): (u8, &taxel_core::garment::Area)| Rect {
            panel,
            top: 0,
            bottom: area.rows.saturating_sub(1),
            left: 0,
            right: area.columns.saturating_sub(1),
        };
        (0..).zip(layout.areas()).map(whole).map(|bounds| self.within(layout, image, &bounds)).collect()
    }
}
