//! Simple solids in the frame of a link, which hold the taxels of a region.
//!
//! Lower bounds belong to a solid, upper ones do not: solids may meet.

use super::form::{Axes, Unfit};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// A solid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Solid {
    /// Between two corners.
    Box(SolidBox),
    /// Between two lengths along an axis and two angles around it.
    Sector(Sector),
}

/// A box along the axes of the frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SolidBox {
    /// Corner with the least coordinates, m.
    pub from: DVec3,
    /// Corner with the greatest coordinates, m.
    pub to: DVec3,
}

/// A sector about an axis, out to any distance from it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sector {
    /// Point of the axis, from which lengths are counted, m.
    pub at: DVec3,
    /// Direction of the axis.
    pub axis: DVec3,
    /// Least and greatest length along the axis, m.
    pub along: [f64; 2],
    /// Direction from the axis at angle 0.
    pub facing: DVec3,
    /// Least and greatest angle, degrees: as panels count their columns, to the right as seen from outside
    /// with the axis pointing down.
    #[serde(default = "all_around")]
    pub around: [f64; 2],
}

fn all_around() -> [f64; 2] {
    [-180.0, 180.0]
}

/// A solid that is checked.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Held {
    Box(SolidBox),
    Sector(Sector, Axes),
}

impl Held {
    /// Checks a solid.
    pub fn new(solid: &Solid) -> Result<Held, Unfit> {
        match solid {
            Solid::Box(it) => match it.from.cmplt(it.to).all() && it.from.is_finite() && it.to.is_finite() {
                true => Ok(Held::Box(it.clone())),
                false => Err(("box.to", "must be above `from` in each coordinate")),
            },
            Solid::Sector(it) => {
                let ([short, long], [least, most]) = (it.along, it.around);
                if !(short < long && short.is_finite() && long.is_finite()) {
                    return Err(("sector.along", "must be two lengths, the least first"));
                }
                if !([least, most].iter().all(|angle| angle.abs() <= 360.0)
                    && least < most
                    && most - least <= 360.0)
                {
                    return Err((
                        "sector.around",
                        "must be two angles from -360 to 360 degrees, the least first, at most a turn apart",
                    ));
                }
                if !it.at.is_finite() {
                    return Err(("sector.at", "must be three numbers"));
                }
                let axes = Axes::new(it.axis, it.facing);
                let axes = axes.ok_or(("sector.facing", "must be a direction across `axis`"))?;
                Ok(Held::Sector(it.clone(), axes))
            }
        }
    }

    /// True if a point of the link, m, lies in it.
    pub fn holds(&self, at: DVec3) -> bool {
        match self {
            Held::Box(it) => at.cmpge(it.from).all() && at.cmplt(it.to).all(),
            Held::Sector(it, axes) => {
                let from = at - it.at;
                let along = from.dot(axes.down);
                let angle = from.dot(axes.right).atan2(from.dot(axes.out)).to_degrees();
                let [least, most] = it.around;
                let beyond = (angle - least).rem_euclid(360.0);
                it.along[0] <= along && along < it.along[1] && beyond < most - least
            }
        }
    }
}
