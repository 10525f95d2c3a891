//! Units of pressure in exports.

use anyhow::{Context, Result};
use taxel::files::calibrate::{Calibration, Forces};
use taxel::record::CALIBRATION;
use taxel::recording::{BoardRecording, Overview};
use taxel_core::garment::Layout;

/// A recording's scale of force.
#[derive(Debug, Default, Clone)]
pub struct Scale {
    calibration: Option<Calibration>,
    counts_per_newton: Option<f64>,
}

impl Scale {
    /// The attached calibration, else the counts per newton of its source.
    pub fn of(overview: &Overview, recording: &BoardRecording) -> Result<Scale> {
        let attached = overview.attached(&recording.attachment(CALIBRATION))?;
        let name = format!("{CALIBRATION} of {recording}");
        let parsed = attached.map(|bytes| {
            let text = String::from_utf8(bytes).with_context(|| format!("{name} is not text"))?;
            anyhow::Ok(Calibration::parse(&text, &name)?)
        });
        let counts_per_newton = overview.counts_per_newton(recording.board.as_deref());
        Ok(Scale { calibration: parsed.transpose()?, counts_per_newton })
    }

    /// Units for a garment whose board reports this calibration.
    pub fn on(&self, layout: &Layout, in_force: &str) -> Result<Units> {
        let made = self.calibration.as_ref().filter(|made| made.is_in_force(in_force));
        // The curves of a calibration are more exact than their mean.
        let counts_per_newton = self.counts_per_newton.filter(|_| made.is_none());
        let forces = made.map(|made| Forces::new(made, layout)).transpose()?;
        let panel = |(panel, area): (usize, &taxel_core::garment::Area)| {
            let known = counts_per_newton.is_some()
                || forces.as_ref().is_some_and(|forces| forces.taxel(panel, 0).is_some());
            let [x, y] = area.pitch_um.map(|um| f64::from(um) / 1000.0);
            match (known, x * y > 0.0) {
                (true, true) => Unit { name: "kPa", per_newton: 1000.0 / (x * y) },
                (true, false) => Unit { name: "N", per_newton: 1.0 },
                (false, _) => COUNTS,
            }
        };
        let panels = layout.areas().iter().enumerate().map(panel).collect();
        Ok(Units { panels, forces, counts_per_newton })
    }
}

/// Unit of a panel.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Unit {
    name: &'static str,
    /// Units per newton on a taxel.
    per_newton: f64,
}

const COUNTS: Unit = Unit { name: "counts", per_newton: 0.0 };

/// Converts counts to pressure: `kPa` on the square of a taxel's pitch, `N` on the taxel if the pitch is
/// unknown, `counts` if the counts per newton are unknown.
#[derive(Debug, Clone)]
pub struct Units {
    panels: Vec<Unit>,
    forces: Option<Forces>,
    counts_per_newton: Option<f64>,
}

impl Units {
    /// Counts without conversion.
    pub fn counts(layout: &Layout) -> Units {
        Units { panels: vec![COUNTS; layout.areas().len()], forces: None, counts_per_newton: None }
    }

    /// Unit of a panel.
    pub fn name(&self, panel: usize) -> &'static str {
        self.panels.get(panel).unwrap_or(&COUNTS).name
    }

    /// Converts a sum of counts to newtons; none if there is no single scale.
    pub fn newtons(&self, total: u32) -> Option<f64> {
        self.counts_per_newton.map(|per_newton| f64::from(total) / per_newton)
    }

    /// Value of a taxel of a panel, in its unit.
    pub fn value(&self, panel: usize, counts: u16) -> f64 {
        let unit = self.panels.get(panel).unwrap_or(&COUNTS);
        if *unit == COUNTS {
            return counts.into();
        }
        let curve = self.forces.as_ref().and_then(|forces| forces.taxel(panel, counts));
        let straight = self.counts_per_newton.map(|per_newton| f64::from(counts) / per_newton);
        unit.per_newton * curve.or(straight).unwrap_or(0.0)
    }
}
