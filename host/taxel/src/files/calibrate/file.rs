//! Calibration files: data, author, date, method, and quality of the fit.

use super::curve::Curve;
use super::fit::Fitted;
use super::reading::Rest;
use super::residuals::{OfWeight, Residuals};
use crate::error::{Context, Result, SettingError};
use crate::files::input;
use crate::files::output::Output;
use crate::text::date;
use serde::{Deserialize, Serialize};
use std::path::Path;
use taxel_core::condition::Certificate;
use taxel_core::garment::Layout;

/// A calibration of a garment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Calibration {
    /// CRC-32/ISO-HDLC of gains and curves, eight hexadecimal digits.
    pub id: String,
    /// Name of the garment.
    pub garment: String,
    /// Author.
    pub by: String,
    /// Date, year-month-day.
    pub date: String,
    /// Plates and weights used.
    pub how: String,
    /// Firmware and link of the board.
    pub board: String,
    /// Temperature of the board's converter at the calibration, degrees; none if it has no thermometer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub celsius: Option<f64>,
    /// Quality of the fit.
    pub fit: Residuals,
    /// Error at each weight.
    #[serde(default, rename = "weight")]
    pub weights: Vec<OfWeight>,
    /// Taxels that do not respond.
    pub silent: Vec<u16>,
    /// Gain by taxel number, Q4.12, as sent to the board.
    pub gains: Vec<u16>,
    /// Code at rest by taxel number, at the calibration.
    pub rest: Vec<u16>,
    /// Curves, used by the host.
    #[serde(rename = "panel")]
    pub panels: Vec<PanelCurve>,
}

/// The curve of a panel.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PanelCurve {
    /// Name of the panel.
    pub name: String,
    /// `[1/16 count above rest after the gain, uN on a taxel]`
    pub knots: Curve,
}

impl Calibration {
    /// Builds a calibration from a fit; `about` is author, date, method and board.
    pub fn of(fitted: Fitted, layout: &Layout, rest: &Rest, about: [&str; 4]) -> Calibration {
        let named = layout.areas().iter().zip(fitted.curves);
        let curve = |(area, curve): (&taxel_core::garment::Area, Option<Curve>)| {
            curve.map(|knots| PanelCurve { name: area.name.as_str().into(), knots })
        };
        let [garment, by, how, board] = about.map(String::from);
        let mut made = Calibration {
            id: String::new(),
            garment,
            by,
            date: date::today(),
            how,
            board,
            celsius: None,
            fit: Residuals { rest: rest.noise, ..fitted.residuals },
            weights: fitted.weights,
            silent: fitted.silent,
            gains: fitted.gains,
            rest: rest.codes.iter().map(|code| code.round() as u16).collect(),
            panels: named.filter_map(curve).collect(),
        };
        made.id = format!("{:08x}", made.sum());
        made
    }

    fn sum(&self) -> u32 {
        let mut digest = crc32fast::Hasher::new();
        self.gains.iter().for_each(|gain| digest.update(&gain.to_le_bytes()));
        for panel in &self.panels {
            digest.update(panel.name.as_bytes());
            panel.knots.knots().iter().flatten().for_each(|number| digest.update(&number.to_le_bytes()));
        }
        digest.finalize()
    }

    /// Reads and checks a file. Errors name the file, and line and key if known.
    pub fn read(file: &Path) -> Result<Calibration> {
        let name = file.display().to_string();
        let text = input::text(file).with_context(|| format!("{name} cannot be read"))?;
        Calibration::parse(&text, &name)
    }

    /// Parses and checks the text of a file with this name.
    pub fn parse(text: &str, name: &str) -> Result<Calibration> {
        let read: Calibration = toml::from_str(text)
            .map_err(|error| SettingError::Malformed(crate::text::words::toml(&error, text, name)))?;
        read.check().with_context(|| name.to_string())?;
        Ok(read)
    }

    fn check(&self) -> Result<()> {
        for panel in &self.panels {
            Curve::new(panel.knots.knots().to_vec())
                .with_context(|| format!("panel {}: knots", panel.name))?;
        }
        require!(
            self.rest.len() == self.gains.len(),
            SettingError::Calibration,
            "`rest` and `gains` must have the same length"
        );
        require!(
            date::parts(&self.date).is_some(),
            SettingError::Calibration,
            "`date` must be a day, such as 2026-11-21"
        );
        require!(
            self.fit.error.is_finite() && self.fit.error >= 0.0,
            SettingError::Calibration,
            "`fit.error` must be 0 or more"
        );
        require!(
            self.id == format!("{:08x}", self.sum()),
            SettingError::Calibration,
            "`id` does not match the gains and knots: the file was changed"
        );
        Ok(())
    }

    /// The file's text.
    pub fn text(&self) -> Result<String> {
        toml::to_string(self).context("the calibration cannot be written as TOML")
    }

    /// Writes the file.
    pub fn write(&self, file: &Path) -> Result<()> {
        Output::update(file)?.write(self.text()?.as_bytes())
    }

    /// Certificate sent to the board.
    pub fn certificate(&self) -> Certificate {
        let (year, month, day) = date::parts(&self.date).unwrap_or((2000, 1, 1));
        let error = (self.fit.error * 10_000.0).round().clamp(0.0, 65_535.0) as u16;
        Certificate { id: self.sum(), taxels: self.gains.len() as u16, year, month, day, error }
    }

    /// Counts per newton, mean over the panels: exact only if their curves are straight and alike.
    pub fn counts_per_newton(&self) -> Option<f32> {
        let each = self.panels.iter().map(|panel| panel.knots.counts_per_newton());
        (!self.panels.is_empty()).then(|| (each.sum::<f64>() / self.panels.len() as f64) as f32)
    }

    /// True if a board with this description of its calibration uses this one.
    pub fn is_in_force(&self, reported: &str) -> bool {
        reported.starts_with(&format!("id {},", self.id))
    }
}
