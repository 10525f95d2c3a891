//! The checked geometry of a garment.

use super::area::{Area, Place, cell_mm2, taxels_per_cm};
use super::config::{ABSENT, Absent, Garment, PANELS, PITCH_UM, Panel, SEAMS};
use super::error::GarmentError;
use super::seam::Joint;
use crate::format::{Name, crc32};
use heapless::Vec;

/// The checked geometry: panels with their numbering, seams, regions, gaps.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct Layout {
    areas: Vec<Area, PANELS>,
    joints: Vec<Joint, SEAMS>,
    regions: Vec<Name, PANELS>,
    absent: Vec<Absent, ABSENT>,
    taxels: u16,
}

impl Layout {
    /// Checks the geometry of `garment` for a program that holds `capacity` taxels with values up to
    /// `full_scale`.
    ///
    /// Also refuses panels on which `m^2` times the variance of a contact might not fit in 64 bits:
    /// `(full_scale N)^2 (w^2 + h^2 - 2) / 12 < 2^64` for N taxels in a box of w x h. Panels that are sewn
    /// together count as one, with the box of their lengths laid end to end.
    pub fn build(garment: &Garment, capacity: usize, full_scale: u16) -> Result<Layout, GarmentError> {
        let mut layout = Layout {
            areas: Vec::new(),
            joints: Vec::new(),
            regions: Vec::new(),
            absent: garment.absent.clone(),
            taxels: 0,
        };
        if garment.name.is_empty() {
            return Err(GarmentError::NoName);
        }
        layout.number_panels(garment, capacity)?;
        for (index, gap) in garment.absent.iter().enumerate() {
            let area = layout.area_of("absent", index, gap.panel)?;
            let fits = gap.rows > 0
                && gap.columns > 0
                && u32::from(gap.row) + u32::from(gap.rows) <= u32::from(area.rows)
                && u32::from(gap.column) + u32::from(gap.columns) <= u32::from(area.columns);
            if !fits {
                return Err(GarmentError::OutsidePanel { what: "absent", index, panel: area.name.clone() });
            }
        }
        for (index, seam) in garment.seams.iter().enumerate() {
            let a = layout.area_of("seam", index, seam.a.panel)?;
            let b = layout.area_of("seam", index, seam.b.panel)?;
            let joint = Joint::build(index, seam, a, b)?;
            // The list has the same capacity as the garment's.
            let _ = layout.joints.push(joint);
        }
        layout.check_exact(full_scale)?;
        Ok(layout)
    }

    fn number_panels(&mut self, garment: &Garment, capacity: usize) -> Result<(), GarmentError> {
        if garment.panels.is_empty() {
            return Err(GarmentError::Empty);
        }
        let capacity = capacity.min(usize::from(u16::MAX)) as u32;
        let taxels = garment.panels.iter().map(|p| u32::from(p.rows) * u32::from(p.columns));
        let total = taxels.fold(0u32, u32::saturating_add);
        if total > capacity {
            return Err(GarmentError::TooLarge { taxels: total, capacity });
        }
        let mut first_row = 0;
        for (index, panel) in garment.panels.iter().enumerate() {
            check_panel(index, panel)?;
            if panel.rows == 0 || panel.columns == 0 {
                return Err(GarmentError::EmptyPanel(panel.name.clone()));
            }
            if self.areas.iter().any(|a| a.name == panel.name) {
                return Err(GarmentError::DuplicatePanel(panel.name.clone()));
            }
            let region = match self.regions.iter().position(|r| *r == panel.region) {
                Some(known) => known,
                None => {
                    let _ = self.regions.push(panel.region.clone());
                    self.regions.len() - 1
                }
            };
            let _ = self.areas.push(Area {
                name: panel.name.clone(),
                link: panel.link.clone(),
                region: region as u8,
                base: self.taxels,
                first_row,
                rows: panel.rows,
                columns: panel.columns,
                pitch_um: panel.pitch_um,
                cell_mm2: cell_mm2(panel.pitch_um),
                taxels_per_cm: taxels_per_cm(panel.pitch_um),
            });
            self.taxels += panel.rows * panel.columns;
            first_row += panel.rows;
        }
        Ok(())
    }

