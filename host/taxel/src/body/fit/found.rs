//! Fit of each panel.

use super::registered::{LEAST, Pair, Registered, registered};
use super::touch::KnownTouch;
use crate::body::chart::{Chart, Charted};
use crate::body::config::{Body, PatchOffset};
use crate::body::listed::Listed;
use crate::body::surface::Surface;
use crate::error::SettingError;
use taxel_core::garment::{Area, Garment, Layout};

/// Height above the surface, m, beyond which a place is not on the panel: that of a hand on the far side of a
/// link.
const ABOVE: f64 = 0.03;

/// Fit of the panels.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyFit {
    /// The panels that were found.
    pub panels: Vec<PatchFit>,
    /// Panels with too few touches, and their number.
    pub few: Vec<(String, usize)>,
}

/// Fit of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct PatchFit {
    /// Number of its patch in the body.
    pub patch: usize,
    /// Name of the panel.
    pub panel: String,
    /// Offset that was found.
    pub offset: PatchOffset,
    /// Standard deviation of the shift of the panel's middle, m: to the right and down.
    pub shift_sd: [f64; 2],
    /// Standard deviation of the turn, degrees. None if the touches are too near each other to find the turn:
    /// it is that of the body file then.
    pub turn_sd: Option<f64>,
    /// Touches of the panel.
    pub touches: Vec<FittedTouch>,
}

/// Fit of a touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FittedTouch {
    /// Number among all touches, from 0.
    pub number: usize,
    /// Way from where the taxels are now said to be to the touch, along the surface, m: to the right and
    /// down. None if it was on another link, on the other side of this one, or beside the taxels that have a
    /// place.
    pub off: Option<[f64; 2]>,
    /// Height of the touch above the surface, m; 0 without `off`.
    pub height: f64,
    /// True if it counts for the placing.
    pub is_kept: bool,
}

impl FittedTouch {
    /// Distance from where the taxels are said to be, m.
    pub fn distance(&self) -> Option<f64> {
        self.off.map(|[right, down]| right.hypot(down))
    }
}

impl PatchFit {
    /// Touches that count.
    pub fn kept(&self) -> impl Iterator<Item = &FittedTouch> {
        self.touches.iter().filter(|touch| touch.is_kept)
    }

