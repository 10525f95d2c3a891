//! A taxel, named on the command line.

use crate::fault::Fault;
use anyhow::{Result, anyhow};
use std::str::FromStr;
use taxel::client::Client;
use taxel_core::garment::Place;

/// `PANEL,ROW,COL`; the panel by name or number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TaxelPlace {
    /// Name or number of the panel.
    pub panel: String,
    /// Row, from 0.
    pub row: u16,
    /// Column, from 0.
    pub column: u16,
}

impl FromStr for TaxelPlace {
    type Err = String;

    fn from_str(text: &str) -> Result<TaxelPlace, String> {
        let parts: Vec<_> = text.split(',').map(str::trim).collect();
        let number =
            |text: &str| text.parse::<u16>().map_err(|_| format!("\"{text}\" is not a row or column"));
        match parts[..] {
            [panel, row, column] if !panel.is_empty() => {
                Ok(TaxelPlace { panel: panel.into(), row: number(row)?, column: number(column)? })
            }
            _ => Err("it takes a panel, a row and a column: back,0,15".into()),
        }
    }
}

impl TaxelPlace {
    /// Number of the taxel on a client's garment.
    pub fn taxel(&self, client: &Client) -> Result<usize> {
        let layout = client.layout().ok_or_else(|| anyhow!("the garment is not known"))?;
        let names = layout.areas().iter().position(|area| area.name == self.panel.as_str());
        let panel = names.or_else(|| self.panel.parse().ok()).unwrap_or(usize::MAX);
        let area = layout.areas().get(panel).ok_or_else(|| {
            let known: Vec<_> = layout.areas().iter().map(|area| area.name.as_str()).collect();
            let known = known.join(", ");
            Fault::usage(format!("--taxel: the garment has no panel {}; known are {known}", self.panel))
        })?;
        layout.taxel(Place { panel: panel as u8, row: self.row, column: self.column }).ok_or_else(|| {
            let (rows, columns) = (area.rows, area.columns);
            let known = format!("--taxel: panel {} has {rows} rows and {columns} columns, from 0", area.name);
            Fault::usage(known).into()
        })
    }
}
