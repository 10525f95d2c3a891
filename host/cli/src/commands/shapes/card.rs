//! `taxel shapes card`: prints the origin of a base, and where it fails.

use anyhow::Result;
use std::path::{Path, PathBuf};
use taxel::files::bases::{Base, ImagesFile};
use taxel::learn::confusion::Confusion;

/// Arguments of `taxel shapes card`.
#[derive(Debug, Clone, clap::Args)]
pub struct CardArgs {
    /// Base: a file, or the name of a shipped base
    pub base: PathBuf,
}

/// Runs the command.
pub fn run(args: CardArgs) -> Result<()> {
    print!("{}", text(&args.base, &Base::open(&args.base)?));
    Ok(())
}

fn text(path: &Path, base: &Base) -> String {
    let gallery = &base.gallery;
    let source = |source: &ImagesFile| {
        let sets =
            if source.sets.is_empty() { String::new() } else { format!(", sets {}", source.sets.join(" ")) };
        match source.fingerprint.as_str() {
            "" => format!("  {} touches of {}\n", source.images, source.file),
            print => format!("  {} images of {} ({print}){sets}\n", source.images, source.file),
        }
    };
    let names = base.names();
    let confusion = Confusion { counts: base.card.confusion.clone(), ..Confusion::new(&names, &names) };
    let view = base.view;
    [
        format!("{}\n\nData\n", path.display()),
        base.trained_on.iter().map(source).collect(),
        format!("  touch: {:?} taxels from {} counts on\n", view.touch, view.threshold).to_lowercase(),
        format!(
            "\nModel\n  {} prototypes of {} classes in {} dimensions, {} neighbours vote\n",
            gallery.prototypes.len(),
            names.len(),
            gallery.space.weights.len(),
            gallery.k
        ),
        format!(
            "  farther than {:.1} spreads of a class from all of them: none\n",
            f64::from(gallery.reject) / 256.0
        ),
        format!(
            "\nWorth\n  {:.1} % right in {}; of each class, and what it was taken for:\n",
            100.0 * base.card.accuracy,
            base.card.split
        ),
        confusion.table().lines().map(|line| format!("  {line}\n")).collect(),
    ]
    .concat()
}
