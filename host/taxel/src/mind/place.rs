//! Places on the body of a board's contacts.

use super::mover::SurfaceSpot;
use crate::body::Surface;
use crate::client::BoardDescription;
use crate::robot::RobotBoard;
use std::sync::Arc;

/// A place on the body.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BodyPlace {
    /// Name of the region: that of the body's file, else that of the panel.
    pub region: String,
    /// Name of the link.
    pub link: String,
}

impl BodyPlace {
    /// True if one of these words is a word of its region or of its link, or there is none. Capitals are as
    /// good as small letters.
    pub fn is_of(&self, part: &[String]) -> bool {
        let words = [&self.region, &self.link].into_iter();
        let mut words = words.flat_map(|name| name.split(|sign: char| !sign.is_alphanumeric()));
        part.is_empty() || words.any(|word| part.iter().any(|other| other.eq_ignore_ascii_case(word)))
    }
}

/// The places of a board's panels, and of the regions of its surface.
#[derive(Debug, Clone, Default)]
pub struct BoardPlaces {
    panels: Vec<Arc<BodyPlace>>,
    surface: Option<Surface>,
    /// Link, region and place of each part of the surface.
    spots: Vec<(usize, Option<usize>, Arc<BodyPlace>)>,
}

impl BoardPlaces {
    /// Makes the places of a board with this garment; with a surface if the body of its file fits the garment.
    pub fn of(board: &RobotBoard, description: &BoardDescription) -> BoardPlaces {
        let layout = &description.layout;
        let place = |area: &taxel_core::garment::Area| {
            let region = layout.regions().get(usize::from(area.region));
            let link = board.link.clone().unwrap_or_else(|| area.link.to_string());
            Arc::new(BodyPlace { region: region.map_or(String::new(), ToString::to_string), link })
        };
        let panels = layout.areas().iter().map(place).collect();
        let body = board.body.as_deref().and_then(|body| crate::body::read(body).ok());
        let surface = body.and_then(|body| body.surface(&description.garment, layout).ok());
        let mut places = BoardPlaces { panels, surface: None, spots: Vec::new() };
        for (taxel, spot) in surface.iter().flat_map(|surface| surface.places().iter().enumerate()) {
            let (Some(spot), Some(surface), Some(at)) = (spot, &surface, layout.place(taxel)) else {
                continue;
            };
            if places.spots.iter().any(|(link, region, _)| (*link, *region) == (spot.link, spot.region)) {
                continue;
            }
            let panel = places.panels.get(usize::from(at.panel)).map_or("", |panel| panel.region.as_str());
            let region = surface.region(spot).unwrap_or(panel).to_string();
            let link = surface.links().get(spot.link).cloned().unwrap_or_default();
            places.spots.push((spot.link, spot.region, Arc::new(BodyPlace { region, link })));
        }
        places.surface = surface;
        places
    }

    /// Place of a point of a panel, `(x, y)` in taxels, and the point of the surface if the board has a body.
    pub fn at(
        &self,
        description: &BoardDescription,
        panel: u8,
        [x, y]: [f64; 2],
    ) -> Option<(Arc<BodyPlace>, Option<SurfaceSpot>)> {
        let spot = self.surface.as_ref().and_then(|surface| surface.at(&description.layout, panel, x, y));
        let on_surface = spot.and_then(|spot| {
            let mut spots = self.spots.iter();
            spots.find(|(link, region, _)| (*link, *region) == (spot.link, spot.region))
        });
        let place = on_surface.map(|(.., place)| place).or_else(|| self.panels.get(usize::from(panel)))?;
        let spot =
            spot.map(|spot| SurfaceSpot { link: place.link.clone(), at: spot.at, normal: spot.normal });
        Some((place.clone(), spot))
    }

    /// All of them.
    pub fn all(&self) -> Vec<Arc<BodyPlace>> {
        let on_surface = self.spots.iter().map(|(.., place)| place);
        self.panels.iter().chain(on_surface).cloned().collect()
    }
}
