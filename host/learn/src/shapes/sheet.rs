//! Options for what of an image is the touch.

use taxel::files::bases::view::{self, Choice};

/// Which part of an image is the touch.
#[derive(Debug, Default, Clone, clap::Args)]
pub struct SheetArgs {
    /// Smallest value of a touched taxel, counts [default: that of the base, or 1/32 of the full scale]
    #[arg(long, value_name = "COUNTS")]
    pub threshold: Option<u16>,
    /// Which touched taxels: all, or the connected ones with the greatest total [default: that of the base,
    /// or all]
    #[arg(long, value_name = "WHICH")]
    pub touch: Option<Which>,
}

/// [`view::Which`] on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Which {
    /// All of them.
    All,
    /// The part, connected over sides and corners, with the greatest total: a contact.
    Greatest,
}

impl From<Which> for view::Which {
    fn from(which: Which) -> view::Which {
        match which {
            Which::All => view::Which::All,
            Which::Greatest => view::Which::Greatest,
        }
    }
}

impl SheetArgs {
    /// The choice that the options make.
    pub fn choice(&self) -> Choice {
        Choice { threshold: self.threshold, touch: self.touch.map(view::Which::from) }
    }
}
