//! Checks that a touch, mapped through the garment found, is at the requested place.

use super::ask::{Ask, Gesture};
use super::bundle::Bundle;
use super::touch::Touch;
use taxel::sim::Decoder;
use taxel_core::garment::{Circuit, Garment, GarmentError, Layout, Pins};

/// Tolerated distance of a finger from the requested place, taxels: one for the user, one for the finger,
/// half a one spare.
const OFF: f64 = 2.5;
/// Largest rms distance of the taxels under one finger from their centre, taxels.
const SPREAD: f64 = 2.0;
/// Tolerated backward movement of a stroke, taxels.
const BACK: f64 = 1.5;
/// Taxels at either end of a stroke that may be missed.
const END: f64 = 4.0;
/// Share of the signal that may be on other panels: a finger at a seam presses both.
const ELSEWHERE: f64 = 0.4;

/// Map from addresses to places.
pub(super) struct Places {
    layout: Layout,
    /// Panel, column and row of each address.
    places: Vec<Option<(usize, f64, f64)>>,
}

impl Places {
    /// Places of a garment that uses the wires of the bundle. An error says where the garment is
    /// inconsistent.
    pub fn of(garment: &Garment, bundle: &Bundle) -> Result<Places, GarmentError> {
        let layout = Layout::build(garment, usize::from(u16::MAX), 1)?;
        Circuit::build(garment, &layout, Pins::ANY)?;
        let decoder = Decoder::build(garment);
        let place = |address: usize| {
            let pin = bundle.inputs[bundle.split(address).0];
            let input = decoder.inputs().iter().position(|input| *input == pin)?;
            let taxel = decoder.taxel(decoder.address(bundle.levels(address, garment))?, input)?;
            let place = layout.place(taxel)?;
            Some((usize::from(place.panel), f64::from(place.column), f64::from(place.row)))
        };
        let places = (0..bundle.addresses()).map(place).collect();
        Ok(Places { layout, places })
    }

    /// Returns the largest distance of the touch from the requested place, or what is wrong with it.
    pub fn check(&self, ask: &Ask, touch: &Touch) -> Result<f64, String> {
        let Some(area) = self.layout.areas().get(ask.panel) else {
            return Err("there is no such panel".into());
        };
        let (last_x, last_y) = (f64::from(area.columns - 1), f64::from(area.rows - 1));
        let path = self.path(ask.panel, touch)?;
        let mean = |part: fn(&[f64; 2]) -> f64| path.iter().map(part).sum::<f64>() / path.len() as f64;
        let (x, y) = (mean(|at| at[0]), mean(|at| at[1]));
        match ask.gesture {
            Gesture::Down { column, .. } => {
                along(path.iter().map(|at| at[1]), last_y)?;
                near(x - f64::from(column), last_x)
            }
            Gesture::Across { row } => {
                along(path.iter().map(|at| at[0]), last_x)?;
                near(y - f64::from(row), last_y)
            }
            Gesture::Corner => Ok(near(x, last_x)?.max(near(y, last_y)?)),
        }
    }

    /// Column and row of the finger in each frame.
    fn path(&self, panel: usize, touch: &Touch) -> Result<Vec<[f64; 2]>, String> {
        let (mut path, mut elsewhere, mut all, mut wide) = (Vec::new(), 0.0, 0.0, 0.0);
        for moment in &touch.moments {
            let (mut sum, mut x, mut y, mut squares) = (0.0, 0.0, 0.0, 0.0);
            for (address, signal) in moment.strong() {
                let signal = f64::from(signal);
                all += signal;
                match self.places.get(address).copied().flatten() {
                    Some((at, column, row)) if at == panel => {
                        sum += signal;
                        x += signal * column;
                        y += signal * row;
                        squares += signal * (column * column + row * row);
                    }
                    _ => elsewhere += signal,
                }
            }
            if sum > 0.0 {
                let at = [x / sum, y / sum];
                wide += squares - sum * (at[0] * at[0] + at[1] * at[1]);
                path.push(at);
            }
        }
        if path.is_empty() || elsewhere > ELSEWHERE * all {
            return Err("another panel was touched".into());
        }
        if (wide / all).sqrt() > SPREAD {
            return Err("the finger was felt in several places at once".into());
        }
        Ok(path)
    }
}

/// Checks the distance from the requested place on a panel whose last index is `last`. The tolerance is small
/// enough to distinguish the two sides of a panel.
fn near(off: f64, last: f64) -> Result<f64, String> {
    if off.abs() <= OFF.min(last / 2.0 - 0.01).max(0.5) {
        Ok(off.abs())
    } else {
        Err(format!("it was felt {:.1} taxels from there", off.abs()))
    }
}

/// Checks that a path goes from one end to the other.
fn along(path: impl Iterator<Item = f64>, last: f64) -> Result<(), String> {
    let (mut first, mut most) = (None, f64::MIN);
    for at in path {
        first.get_or_insert(at);
        if at < most - BACK {
            return Err("the stroke was felt to go back and forth".into());
        }
        most = most.max(at);
    }
    let end = END.min(last / 3.0).max(0.5);
    if first.is_none_or(|first| first > end) || most < last - end {
        return Err("the stroke did not go from end to end".into());
    }
    Ok(())
}
