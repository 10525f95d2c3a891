//! `cargo xtask bench nmi`: spread of the normalised moment of inertia and its forms if one touch is turned,
//! scaled, shifted by fractions of a taxel, or pressed harder.
//!
//! Every touch is drawn exactly (the covered part of each taxel), rounded to 12-bit codes, and measured by
//! the core's own contact and shape stages with their shipped settings. One parameter varies at a time; the
//! others stay at 17 degrees, scale 1, a centre off the symmetries of the grid, and gain 0.5.

use super::Report;
use super::chart::{Axis, Better, Chart, Series};
use super::touch::{Shape, TouchPlacement, VARIED};
use anyhow::{Context, Result};
use serde_json::json;
use std::fmt::Write;
use taxel_core::capacity::TAXELS;
use taxel_core::condition::{Image, Rows};
use taxel_core::contact::{ContactConfig, ContactState};
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Layout};
use taxel_core::shape::{Nmi, nmi};

/// Forms, in the order of the columns.
pub const FORMS: [&str; 5] = ["published", "peak", "s2", "peak, Sheppard", "s2, Sheppard"];
/// Rows, columns, and the radius of the disc at scale 1, in taxels: at scale 2 every shape still fits.
pub const GRIDS: [(u16, u16, f64); 3] = [(4, 16, 0.9), (16, 16, 3.0), (32, 64, 6.0)];
const FULL_SCALE: f64 = 4095.0;

/// A grid for drawing and measuring touches.
pub struct Grid {
    layout: Layout,
    rows: u16,
    columns: u16,
    radius: f64,
}

impl Grid {
    /// A grid with these rows, columns and radius of the disc.
    pub fn new((rows, columns, radius): (u16, u16, f64)) -> Result<Grid> {
        let layout = Layout::build(&Garment::recorded(rows, columns), TAXELS, u16::MAX)?;
        Ok(Grid { layout, rows, columns, radius })
    }

    /// Codes of a touch.
    pub fn draw(&self, shape: Shape, touch: &TouchPlacement) -> Vec<u16> {
        let mut covered = vec![0.0; usize::from(self.rows) * usize::from(self.columns)];
        let centre = [(self.columns, touch.shift[0]), (self.rows, touch.shift[1])]
            .map(|(count, shift)| (f64::from(count) - 1.0) / 2.0 + shift);
        for (outline, part) in shape.layers(self.radius * touch.scale) {
            outline.placed(touch.angle, centre).cover(part, self.columns.into(), &mut covered);
        }
        covered.into_iter().map(|part| (part * touch.gain * FULL_SCALE).round() as u16).collect()
    }

    /// Forms of the greatest contact; none if there is no contact.
    pub fn measure(&self, values: &[u16]) -> Result<Option<Nmi>> {
        let stage = ContactConfig::default().build()?;
        let mut state: Box<ContactState<8, { TAXELS / 2 }>> = Box::default();
        let image = Image { values, rows: &Rows::ALL };
        let touches = stage.process(&mut state, &self.layout, &image, Micros(0));
        let greatest = touches.moments().zip(touches.present).max_by_key(|(moments, _)| moments.m);
        Ok(greatest.map(|(moments, contact)| nmi(moments, contact.peak)))
    }
}

/// Mean and spread of each form.
#[derive(Debug, Clone)]
struct FormSpread {
    grid: String,
    shape: &'static str,
    varied: &'static str,
    mean: [f64; 5],
    /// Largest minus smallest, per cent of the mean.
    spread: [f64; 5],
}

