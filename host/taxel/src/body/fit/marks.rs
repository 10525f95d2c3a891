//! Marks on the robot: places to be touched, one after the other.

use crate::body::surface::Surface;
use crate::error::SettingError;
use glam::DVec3;
use taxel_core::garment::Layout;

/// A place on the robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Name of the link.
    pub link: String,
    /// Place in its frame, m.
    pub at: DVec3,
}

/// Reads marks: `link x y z` a line, in metres, separated by blanks or commas. Empty lines and those that
/// begin with `#` do not count. Errors name the line.
pub fn marks(name: &str, text: &str) -> Result<Vec<Mark>, SettingError> {
    let mut marks = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let parts: Vec<&str> = line.split([' ', '\t', ',', ';']).filter(|part| !part.is_empty()).collect();
        let wrong = || {
            SettingError::Malformed(format!(
                "{name}, line {}: not a link and three numbers: {line:?}",
                number + 1
            ))
        };
        let [link, numbers @ ..] = &parts[..] else { return Err(wrong()) };
        let numbers: Result<Vec<f64>, _> = numbers.iter().map(|part| part.parse()).collect();
        match numbers.as_deref() {
            Ok([x, y, z]) if [x, y, z].iter().all(|number| number.is_finite()) => {
                marks.push(Mark { link: (*link).into(), at: DVec3::new(*x, *y, *z) });
            }
            _ => return Err(wrong()),
        }
    }
    Ok(marks)
}

/// Marks at taxels of each panel that has a place, `count` for each, as far from each other as can be and two
/// taxels from the panel's edge: there a finger is felt as a whole. A smaller panel gives fewer.
pub fn picked(surface: &Surface, layout: &Layout, count: usize) -> Vec<Mark> {
    let mut marks = Vec::new();
    for area in layout.areas() {
        let rows = surface.panel(area);
        let inside = |at: usize, all: u16| at >= 2 && at + 2 < usize::from(all);
        let inner = |(row, places): (usize, &Vec<_>)| -> Vec<_> {
            let places: &Vec<Option<crate::body::TaxelPlace>> = places;
            let is_inside = |column: &usize| inside(row, area.rows) && inside(*column, area.columns);
            (0..places.len()).filter(is_inside).filter_map(|column| places[column]).collect()
        };
        let places: Vec<_> = rows.iter().enumerate().flat_map(inner).collect();
        let mut chosen: Vec<DVec3> = places.first().map(|place| place.at).into_iter().take(count).collect();
        while chosen.len() < count.min(places.len()) {
            let far = |at: DVec3| chosen.iter().map(|other| other.distance(at)).fold(f64::INFINITY, f64::min);
            let next = places.iter().map(|place| place.at).max_by(|a, b| far(*a).total_cmp(&far(*b)));
            chosen.extend(next);
        }
        let link = places.first().and_then(|place| surface.links().get(place.link));
        marks.extend(
            chosen
                .into_iter()
                .zip(link.into_iter().cycle())
                .map(|(at, link)| Mark { link: link.clone(), at }),
        );
    }
    marks
}