    fn check_exact(&self, full_scale: u16) -> Result<(), GarmentError> {
        for (index, area) in self.areas.iter().enumerate() {
            let mut sewn = 1u32 << index;
            // As many rounds as there are panels reach every panel sewn to this one.
            for _ in &self.areas {
                for joint in &self.joints {
                    let pair = 1 << joint.a | 1 << joint.b;
                    if sewn & pair != 0 {
                        sewn |= pair;
                    }
                }
            }
            let group = || self.areas.iter().enumerate().filter(|(i, _)| sewn >> i & 1 == 1);
            let taxels: u128 = group().map(|(_, a)| u128::from(a.rows) * u128::from(a.columns)).sum();
            let (width, height) = if sewn.count_ones() == 1 {
                (u128::from(area.columns), u128::from(area.rows))
            } else {
                let reach: u128 = group().map(|(_, a)| u128::from(a.rows.max(a.columns))).sum();
                (reach, reach)
            };
            let load = u128::from(full_scale) * taxels;
            if load * load * (width * width + height * height - 2) / 12 >= 1 << 64 {
                return Err(GarmentError::Inexact { panel: area.name.clone(), full_scale });
            }
        }
        Ok(())
    }

    /// Returns the panel named by entry `index` of the list `what`.
    pub(super) fn area_of(&self, what: &'static str, index: usize, panel: u8) -> Result<&Area, GarmentError> {
        self.areas.get(usize::from(panel)).ok_or(GarmentError::NoSuchPanel { what, index, panel })
    }

    /// The panels, in their order.
    pub fn areas(&self) -> &[Area] {
        &self.areas
    }

    /// The seams.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Names of the body's regions, in order of first mention.
    pub fn regions(&self) -> &[Name] {
        &self.regions
    }

    /// Number of taxels, absent ones included.
    pub fn taxels(&self) -> usize {
        usize::from(self.taxels)
    }

    /// A sum of what numbers the taxels, rows and columns of each panel: of two garments with the same sum,
    /// the taxels have the same numbers, but for one in four billion.
    pub fn sum(&self) -> u32 {
        let mut sizes = [0; 4 * PANELS];
        for (to, area) in sizes.as_chunks_mut::<4>().0.iter_mut().zip(&self.areas) {
            let ([a, b], [c, d]) = (area.rows.to_le_bytes(), area.columns.to_le_bytes());
            *to = [a, b, c, d];
        }
        crc32(&sizes)
    }

    /// True if the place has no taxel.
    pub fn is_absent(&self, panel: u8, row: u16, column: u16) -> bool {
        self.absent.iter().any(|gap| {
            gap.panel == panel
                && (gap.row..gap.row + gap.rows).contains(&row)
                && (gap.column..gap.column + gap.columns).contains(&column)
        })
    }

    /// Number of the taxel at a place; none outside the panel.
    pub fn taxel(&self, place: Place) -> Option<usize> {
        let area = self.areas.get(usize::from(place.panel))?;
        (place.row < area.rows && place.column < area.columns)
            .then(|| usize::from(area.base + place.row * area.columns + place.column))
    }

    /// Place of a taxel; none past the last.
    pub fn place(&self, taxel: usize) -> Option<Place> {
        self.areas.iter().enumerate().find_map(|(panel, area)| {
            let local = taxel.checked_sub(usize::from(area.base))?;
            let columns = usize::from(area.columns);
            let row = local.checked_div(columns)?;
            (row < usize::from(area.rows)).then(|| Place {
                panel: panel as u8,
                row: row as u16,
                column: (local - row * columns) as u16,
            })
        })
    }
}

/// Checks names, and the pitch if it is given.
fn check_panel(index: usize, panel: &Panel) -> Result<(), GarmentError> {
    for (key, name) in [("name", &panel.name), ("link", &panel.link), ("region", &panel.region)] {
        if name.is_empty() {
            return Err(GarmentError::Nameless { panel: index, key });
        }
    }
    let [least, most] = PITCH_UM;
    let wrong = panel.pitch_um.iter().find(|um| **um != 0 && !(least..=most).contains(*um));
    if let Some(um) = wrong {
        return Err(GarmentError::Pitch { panel: panel.name.clone(), um: *um });
    }
    if panel.pitch_um.contains(&0) && panel.pitch_um != [0, 0] {
        return Err(GarmentError::HalfPitch(panel.name.clone()));
    }
    Ok(())
}
