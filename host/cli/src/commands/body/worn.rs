//! A body and the garment that it wears.

use anyhow::Result;
use clap::Args;
use taxel::files::garments;
use taxel_core::capacity::TAXELS;
use taxel_core::garment::{Garment, Layout};

/// A body and its garment.
#[derive(Debug, Clone, Args)]
pub struct WornArgs {
    /// The body: a TOML file or `reference`
    pub body: String,
    /// The garment that it wears: a TOML file or a preset
    #[arg(long, value_name = "G", default_value = "reference")]
    pub garment: String,
}

impl WornArgs {
    /// Reads the garment.
    pub fn garment(&self) -> Result<(Garment, Layout)> {
        let garment = garments::read(&self.garment)?;
        let layout = Layout::build(&garment.garment, TAXELS, u16::MAX).map_err(|e| garment.error(&e))?;
        Ok((garment.garment, layout))
    }
}
