//! Labelled images, named on the command line.

use std::path::PathBuf;
use taxel::files::bases::view::{self, Choice};
use taxel::learn::shapes::classes::Classes;
use taxel::learn::shapes::data::Images;

/// Source of labelled images.
#[derive(Debug, Clone, clap::Args)]
pub struct ImagesArgs {
    /// Images: .npz or .npy, one touch each
    #[arg(long, value_name = "FILE")]
    pub images: PathBuf,
    /// Their classes: CSV with a column `index` and one of names
    #[arg(long, value_name = "CSV")]
    pub labels: Option<PathBuf>,
    /// Sets to use of a file that holds NAME_img and NAME_label; * stands for any text
    #[arg(long, value_name = "NAME")]
    pub set: Vec<String>,
    /// Classes to keep, as NAME or NAME=GROUP with commas; or one of `three`, `groups`
    #[arg(long, value_name = "LIST", default_value = "all")]
    pub classes: Classes,
    /// Which part of an image is the touch.
    #[command(flatten)]
    pub view: SheetArgs,
}

/// Options of the command line.
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

impl ImagesArgs {
    /// The images that the arguments name.
    pub fn images(&self) -> Images {
        let SheetArgs { threshold, touch } = self.view;
        Images {
            images: self.images.clone(),
            labels: self.labels.clone(),
            set: self.set.clone(),
            classes: self.classes.clone(),
            view: Choice { threshold, touch: touch.map(view::Which::from) },
        }
    }
}
