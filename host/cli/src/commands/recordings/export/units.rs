//! Units of pressure in exports.

use taxel::files::calibrate::{ForceBasis, Newtons};
use taxel_core::body::Placed;
use taxel_core::garment::Layout;

/// Unit of a panel.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Unit {
    name: &'static str,
    /// Units per newton on a taxel.
    per_newton: f64,
}

const COUNTS: Unit = Unit { name: "counts", per_newton: 0.0 };

/// Converts counts to pressure: `kPa` on the square of a taxel's pitch, `N` on the taxel if the pitch is
/// unknown, `counts` if newtons are unknown.
#[derive(Debug, Clone)]
pub struct Units {
    panels: Vec<Unit>,
    newtons: Option<Newtons>,
    /// Counts from which a taxel belongs to a contact.
    low: u16,
}

impl Units {
    /// The units of a garment with these newtons; counts without.
    pub fn new(layout: &Layout, low: u16, newtons: Option<Newtons>) -> Units {
        let panel = |(panel, area): (usize, &taxel_core::garment::Area)| {
            let known = newtons.as_ref().and_then(|newtons| newtons.taxel(panel, 0)).is_some();
            let [x, y] = area.pitch_um.map(|um| f64::from(um) / 1000.0);
            match (known, x * y > 0.0) {
                (true, true) => Unit { name: "kPa", per_newton: 1000.0 / (x * y) },
                (true, false) => Unit { name: "N", per_newton: 1.0 },
                (false, _) => COUNTS,
            }
        };
        let panels = layout.areas().iter().enumerate().map(panel).collect();
        Units { panels, newtons, low }
    }

    /// Unit of a panel.
    pub fn name(&self, panel: usize) -> &'static str {
        self.panels.get(panel).unwrap_or(&COUNTS).name
    }

    /// Basis of newtons; empty if they are unknown.
    pub fn basis(&self) -> &'static str {
        self.newtons.as_ref().and_then(Newtons::basis).map_or("", ForceBasis::as_str)
    }

    /// Force of a contact of an image, N; none if it is unknown.
    pub fn force(&self, layout: &Layout, image: &[u16], placed: &Placed) -> Option<f64> {
        self.newtons.as_ref()?.contact(layout, image, self.low, &placed.contact)
    }

    /// Value of a taxel of a panel, in its unit.
    pub fn value(&self, panel: usize, counts: u16) -> f64 {
        let unit = self.panels.get(panel).unwrap_or(&COUNTS);
        let newtons = self.newtons.as_ref().and_then(|newtons| newtons.taxel(panel, counts));
        newtons.filter(|_| *unit != COUNTS).map_or(counts.into(), |newtons| unit.per_newton * newtons)
    }
}
