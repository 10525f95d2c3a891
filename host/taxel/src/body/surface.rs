//! The place of every taxel.

use super::config::{Body, Patch, PatchOffset};
use super::form::{Form, Laid, PanelSpot, Spot};
use super::listed::Listed;
use super::pose::Pose;
use super::regions::resolve;
use super::rigid::Rigid;
use super::taxel_place::TaxelPlace;
use crate::error::{Result, SettingError};
use glam::{DVec2, DVec3};
use std::ops::RangeInclusive;
use taxel_core::garment::{Area, Garment, Layout, Place};

/// The places of a garment's taxels.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    links: Vec<String>,
    places: Vec<Option<TaxelPlace>>,
    /// Names of the regions.
    regions: Vec<String>,
}

/// Fit of a panel on the robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Name of the panel.
    pub panel: String,
    /// Index into [`Surface::links`].
    pub link: usize,
    /// Taxels with a place.
    pub taxels: usize,
    /// Least and greatest distance of neighbours as a share of the panel's pitch: 1 where nothing stretches,
    /// a little less around a bend, because distances are straight. None without neighbours or a pitch.
    pub pitch: Option<RangeInclusive<f64>>,
}

impl Surface {
    /// Places the taxels of a garment. Errors name the patch by index and key: `patches[2].on.radius`.
    pub fn build(body: &Body, garment: &Garment, layout: &Layout) -> Result<Surface, SettingError> {
        Surface::build_with(body, garment, layout, &[], &[])
    }

    /// [`Surface::build`] with the taxels of files, by patch, and with the way of each patch over the skin,
    /// m.
    pub(super) fn build_with(
        body: &Body,
        garment: &Garment,
        layout: &Layout,
        listed: &[(usize, Vec<Listed>)],
        shifts: &[DVec2],
    ) -> Result<Surface, SettingError> {
        let mut surface = Surface {
            links: Vec::new(),
            places: vec![None; layout.taxels()],
            regions: body.regions.iter().map(|region| region.name.clone()).collect(),
        };
        for (index, patch) in body.patches.iter().enumerate() {
            let wrong = |key: &str, what: &str| wrong(index, key, what);
            let Some((panel, area)) =
                layout.areas().iter().enumerate().find(|(_, a)| *a.name == *patch.panel)
            else {
                let known: Vec<&str> = garment.panels.iter().map(|panel| panel.name.as_str()).collect();
                return Err(wrong("panel", &format!("must be a panel of the garment: {}", known.join(", "))));
            };
            if body.patches[..index].iter().any(|earlier| earlier.panel == patch.panel) {
                return Err(wrong("panel", "lies somewhere else already"));
            }
            if !patch.turn.is_finite() {
                return Err(wrong("turn", "must be a number"));
            }
            if patch.turn != 0.0 && matches!(patch.on, Form::Grid(_) | Form::Taxels(_)) {
                return Err(wrong("turn", "must be left out: the points say how the panel lies"));
            }
            if !patch.slides.is_empty() && matches!(patch.on, Form::Grid(_) | Form::Taxels(_)) {
                return Err(wrong("slides", "must be left out: the points say where the panel lies"));
            }
            let offset = patch.offset.unwrap_or_default();
            for (key, number) in [("right", offset.right), ("down", offset.down), ("turn", offset.turn)] {
                if !number.is_finite() {
                    return Err(wrong(&format!("offset.{key}"), "must be a number"));
                }
            }
            let shift = shifts.get(index).copied().unwrap_or_default();
            let link = surface.link(patch.link.as_deref().unwrap_or(&area.link));
            match Laid::new(&patch.on).map_err(|(key, what)| wrong(&format!("on.{key}"), what))? {
                Some(laid) => {
                    surface.lay(layout, (panel as u8, area), (&laid, patch, link), shift, &wrong)?;
                }
                None => {
                    let rows = listed.iter().find(|(of, _)| *of == index).map_or(&[][..], |(_, rows)| rows);
                    surface.take(layout, (panel as u8, area), rows, link, &wrong)?;
                }
            }
            if matches!(patch.on, Form::Grid(_) | Form::Taxels(_)) && offset != PatchOffset::default() {
                let what = "needs taxels on one side of the robot: these have no plane that touches them";
                let rigid = Rigid::of(&surface.panel(area)).ok_or_else(|| wrong("offset", what))?;
                surface.shift(area, &rigid, &offset);
            }
        }
        // Cloth that slides may leave a region.
        resolve(body, &surface.links, &mut surface.places, shifts.is_empty())?;
        Ok(surface)
    }

