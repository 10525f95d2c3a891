//! Assembles the page.

use super::seen::{Moment, Seen, of};
use super::strips::Strip;
use super::svg::escaped;
use super::{plane, ranges, surface, tables};
use crate::folding::FoldingLine;
use crate::palette;
use anyhow::{Result, bail};
use taxel_core::body::Placed;
use taxel_core::garment::Area;

/// Concepts whose activation never exceeds this are not drawn.
const QUIET: f64 = 0.02;

const STYLE: &str = "
:root{--paper:#fff;--ink:#1c2430;--soft:#5d6878;--quiet:#5d6878;--line:#d7dce3;--mark:#fff;--halo:#10151c}
@media(prefers-color-scheme:dark){:root{--paper:#12141a;--ink:#d8dee9;--soft:#97a1b3;--quiet:#97a1b3;--line:#2e3440}}
body{margin:2rem auto;max-width:1120px;padding:0 1rem;background:var(--paper);color:var(--ink);font:15px/1.45 system-ui,'DejaVu Sans',sans-serif}
h1{font-size:1.5rem;margin:0 0 .3rem}h2{font-size:1.15rem;margin:2rem 0 .4rem}p{margin:.3rem 0;max-width:75ch}
.panels{display:flex;flex-wrap:wrap;gap:12px}svg{max-width:100%;height:auto}svg text{fill:var(--ink);font-size:12px}svg .title{font-size:14px;font-weight:600}svg .mark{fill:var(--soft);font-size:10px}
.level{fill:none;stroke:#fff;stroke-opacity:.75;stroke-width:.7}.axis{stroke:#fff;stroke-width:1.6}.centre{fill:#fff;stroke:#000;stroke-width:.8}.fold{fill:none;stroke:#fff;stroke-width:1.2;stroke-opacity:.85}.peak{stroke:#e8123c;stroke-width:1.8;fill:none}svg .id{fill:#fff;font-weight:600;paint-order:stroke;stroke:#000;stroke-width:2.5px}
#surface,#robot{height:460px}.quiet{color:var(--soft)}
.line{fill:none;stroke-width:1.6;stroke-linejoin:round}.grid{stroke:var(--line);fill:none}
table{border-collapse:collapse;font-size:13px;font-variant-numeric:tabular-nums}td,th{padding:3px 12px 3px 0;text-align:left;border-bottom:1px solid var(--line)}th{color:var(--soft);font-weight:500}
.bar{display:inline-block;height:10px;margin-right:6px}.swatch{display:inline-block;width:16px;height:12px}pre{font-size:12.5px;overflow-x:auto;white-space:pre-wrap}.scroll{overflow-x:auto}
";

/// The page loads nothing, and sends nothing.
const POLICY: &str = "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
                      style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">";

/// Draws a panel from its values and contacts.
type Draw<'a> = &'a dyn Fn(&Area, &[u16], &[Placed]) -> String;

/// The report as HTML. Error if there was no image.
pub fn page(seen: &Seen) -> Result<String> {
    if seen.top.image.is_empty() {
        bail!("{}: no image was received, so there is nothing to report", seen.label);
    }
    let top = palette::end_of(&seen.hold);
    let Moment { time_us, total, image, contacts, folding, .. } = &seen.top;
    let moment = format!("{:.3} s", *time_us as f64 / 1e6);
    let limits = ranges::limits(top);
    let each = |draw: Draw<'_>| -> String {
        let panels = seen.areas().iter().zip(0u8..);
        let drawn = panels.map(|(area, panel)| {
            let here: Vec<_> = contacts.iter().filter(|c| c.contact.panel == panel).cloned().collect();
            draw(area, of(area, image), &here)
        });
        format!("<div class=\"panels\">\n{}</div>\n", drawn.collect::<String>())
    };
    let scale = seen.scale();
    let force = format!("{} {}", scale.text_of(*total as f64), scale.unit());
    let mut sections = vec![
        (
            "Pressure, 2-D",
            format!(
                "<p>At {moment}, the moment of the greatest force: {force} in {}. Lines are the limits of the ranges \
             below, dots centroids with the main axis, red crosses peaks; marks are taxels.{}</p>\n{}",
                if contacts.len() == 1 { "1 contact".into() } else { format!("{} contacts", contacts.len()) },
                folding.as_ref().map_or(String::new(), strokes),
                each(&|area, values, contacts| {
                    let folding = folding.as_ref().map_or(&[][..], |folding| &folding.taxels);
                    plane::draw(
                        area,
                        values,
                        top,
                        &plane::PlaneOverlay { contacts, folding, limits: &limits },
                    )
                })
            ),
        ),
        (
            "Pressure, 3-D",
            format!(
                "<p>The same moment; the number on each peak is that of its taxel, {}.</p>\n{}",
                scale.unit(),
                surface::draw(seen, top)
            ),
        ),
        ("Ranges of pressure", ranges::table(image, &seen.hold, top, scale)),
        ("Force over time", totals(seen)),
        ("Intention over time", intention(seen)),
        (
            "Contacts",
            format!(
                "<div class=\"scroll\" role=\"group\" aria-label=\"Contacts\" tabindex=\"0\">{}</div>\n",
                tables::contacts(seen)
            ),
        ),
        ("Events", tables::events(seen)),
        ("Health", tables::health(seen)),
    ];
    if seen.shown_robot.is_some() {
        let text = format!(
            "<p>The same moment: the panels on the robot in the same colours; an arrow for what presses there.</p>\n{}",
            surface::ROBOT
        );
        sections.insert(2, ("On the robot", text));
    }
    let body: String = sections.iter().map(|(title, text)| format!("<h2>{title}</h2>\n{text}")).collect();
    Ok(format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width\">{POLICY}<title>{0}</title><style>{STYLE}{1}</style></head><body>\n\
         <main>\n<h1>{0}</h1>\n{2}{body}</main></body></html>\n",
        escaped(&seen.label),
        surface::STYLE,
        head(seen)
    ))
}

/// The meaning of the strokes over taxels, as in `folds.js`.
fn strokes(FoldingLine { followed, taxels }: &FoldingLine) -> String {
    match (followed, taxels.len()) {
        (true, 0) => " The garment folds nowhere.".into(),
        (true, count) => format!(" Strokes: the garment folds here, {count} taxels."),
        (false, count) => {
            format!(" Strokes: the garment may fold here, {count} taxels; no posture was sent.")
        }
    }
}

/// Source, contents and duration.
fn head(seen: &Seen) -> String {
    let Some(description) = &seen.description else { return String::new() };
    let [first, last] = seen.totals.span();
    let calibration = match (description.calibration.as_str(), seen.counts_per_newton) {
        ("", None) => "none, pressure is in counts".into(),
        ("", Some(counts)) => format!("none, the source knows that {counts} counts are a newton"),
        (reported, _) => reported.to_string(),
    };
    let simulated = if description.is_simulated() { "simulated board, " } else { "" };
    let text = format!(
        "{simulated}{}; garment {} of {} taxels in {} panels, scene {}; calibration: {calibration}; {:.2} s, {} frames. \
         taxel {}.",
        description.firmware,
        description.garment.name,
        description.layout.taxels(),
        description.layout.areas().len(),
        description.scene.name,
        last.saturating_sub(first) as f64 / 1e6,
        seen.counts.frames,
        env!("CARGO_PKG_VERSION")
    );
    format!("<p>{}</p>\n", escaped(&text))
}

fn totals(seen: &Seen) -> String {
    let scale = seen.scale();
    let values = |totals: &[f64]| totals.iter().map(|total| scale.value(*total)).collect();
    Strip {
        names: seen.areas().iter().map(|area| area.name.as_str()).collect(),
        points: seen.totals.points().iter().map(|(time, totals)| (*time, values(totals))).collect(),
        label: &format!("total, {}", scale.unit()),
        steps: false,
        span: seen.totals.span(),
    }
    .draw()
}

fn intention(seen: &Seen) -> String {
    let loud = |index: &usize| {
        let values = seen.activations.points().iter().filter_map(|(_, values)| values.get(*index));
        values.map(|value| value.abs()).fold(0.0, f64::max) > QUIET
    };
    let shown: Vec<usize> = (0..seen.concepts.len()).filter(loud).collect();
    if shown.is_empty() {
        return "<p>No concept of the map was active.</p>\n".into();
    }
    let pick =
        |values: &[f64]| shown.iter().map(|index| values.get(*index).copied().unwrap_or(0.0)).collect();
    Strip {
        names: shown.iter().map(|index| seen.concepts[*index].as_str()).collect(),
        points: seen.activations.points().iter().map(|(time, values)| (*time, pick(values))).collect(),
        label: "activation",
        steps: true,
        span: seen.totals.span(),
    }
    .draw()
}
