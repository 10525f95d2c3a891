//! Fit of a garment's panels on the robot.

use serde_json::{Value, json};
use std::fmt::Write;
use taxel::body::robot::Robot;
use taxel::body::{Fit, Surface};
use taxel_core::garment::Layout;

/// A table with a line for each panel and each region, and one for the robot, or JSON of panels and regions.
pub fn text(layout: &Layout, surface: &Surface, robot: Option<&Robot>, is_json: bool) -> String {
    let fits = surface.fits(layout);
    let link = |fit: &Fit| surface.links()[fit.link].as_str();
    if is_json {
        let fit = |fit: &Fit| {
            let pitch = fit.pitch.as_ref().map(|pitch| [*pitch.start(), *pitch.end()]);
            json!({ "panel": fit.panel, "link": link(fit), "taxels": fit.taxels, "pitch": pitch })
        };
        let (panels, regions) = (fits.iter().map(fit), regions(layout, surface));
        let region = |region: &RegionFit<'_>| {
            let RegionFit { name, link, taxels, square_metres } = region;
            json!({ "region": name, "link": link, "taxels": taxels, "area_m2": square_metres })
        };
        return format!("{}\n", panels.chain(regions.iter().map(region)).collect::<Value>());
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
                let first = usize::from(area.base);
                let of_panel = first..first + usize::from(area.rows) * usize::from(area.columns);
                let missing: Vec<usize> =
                    of_panel.filter(|taxel| surface.places()[*taxel].is_none()).collect();
                let without = match missing.is_empty() {
                    true => String::new(),
                    false => format!(", without a place: taxel {}", ranges(&missing)),
                };
                let (panel, taxels) = (&fit.panel, fit.taxels);
                writeln!(text, "{panel:name$}  on {:wide$}  {taxels:>4} taxels{without}{apart}", link(fit))
            }
            None => writeln!(text, "{:name$}  has no patch: its taxels have no place", area.name),
        };
    }
    for RegionFit { name, link, taxels, square_metres } in regions(layout, surface) {
        let (count, area) = (taxels.len(), square_metres * 1e4);
        let _ =
            writeln!(text, "region {name}, on {link}: {count} taxels, {area:.1} cm2: {}", ranges(&taxels));
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
    text
}

/// A region and what it holds.
struct RegionFit<'a> {
    name: &'a str,
    link: &'a str,
    taxels: Vec<usize>,
    /// Area of its taxels, a pitch wide and high each, m2.
    square_metres: f64,
}

fn regions<'a>(layout: &Layout, surface: &'a Surface) -> Vec<RegionFit<'a>> {
    let area = |taxel: &usize| {
        let [x, y] = layout.areas()[usize::from(layout.place(*taxel)?.panel)].pitch_um;
        Some(f64::from(x) * f64::from(y) * 1e-12)
    };
    let region = |(index, name): (usize, &'a String)| {
        let taxels = surface.of_region(index);
        let link = taxels
            .first()
            .and_then(|taxel| surface.places()[*taxel])
            .map_or("", |place| &surface.links()[place.link]);
        RegionFit { name, link, square_metres: taxels.iter().filter_map(area).sum(), taxels }
    };
    surface.regions().iter().enumerate().map(region).collect()
}

/// Numbers that rise, as ranges: `0-15, 32, 40-41`.
fn ranges(numbers: &[usize]) -> String {
    let runs = numbers.chunk_by(|a, b| a + 1 == *b).filter_map(|run| Some((run.first()?, run.last()?)));
    let said: Vec<String> =
        runs.map(|(a, b)| if a == b { a.to_string() } else { format!("{a}-{b}") }).collect();
    said.join(", ")
}
