//! The image by each toolchain: whether it is available, the size of the image, and the cost of a frame.

use crate::cross::{Toolchain, Way};
use crate::{firmware, install, no_panic, process, sizes, targets};
use std::path::Path;

/// Least number of toolchains that must be available, to show that the choice does not matter.
const LEAST: usize = 2;

/// Builds and measures with all available toolchains, and names the others.
pub fn measured(log: &Path) -> Result<Vec<String>, String> {
    install::emulator()?;
    let mut lines = Vec::new();
    let mut ran = 0;
    for way in Way::ALL {
        match Toolchain::by(way) {
            Ok(toolchain) => {
                lines.extend(one(way, &toolchain, log).map_err(|why| format!("{}: {why}", way.name()))?);
                ran += 1;
            }
            Err(why) => lines.push(format!("{}: not run: {why}", way.name())),
        }
    }
    if ran < LEAST { Err(format!("only {ran} of {} ways could be run", Way::ALL.len())) } else { Ok(lines) }
}

fn one(way: Way, toolchain: &Toolchain, log: &Path) -> Result<Vec<String>, String> {
    let image = firmware::image(toolchain, log)?;
    sizes::check(&image)?;
    no_panic::by(toolchain, log)?;
    let log = log.with_extension(format!("{}.log", way.name()));
    let _ = std::fs::remove_file(&log);
    process::run_into(firmware::bench_command(toolchain).arg("--locked"), &log)?;
    process::run_into(targets::measuring(toolchain)?.arg("--check"), &log)?;
    let text = std::fs::read_to_string(&log).map_err(|error| format!("{}: {error}", log.display()))?;
    let bars = text.lines().filter(|line| line.contains(" of at most ")).map(|line| format!("  {line}"));
    let [flash, ram] = image.sizes().map(|bytes| bytes as f64 / 1024.0);
    let head =
        format!("{}: {}: flash {flash:.1} KiB, RAM {ram:.1} KiB, no panic", way.name(), image.compiler);
    Ok(std::iter::once(head).chain(bars).collect())
}
