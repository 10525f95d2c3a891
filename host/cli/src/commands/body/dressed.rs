//! A body and its garment.

use anyhow::Result;
use clap::Args;
use taxel::files::garments;
use taxel_core::capacity::TAXELS;
use taxel_core::garment::{Garment, Layout};

/// A body and its garment.
#[derive(Debug, Clone, Args)]
pub struct DressedArgs {
    /// The body: a TOML file or `reference`
    pub body: String,
    /// Its garment: a TOML file or a preset
    #[arg(long, value_name = "G", default_value = "reference")]
    pub garment: String,
}

impl DressedArgs {
    /// Reads the garment.
    pub fn garment(&self) -> Result<(Garment, Layout)> {
        let garment = garments::read(&self.garment)?;
        let layout = Layout::build(&garment.garment, TAXELS, u16::MAX).map_err(|e| garment.error(&e))?;
        Ok((garment.garment, layout))
    }
}
