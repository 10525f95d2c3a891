//! How the panels of a garment lie on the robot.

use anyhow::{Result, bail};
use serde_json::json;
use std::fmt::Write;
use taxel::body::robot::Robot;
use taxel::body::{Fit, Surface};
use taxel_core::garment::Layout;

/// A table with a line for each panel and one for the robot, or JSON of the panels. Error if two panels lie on
/// each other.
pub fn told(layout: &Layout, surface: &Surface, robot: Option<&Robot>, is_json: bool) -> Result<String> {
    if let Some((one, other)) = surface.overlap(layout) {
        bail!("the panels {one} and {other} lie on each other");
    }
    let fits = surface.fits(layout);
    let link = |fit: &Fit| surface.links()[fit.link].as_str();
    if is_json {
        let fit = |fit: &Fit| {
            let pitch = fit.pitch.as_ref().map(|pitch| [*pitch.start(), *pitch.end()]);
            json!({ "panel": fit.panel, "link": link(fit), "taxels": fit.taxels, "pitch": pitch })
        };
        return Ok(format!("{}\n", fits.iter().map(fit).collect::<serde_json::Value>()));
    }
    let panels = layout.areas();
    let name = panels.iter().map(|area| area.name.chars().count()).max().unwrap_or(0);
    let wide = surface.links().iter().map(|link| link.chars().count()).max().unwrap_or(0);
    let mut text = String::new();
    for area in panels {
        let _ = match fits.iter().find(|fit| fit.panel == *area.name) {
            Some(fit) => {
                let apart = fit.pitch.as_ref().map_or(String::new(), |pitch| {
                    format!(", neighbours at {:.3} to {:.3} of their pitch", pitch.start(), pitch.end())
                });
                writeln!(text, "{:name$}  on {:wide$}  {:>4} taxels{apart}", fit.panel, link(fit), fit.taxels)
            }
            None => writeln!(text, "{:name$}  has no patch: its taxels have no place", area.name),
        };
    }
    if let Some(robot) = robot {
        let (links, joints, free) = (robot.links(), robot.joints().len(), robot.free().len());
        let base = links.first().map_or("", |base| base.name.as_str());
        let file = robot.file();
        let _ = writeln!(
            text,
            "robot {file}: {} links, base {base}; {joints} joints, {free} with a position of their own",
            links.len()
        );
    }
    Ok(text)
}
