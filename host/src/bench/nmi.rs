//! `taxel bench nmi`: how far the normalised moment of inertia and its forms spread when the same touch is turned,
//! scaled, shifted by parts of a taxel, or pressed harder.
//!
//! Every touch is drawn exactly (the covered part of each taxel), rounded to 12-bit codes, and measured by the core's own
//! contact and shape stages with their shipped settings. Only one thing varies at a time; the others stay at 17 degrees,
//! scale 1, a centre that lies on no symmetry of the grid, and gain 0.5.

use super::Report;
use super::chart::{Axis, Better, Chart, Series};
use super::outline::Outline;
use anyhow::{Context, Result};
use serde_json::json;
use std::fmt::Write;
use taxel_core::condition::{Image, Rows};
use taxel_core::contact::{ContactConfig, ContactState};
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Layout};
use taxel_core::shape::{Nmi, nmi};

/// The forms, in the order of the columns.
pub const FORMS: [&str; 5] = ["published", "peak", "s2", "peak, Sheppard", "s2, Sheppard"];
/// What varies.
pub const VARIED: [&str; 4] = ["rotation", "scale", "shift", "pressure"];
/// Rows, columns, and the radius of the disc at scale 1, in taxels: at scale 2 every shape still fits.
pub const GRIDS: [(u16, u16, f64); 3] = [(4, 16, 0.9), (16, 16, 3.0), (32, 64, 6.0)];
/// Taxels of the largest grid.
const TAXELS: usize = 2048;
const FULL_SCALE: f64 = 4095.0;
/// Steps that make up the dome of a finger.
const LAYERS: usize = 8;

/// What touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Even pressure.
    Disc,
    /// Even pressure, the disc's area.
    Square,
    /// Even pressure, the disc's area, twice as long as wide.
    Rectangle,
    /// A capsule, softer towards its rim.
    Finger,
}

impl Shape {
    /// All, in the order of the rows.
    pub const ALL: [Shape; 4] = [Shape::Disc, Shape::Square, Shape::Rectangle, Shape::Finger];

    fn name(self) -> &'static str {
        match self {
            Shape::Disc => "disc",
            Shape::Square => "square",
            Shape::Rectangle => "rectangle",
            Shape::Finger => "finger",
        }
    }

    /// Outlines that are pressed one upon the other, each with its part of the pressure.
    fn layers(self, radius: f64) -> Vec<(Outline, f64)> {
        let side = radius * std::f64::consts::PI.sqrt() / 2.0;
        match self {
            Shape::Disc => vec![(Outline::disc(radius), 1.0)],
            Shape::Square => vec![(Outline::rectangle(side, side), 1.0)],
            Shape::Rectangle => {
                vec![(Outline::rectangle(side * 2f64.sqrt(), side / 2f64.sqrt()), 1.0)]
            }
            Shape::Finger => {
                // A ball's pressure on a soft ground, sqrt(1 - r^2): where a layer lies, seen from its rim.
                let layer = |index: usize| {
                    let height = (index as f64 + 0.5) / LAYERS as f64;
                    let across = 0.65 * radius * (1.0 - height * height).sqrt();
                    (Outline::capsule(0.6 * radius, across), 1.0 / LAYERS as f64)
                };
                (0..LAYERS).map(layer).collect()
            }
        }
    }
}

/// One touch of a shape.
#[derive(Debug, Clone, Copy)]
pub struct Touch {
    /// Radians.
    pub angle: f64,
    /// Of the size on that grid.
    pub scale: f64,
    /// Of the centre from the grid's, in taxels.
    pub shift: [f64; 2],
    /// Greatest pressure as a part of full scale.
    pub gain: f64,
}

/// What the others stay at while one thing varies.
pub const STILL: Touch = Touch { angle: 17.0 * DEGREE, scale: 1.0, shift: [0.13, 0.29], gain: 0.5 };
const DEGREE: f64 = std::f64::consts::PI / 180.0;

impl Touch {
    /// The touches under one variation: its index in [`VARIED`].
    pub fn varied(variation: usize) -> Vec<Touch> {
        let part = |step: i32, of: i32| f64::from(step) / f64::from(of);
        match variation {
            0 => (0..=30).map(|i| Touch { angle: 90.0 * DEGREE * part(i, 30), ..STILL }).collect(),
            1 => (0..=30).map(|i| Touch { scale: 0.5 * 4f64.powf(part(i, 30)), ..STILL }).collect(),
            2 => {
                let at = |i: i32| [part(i % 8, 8) - 0.5, part(i / 8, 8) - 0.5];
                (0..64).map(|i| Touch { shift: at(i), ..STILL }).collect()
            }
            _ => (0..=14).map(|i| Touch { gain: 0.2 + 0.7 * part(i, 14), ..STILL }).collect(),
        }
    }
}

/// A grid on which touches are drawn and measured.
pub struct Grid {
    layout: Layout,
    rows: u16,
    columns: u16,
    radius: f64,
}

impl Grid {
    /// By rows, columns and the radius of the disc.
    pub fn new((rows, columns, radius): (u16, u16, f64)) -> Result<Grid> {
        let layout = Layout::build(&Garment::recorded(rows, columns), TAXELS, u16::MAX)?;
        Ok(Grid { layout, rows, columns, radius })
    }

    /// The codes of a touch.
    pub fn draw(&self, shape: Shape, touch: &Touch) -> Vec<u16> {
        let mut covered = vec![0.0; usize::from(self.rows) * usize::from(self.columns)];
        let centre = [(self.columns, touch.shift[0]), (self.rows, touch.shift[1])]
            .map(|(count, shift)| (f64::from(count) - 1.0) / 2.0 + shift);
        for (outline, part) in shape.layers(self.radius * touch.scale) {
            outline.placed(touch.angle, centre).cover(part, self.columns.into(), &mut covered);
        }
        covered.into_iter().map(|part| (part * touch.gain * FULL_SCALE).round() as u16).collect()
    }