fn row(grid: &Grid, shape: Shape, variation: usize) -> Result<FormSpread> {
    let name = format!("{} x {}", grid.rows, grid.columns);
    let mut all = Vec::new();
    for touch in TouchPlacement::varied(variation) {
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
    Ok(FormSpread { grid: name, shape: shape.name(), varied: VARIED[variation], mean, spread })
}

fn rows() -> Result<Vec<FormSpread>> {
    let mut rows = Vec::new();
    for grid in GRIDS {
        let grid = Grid::new(grid)?;
        for shape in Shape::ALL {
            for variation in 0..VARIED.len() {
                rows.push(row(&grid, shape, variation)?);
            }
        }
    }
    Ok(rows)
}

/// The whole table; deterministic.
pub fn report() -> Result<Report> {
    let rows = rows()?;
    let each: Vec<_> = rows
        .iter()
        .map(|r| json!({ "grid": r.grid, "shape": r.shape, "varied": r.varied, "mean": r.mean, "spread": r.spread }))
        .collect();
    let json = json!({ "forms": FORMS, "unit": "spread: per cent of the mean", "rows": each });
    Ok(Report { text: text(&rows), json, chart: chart(&rows) })
}

fn text(rows: &[FormSpread]) -> String {
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
fn kinds(rows: &[FormSpread]) -> Vec<(String, &'static str)> {
    let first = rows.iter().filter(|row| row.shape == Shape::ALL[0].name());
    first.map(|row| (row.grid.clone(), row.varied)).collect()
}

/// Each form by its spread under geometry and under pressure, the worst of the shapes on each grid.
fn chart(rows: &[FormSpread]) -> Chart {
    let on_grid = rows.chunks(Shape::ALL.len() * VARIED.len());
    let series = on_grid.filter_map(|rows| {
        let worst = |form: usize, pressed: bool| {
            let rows = rows.iter().filter(|row| (row.varied == VARIED[3]) == pressed);
            rows.map(|row| row.spread[form]).fold(0.0, f64::max)
        };
        let points = FORMS.iter().enumerate().map(|(form, name)| {
            let (moved, pressed) = (worst(form, false), worst(form, true));
            (moved, pressed, format!("{name}: {moved:.2} %, {pressed:.2} %"))
        });
        Some(Series { name: rows.first()?.grid.clone(), points: points.collect() })
    });
    Chart {
        title: "Forms of the NMI: spread of one touch, worst of four shapes".into(),
        x: Axis::new("rotation, scale or shift: largest spread, %", Better::Less),
        y: Axis::new("pressure 0.2 to 0.9: spread, %", Better::Less),
        named: true,
        series: series.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// NMI of an outline with even pressure, of any size: sqrt(J) / m with f = 1.
    const EXACT: [(Shape, f64); 3] =
        [(Shape::Disc, 0.398942280401), (Shape::Square, 0.408248290464), (Shape::Rectangle, 0.456435464588)];

    fn all() -> Vec<FormSpread> {
        rows().unwrap()
    }

    fn spread<'a>(
        rows: &'a [FormSpread],
        grid: &'a str,
        varied: &'a str,
        form: usize,
    ) -> impl Iterator<Item = f64> + 'a {
        rows.iter()
            .filter(move |row| row.grid == grid && row.varied == varied)
            .map(move |row| row.spread[form])
    }

    #[test]
    fn references_are_those_of_the_outlines() {
        let exact = [1.0 / (2.0 * PI).sqrt(), 1.0 / 6f64.sqrt(), (2.5f64 / 12.0).sqrt()];
        for ((_, want), exact) in EXACT.iter().zip(exact) {
            assert!((want - exact).abs() < 1e-12);
        }
    }

    #[test]
    fn pressure_moves_the_published_form_alone() {
        let rows = all();
        // f -> a f: sqrt(J) / m goes as the root of 1 / a.
        let steps: Vec<f64> =
            TouchPlacement::varied(3).iter().map(|touch| touch.gain.sqrt().recip()).collect();
        let mean = steps.iter().sum::<f64>() / steps.len() as f64;
        let law = 100.0 * (steps[0] - steps[steps.len() - 1]) / mean;
        for (rows_columns, off, rest) in [("16 x 16", 0.5, 0.3), ("32 x 64", 0.2, 0.13)] {
            for published in spread(&rows, rows_columns, "pressure", 0) {
                assert!((published - law).abs() < off, "{rows_columns}: {published} {law}");
            }
            for (form, name) in FORMS.iter().enumerate().skip(1) {
                for other in spread(&rows, rows_columns, "pressure", form) {
                    assert!(other < rest + 0.01, "{rows_columns} {name}: {other}");
                }
            }
        }
    }

    #[test]
    fn peak_with_sheppards_correction_holds_the_exact_value_on_a_fine_grid() {
        let rows = all();
        for varied in VARIED {
            for spread in spread(&rows, "32 x 64", varied, 3) {
                assert!(spread < 0.35, "{varied}: {spread}");
            }
        }
        for (shape, exact) in EXACT {
            for row in rows.iter().filter(|row| row.grid == "32 x 64" && row.shape == shape.name()) {
                let off = row.mean[3] / exact - 1.0;
                assert!(off.abs() < 2e-3, "{} {}: {off}", row.shape, row.varied);
            }
        }
    }
}
