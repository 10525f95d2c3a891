//! The table of stages and kernels as text and as JSON.

use super::format::FormRow;
use super::row::Row;
use crate::chart::{Axis, Better, Chart, Series};
use serde_json::{Value, json};
use std::fmt;
use taxel_core::pipeline::Stage;
use taxel_suite::pattern::TouchPattern;

/// All measurements of one place.
#[derive(Debug, Clone)]
pub struct Table {
    /// The place.
    pub place: String,
    /// `cycles` or `ns`.
    pub unit: &'static str,
    /// The whole chain.
    pub rows: Vec<Row>,
    /// Kernels.
    pub forms: Vec<FormRow>,
}

const HEADS: [&str; 10] =
    ["condition", "contact", "shape", "symbol", "react", "perceive", "encode", "all", "largest", "map"];

impl Table {
    /// JSON form.
    pub fn json(&self) -> Value {
        json!({
            "place": self.place,
            "unit": self.unit,
            "rows": self.rows.iter().map(Row::json).collect::<Vec<_>>(),
            "forms": self.forms.iter().map(FormRow::json).collect::<Vec<_>>(),
        })
    }

    /// Chart of the largest error over cost: formats by quantity, and the chain's variants on five contacts.
    pub fn chart(&self) -> Chart {
        let quantities = ["centroid_taxel", "nmi_relative", "azimuth_rad", "activation"];
        let mut series: Vec<Series> = quantities
            .into_iter()
            .map(|quantity| {
                let of = |row: &FormRow| {
                    let (_, error) = row.errors.iter().find(|(what, _)| *what == quantity)?;
                    let named =
                        format!("{}: {} {}, {:.1e}", row.form.form, row.cost, self.unit, error.largest);
                    Some((row.cost as f64, error.largest, named))
                };
                let name = quantity.replace('_', ", ");
                Series { name, points: self.forms.iter().filter_map(of).collect() }
            })
            .collect();
        let variants = self.rows.iter().filter(|row| row.name == TouchPattern::Five.name());
        let of = |row: &Row| {
            let [place, _] = row.error.as_ref()?;
            let named =
                format!("{}: {} {}, {:.1e}", row.variant.name(), row.whole(), self.unit, place.largest);
            Some((row.whole() as f64, place.largest, named))
        };
        let points = variants.filter_map(of).collect();
        series.push(Series { name: "chain: centroid, taxel".into(), points });
        Chart {
            title: format!("Error over cost: {}", self.place),
            x: Axis::new(&format!("{} a contact, a step of the map, a frame", self.unit), Better::Less),
            y: Axis::new("largest error", Better::Less),
            named: true,
            series,
        }
    }

    fn chain(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:13}{:11}", "scene", "variant")?;
        HEADS.iter().try_for_each(|head| write!(f, "{head:>10}"))?;
        write!(f, "{:>7}{:>9}{:>8}", "bytes", "contacts", "dropped")?;
        writeln!(f, "  {:>17}  {:>17}{:>8}", "centroid, taxel", "NMI, %", "stack")?;
        for row in &self.rows {
            write!(f, "{:13}{:11}", row.name, row.variant.name())?;
            let stages = [Stage::Condition, Stage::Contact, Stage::Shape, Stage::Symbol, Stage::React];
            let costs = stages.map(|stage| row.stage(stage));
            let (encode, map) = (row.stage(Stage::Encode), row.stage(Stage::Intent));
            let sums = [row.perceive(), encode, row.whole(), row.largest, map];
            costs.iter().chain(&sums).try_for_each(|cost| write!(f, "{cost:>10}"))?;
            write!(f, "{:>7}{:>9}{:>8}", row.bytes, row.contacts[0], row.contacts[1])?;
            match &row.error {
                Some([place, nmi]) => {
                    write!(f, "  {:>8.4} {:>8.4}", place.largest, place.rms())?;
                    write!(f, "  {:>8.3} {:>8.3}", nmi.largest * 100.0, nmi.rms() * 100.0)?;
                }
                None => write!(f, "{:38}", "")?,
            }
            writeln!(f, "{:>8}", stack(row.stack))?;
        }
        Ok(())
    }

    fn kernels(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:18}{:29}{:>10}{:>8}  errors: largest, rms", "kernel", "form", self.unit, "stack")?;
        for row in &self.forms {
            write!(f, "{:18}{:29}{:>10}{:>8}", row.form.what, row.form.form, row.cost, stack(row.stack))?;
            for (what, error) in &row.errors {
                write!(f, "  {what} {:.1e} {:.1e}", error.largest, error.rms())?;
            }
            writeln!(f)?;
        }
        Ok(())
    }
}

fn stack(bytes: Option<u64>) -> String {
    bytes.map_or("-".into(), |bytes| bytes.to_string())
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{}: {} a frame of 2,048 taxels, mean of 16 frames (32 while turning); 12 bit unless said.",
            self.place, self.unit
        )?;
        writeln!(
            f,
            "perceive: condition to reaction, without the map; all: with encoding and the board's own work,"
        )?;
        writeln!(
            f,
            "without the map; largest: the dearest frame; map: the mean of a frame, inferred or not."
        )?;
        writeln!(
            f,
            "Errors: against the exact moments of the same touch without noise and filter; largest and rms. Of several contacts that move the\n\
             NMI is up to as many frames old: their forms are looked at in turn.\n"
        )?;
        self.chain(f)?;
        writeln!(f, "\nmeasure: centroid, NMI and azimuth of one contact in a window of 16 x 16 taxels.\n")?;
        self.kernels(f)
    }
}