    /// Index of a link.
    fn link(&mut self, name: &str) -> usize {
        self.links.iter().position(|link| link == name).unwrap_or_else(|| {
            self.links.push(name.into());
            self.links.len() - 1
        })
    }

    fn lay(
        &mut self,
        layout: &Layout,
        (panel, area): (u8, &Area),
        (laid, patch, link): (&Laid<'_>, &Patch, usize),
        shift: DVec2,
        wrong: &impl Fn(&str, &str) -> SettingError,
    ) -> Result<(), SettingError> {
        let pitch = DVec2::from(area.pitch_um.map(|um| f64::from(um) * 1e-6));
        if pitch.min_element() <= 0.0 && !matches!(patch.on, Form::Grid(_)) {
            return Err(wrong("panel", "must have a pitch: its taxels' distances are not known"));
        }
        let last = DVec2::new(f64::from(area.columns - 1), f64::from(area.rows - 1));
        let turn = DVec2::from_angle(patch.turn.to_radians());
        let offset = patch.offset.unwrap_or_default();
        let (offset_turn, shift) = (DVec2::from_angle(offset.radians()), offset.shift() + shift);
        for (row, column) in every(area) {
            let at = DVec2::new(f64::from(column), f64::from(row));
            let from_middle = turn.rotate((at - last / 2.0) * pitch);
            let moved = offset_turn.rotate(from_middle) + shift;
            let share = at / last.max(DVec2::ONE);
            let Some(taxel) = layout.taxel(Place { panel, row, column }) else { continue };
            let spot = laid.spot(&PanelSpot { from_middle, moved, share });
            let Some(Spot { at, normal }) =
                spot.filter(|spot| spot.at.is_finite() && spot.normal.is_finite())
            else {
                let what = format!("does not hold the whole panel: row {row}, column {column} has no place");
                return Err(wrong("on", &what));
            };
            self.places[taxel] = Some(TaxelPlace { link, at, normal, region: None });
        }
        Ok(())
    }

    fn take(
        &mut self,
        layout: &Layout,
        (panel, area): (u8, &Area),
        listed: &[Listed],
        link: usize,
        wrong: &impl Fn(&str, &str) -> SettingError,
    ) -> Result<(), SettingError> {
        let taxels = usize::from(area.rows) * usize::from(area.columns);
        if listed.len() != taxels {
            let what = format!("lists {} taxels, and the panel has {taxels}", listed.len());
            return Err(wrong("on.taxels", &what));
        }
        for ((row, column), listed) in every(area).zip(listed) {
            if let (Some(taxel), Some((at, normal))) = (layout.taxel(Place { panel, row, column }), listed) {
                self.places[taxel] = Some(TaxelPlace { link, at: *at, normal: *normal, region: None });
            }
        }
        Ok(())
    }

    /// Places of a panel's taxels, row by row.
    pub(super) fn panel(&self, area: &Area) -> Vec<Vec<Option<TaxelPlace>>> {
        let first = usize::from(area.base);
        let columns = usize::from(area.columns);
        let row = |row: usize| {
            let place = |column: usize| self.places.get(first + row * columns + column).copied().flatten();
            (0..columns).map(place).collect()
        };
        (0..usize::from(area.rows)).map(row).collect()
    }

    /// Moves a panel as one rigid piece.
    fn shift(&mut self, area: &Area, rigid: &Rigid, offset: &PatchOffset) {
        let first = usize::from(area.base);
        let count = usize::from(area.rows) * usize::from(area.columns);
        for place in self.places.iter_mut().skip(first).take(count).flatten() {
            *place = rigid.moved(place, offset);
        }
    }

    /// Names of the links that taxels lie on.
    pub fn links(&self) -> &[String] {
        &self.links
    }

    /// Names of the body's regions, in the order of its file.
    pub fn regions(&self) -> &[String] {
        &self.regions
    }

    /// Name of the region in which a taxel or a contact lies, if one does.
    pub fn region(&self, place: &TaxelPlace) -> Option<&str> {
        self.regions.get(place.region?).map(String::as_str)
    }

    /// Taxels of a region, rising, by the index of its name.
    pub fn of_region(&self, region: usize) -> Vec<usize> {
        let places = self.places.iter().enumerate();
        let is_in = |place: &Option<TaxelPlace>| place.is_some_and(|place| place.region == Some(region));
        places.filter(|(_, place)| is_in(place)).map(|(taxel, _)| taxel).collect()
    }

    /// Place of each taxel, by number; none for a panel without a patch, and for absent taxels.
    pub fn places(&self) -> &[Option<TaxelPlace>] {
        &self.places
    }

    /// Place of a point between taxels, as a contact's centroid: `(x, y)` in taxels of a panel. Linear
    /// between the four taxels around it; the region is that of the nearest. None where one of these has no
    /// place.
    pub fn at(&self, layout: &Layout, panel: u8, x: f64, y: f64) -> Option<TaxelPlace> {
        let area = layout.areas().get(usize::from(panel))?;
        let within = |at: f64, count: u16| {
            let at = at.clamp(0.0, f64::from(count - 1));
            let first = at.floor().min(f64::from(count.saturating_sub(2)));
            (first as u16, at - first)
        };
        let ((column, x), (row, y)) = (within(x, area.columns), within(y, area.rows));
        let next = |at: u16, count: u16| (at + 1).min(count - 1);
        let corners = [
            (row, column, (1.0 - x) * (1.0 - y)),
            (row, next(column, area.columns), x * (1.0 - y)),
            (next(row, area.rows), column, (1.0 - x) * y),
            (next(row, area.rows), next(column, area.columns), x * y),
        ];
        let (mut at, mut normal, mut nearest) = (DVec3::ZERO, DVec3::ZERO, None);
        for (row, column, share) in corners.into_iter().filter(|(.., share)| *share > 0.0) {
            let place = self.places[layout.taxel(Place { panel, row, column })?]?;
            (at, normal) = (at + place.at * share, normal + place.normal * share);
            if nearest.is_none_or(|(_, most)| share > most) {
                nearest = Some((place, share));
            }
        }
        Some(TaxelPlace { at, normal: normal.try_normalize()?, ..nearest?.0 })
    }

    /// The surface in a frame in which its links have these poses.
    pub(super) fn moved(&self, poses: &[Pose]) -> Surface {
        let place = |place: &Option<TaxelPlace>| {
            let place = (*place)?;
            Some(poses.get(place.link).map_or(place, |pose| place.seen_from(pose)))
        };
        Surface { places: self.places.iter().map(place).collect(), ..self.clone() }
    }

    /// Returns how well each panel lies.
    pub fn fits(&self, layout: &Layout) -> Vec<Fit> {
        let fit = |(panel, area): (usize, &Area)| {
            let place = |row, column| {
                let place = Place { panel: panel as u8, row, column };
                self.places[layout.taxel(place)?]
            };
            let placed: Vec<TaxelPlace> =
                every(area).filter_map(|(row, column)| place(row, column)).collect();
            let pitch = area.pitch_um.map(|um| f64::from(um) * 1e-6);
            let steps = every(area).flat_map(|(row, column)| {
                let from = place(row, column);
                let to = [(place(row, column + 1), pitch[0]), (place(row + 1, column), pitch[1])];
                to.into_iter()
                    .filter_map(move |(to, pitch)| (pitch > 0.0).then_some(from?.at.distance(to?.at) / pitch))
            });
            let pitch = steps.map(|step| (step, step)).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
            let pitch = pitch.map(|(least, most)| least..=most);
            let first = placed.first()?;
            Some(Fit { panel: area.name.to_string(), link: first.link, taxels: placed.len(), pitch })
        };
        layout.areas().iter().enumerate().filter_map(fit).collect()
    }

    /// The first two panels that lie on each other: a taxel of the one is nearer to one of the other than
    /// half of the smaller pitch, and both face the same way.
    pub fn overlap<'a>(&self, layout: &'a Layout) -> Option<(&'a str, &'a str)> {
        let of = |area: &Area| {
            let first = usize::from(area.base);
            let count = usize::from(area.rows) * usize::from(area.columns);
            self.places[first..(first + count).min(self.places.len())].iter().flatten()
        };
        let areas = layout.areas();
        for (index, a) in areas.iter().enumerate() {
            for b in &areas[index + 1..] {
                let pitch =
                    a.pitch_um.iter().chain(&b.pitch_um).min().map_or(0.0, |um| f64::from(*um) * 1e-6);
                let lie_on_each_other = of(a).any(|one| {
                    of(b).any(|other| {
                        one.link == other.link
                            && one.at.distance_squared(other.at) < pitch * pitch / 4.0
                            && one.normal.dot(other.normal) > 0.0
                    })
                });
                if lie_on_each_other {
                    return Some((&a.name, &b.name));
                }
            }
        }
        None
    }
}

/// Rows and columns of a panel, in the order of its taxels.
fn every(area: &Area) -> impl Iterator<Item = (u16, u16)> + use<> {
    let (rows, columns) = (area.rows, area.columns);
    (0..rows).flat_map(move |row| (0..columns).map(move |column| (row, column)))
}

fn wrong(index: usize, key: &str, what: &str) -> SettingError {
    let key = format!("patches[{index}].{key}");
    SettingError::Key { text: format!("`{key}` {what}"), key }
}