    /// The forms of the greatest contact; none where nothing is found.
    pub fn measure(&self, values: &[u16]) -> Result<Option<Nmi>> {
        let stage = ContactConfig::default().build()?;
        let mut state: Box<ContactState<8, { TAXELS / 2 }>> = Box::default();
        let image = Image { values, rows: &Rows::ALL };
        let touches = stage.process(&mut state, &self.layout, &image, Micros(0));
        let greatest = touches.moments.iter().zip(touches.present).max_by_key(|(moments, _)| moments.m);
        Ok(greatest.map(|(moments, contact)| nmi(moments, contact.peak)))
    }
}

/// A row: mean and spread of each form.
#[derive(Debug, Clone)]
struct Row {
    grid: String,
    shape: &'static str,
    varied: &'static str,
    mean: [f64; 5],
    /// Largest less smallest, of the mean, in per cent.
    spread: [f64; 5],
}

fn row(grid: &Grid, shape: Shape, variation: usize) -> Result<Row> {
    let name = format!("{} x {}", grid.rows, grid.columns);
    let mut all = Vec::new();
    for touch in Touch::varied(variation) {
        let forms = grid.measure(&grid.draw(shape, &touch))?;
        let forms = forms.with_context(|| format!("{} on {name}: no contact", shape.name()))?;
        all.push(
            [forms.published, forms.peak, forms.s2, forms.peak_sheppard, forms.s2_sheppard]
                .map(|form| form.to_f64()),
        );
    }
    let mut mean = [0.0; 5];
    let mut spread = [0.0; 5];
    for (form, (mean, spread)) in mean.iter_mut().zip(&mut spread).enumerate() {
        let values = || all.iter().map(|forms| forms[form]);
        let low = values().fold(f64::INFINITY, f64::min);
        let high = values().fold(0.0, f64::max);
        *mean = values().sum::<f64>() / all.len() as f64;
        *spread = 100.0 * (high - low) / *mean;
    }
    Ok(Row { grid: name, shape: shape.name(), varied: VARIED[variation], mean, spread })
}

/// The whole table; the same whenever it is made.
pub fn report() -> Result<Report> {
    let mut rows = Vec::new();
    for grid in GRIDS {
        let grid = Grid::new(grid)?;
        for shape in Shape::ALL {
            for variation in 0..VARIED.len() {
                rows.push(row(&grid, shape, variation)?);
            }
        }
    }
    let each: Vec<_> = rows
        .iter()
        .map(|r| json!({ "grid": r.grid, "shape": r.shape, "varied": r.varied, "mean": r.mean, "spread": r.spread }))
        .collect();
    let json = json!({ "forms": FORMS, "unit": "spread: per cent of the mean", "rows": each });
    Ok(Report { text: text(&rows), json, chart: chart(&rows) })
}

fn text(rows: &[Row]) -> String {
    let mut text = String::from(
        "Spread of the NMI and its forms: largest less smallest, per cent of the mean.\n\
         Rotation 0 to 90 degrees, scale 0.5 to 2, shift of the centre by parts of a taxel, pressure 0.2 to 0.9 of full scale;\n\
         touches drawn exactly in 12-bit codes, measured by the core's contact and shape stages.\n\n",
    );
    let _ = write!(text, "{:<8} {:<10} {:<9}", "grid", "shape", "varied");
    for form in FORMS {
        let _ = write!(text, " {form:>14}");
    }
    text.push('\n');
    for row in rows {
        let _ = write!(text, "{:<8} {:<10} {:<9}", row.grid, row.shape, row.varied);
        for spread in row.spread {
            let _ = write!(text, " {spread:>14.2}");
        }
        text.push('\n');
    }
    let _ = write!(text, "\nWorst of the four shapes\n");
    for (grid, varied) in kinds(rows) {
        let of = |form: usize| {
            let rows = rows.iter().filter(|r| r.grid == grid && r.varied == varied);
            rows.map(|r| r.spread[form]).fold(0.0, f64::max)
        };
        let _ = write!(text, "{grid:<8} {:<10} {varied:<9}", "");
        (0..FORMS.len()).for_each(|form| _ = write!(text, " {:>14.2}", of(form)));
        text.push('\n');
    }
    text
}

/// Grids and variations, in the order of the rows.
fn kinds(rows: &[Row]) -> Vec<(String, &'static str)> {
    let first = rows.iter().filter(|row| row.shape == Shape::ALL[0].name());
    first.map(|row| (row.grid.clone(), row.varied)).collect()
}

/// Each form by what geometry does to it and what pressure does to it, a point for every grid and shape.
fn chart(rows: &[Row]) -> Chart {
    let series = FORMS.iter().enumerate().map(|(form, name)| {
        let points = rows.chunks(VARIED.len()).filter_map(|chunk| {
            let (pressed, moved) = chunk.split_last()?;
            let worst = moved.iter().map(|row| row.spread[form]).fold(0.0, f64::max);
            let place =
                format!("{} {}: {worst:.2} %, {:.2} %", pressed.grid, pressed.shape, pressed.spread[form]);
            Some((worst, pressed.spread[form], place))
        });
        Series { name: (*name).into(), points: points.collect() }
    });
    Chart {
        title: "Forms of the NMI: spread of one shape, per grid and shape".into(),
        x: Axis::new("rotation, scale or shift: largest spread, %", Better::Less),
        y: Axis::new("pressure 0.2 to 0.9: spread, %", Better::Less),
        series: series.collect(),
    }
}