    /// Root of the mean square of their distances, m.
    pub fn rms(&self) -> f64 {
        let squares: Vec<f64> = self.kept().filter_map(FittedTouch::distance).map(|off| off * off).collect();
        (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
    }

    /// Median of their heights above the surface, m: thickness of the cloth, or a wrong radius.
    pub fn height(&self) -> f64 {
        let mut heights: Vec<f64> = self.kept().map(|touch| touch.height).collect();
        heights.sort_by(f64::total_cmp);
        heights.get(heights.len() / 2).copied().unwrap_or(0.0)
    }
}

/// Finds how the panels of a body sit. Errors name the panel, the link or the touch.
pub(in crate::body) fn fit(
    body: &Body,
    garment: &Garment,
    layout: &Layout,
    listed: &[(usize, Vec<Listed>)],
    touches: &[KnownTouch],
) -> Result<BodyFit, SettingError> {
    let mut still = body.clone();
    still.patches.iter_mut().for_each(|patch| patch.offset = None);
    let surface = Surface::build_with(&still, garment, layout, listed, &[])?;
    let areas: Vec<Option<usize>> = touches
        .iter()
        .enumerate()
        .map(|(number, touch)| of_panel(number, touch, &surface, layout))
        .collect::<Result<_, SettingError>>()?;
    let mut found = BodyFit { panels: Vec::new(), few: Vec::new() };
    for (index, (patch, given)) in still.patches.iter().zip(&body.patches).enumerate() {
        let of_patch =
            |area: &Option<usize>| area.is_some_and(|area| *layout.areas()[area].name == *patch.panel);
        let Some(panel) = areas.iter().filter(|area| of_patch(area)).find_map(|area| *area) else { continue };
        let area = &layout.areas()[panel];
        let link = patch.link.as_deref().unwrap_or(&area.link);
        let wrong = |what: String| SettingError::Placing(format!("panel {}: {what}", area.name));
        let chart = Chart::of(patch, &surface, layout, panel as u8).ok_or_else(|| {
            wrong("its taxels lie all around the link: as one piece they cannot be shifted".into())
        })?;
        let own: Vec<(usize, &KnownTouch)> =
            touches.iter().enumerate().filter(|(number, _)| areas[*number] == Some(panel)).collect();
        let charted: Vec<(usize, Option<Spots>)> =
            own.iter().map(|(number, touch)| (*number, spots(&chart, link, touch))).collect();
        let pairs: Vec<Pair> = charted
            .iter()
            .map(|(_, spots)| match spots {
                Some(spots) => {
                    Pair { from: spots.felt.at, to: spots.known.iter().map(|known| known.at).collect() }
                }
                None => Pair { from: glam::DVec2::ZERO, to: Vec::new() },
            })
            .collect();
        if pairs.len() < LEAST {
            found.few.push((area.name.to_string(), pairs.len()));
            continue;
        }
        let before = given.offset.unwrap_or_default();
        let registered = registered(&pairs, before.radians()).ok_or_else(|| {
            wrong(format!(
                "its {} touches do not agree: no placing brings more than half of them within 20 mm",
                pairs.len()
            ))
        })?;
        found.panels.push(fitted(index, area, &registered, &charted));
    }
    Ok(found)
}

/// Index of the area that a touch is on; none if its panel has no patch.
fn of_panel(
    number: usize,
    touch: &KnownTouch,
    surface: &Surface,
    layout: &Layout,
) -> Result<Option<usize>, SettingError> {
    let wrong = |what: String| SettingError::Placing(format!("touch {}: {what}", number + 1));
    let areas = layout.areas();
    let area = areas.iter().position(|area| *area.name == *touch.panel).ok_or_else(|| {
        let known: Vec<&str> = areas.iter().map(|area| area.name.as_str()).collect();
        wrong(format!("the garment has no panel {:?}; known are {}", touch.panel, known.join(", ")))
    })?;
    let (columns, rows) = (f64::from(areas[area].columns), f64::from(areas[area].rows));
    // Contacts that cross a seam may have their centroid beyond it.
    if !((-columns..2.0 * columns).contains(&touch.column) && (-rows..2.0 * rows).contains(&touch.row)) {
        let (x, y) = (touch.column, touch.row);
        return Err(wrong(format!("column {x}, row {y} is far beside panel {}", areas[area].name)));
    }
    let is_placed = surface.panel(&areas[area]).iter().flatten().any(Option::is_some);
    Ok(is_placed.then_some(area))
}

/// A touch in a patch's chart.
struct Spots {
    felt: Charted,
    known: Vec<Charted>,
}

/// None if the place is not one of the panel's.
fn spots(chart: &Chart<'_>, link: &str, touch: &KnownTouch) -> Option<Spots> {
    let felt = chart.touched(touch.column, touch.row).filter(|_| touch.link == link)?;
    let mut known = chart.point(touch.at());
    known.retain(|known| (known.height - felt.height).abs() <= ABOVE);
    (!known.is_empty()).then_some(Spots { felt, known })
}

fn fitted(
    patch: usize,
    area: &Area,
    registered: &Registered,
    charted: &[(usize, Option<Spots>)],
) -> PatchFit {
    let Registered { motion, missing, kept, shift_sd, turn_sd } = registered;
    let touches = charted.iter().zip(missing.iter().zip(kept)).map(|((number, spots), (off, is_kept))| {
        let height = spots.as_ref().and_then(|spots| Some(spots.known.first()?.height - spots.felt.height));
        let off = off.map(|off| off.to_array());
        FittedTouch { number: *number, off, height: height.unwrap_or(0.0), is_kept: *is_kept }
    });
    PatchFit {
        patch,
        panel: area.name.to_string(),
        offset: PatchOffset { right: motion.shift.x, down: motion.shift.y, turn: motion.turn.to_degrees() },
        shift_sd: shift_sd.to_array(),
        turn_sd: turn_sd.map(f64::to_degrees),
        touches: touches.collect(),
    }
}
