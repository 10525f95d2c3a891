//! The taxels on the robot as SVG: each link, or the whole robot, from three sides.

use crate::report::svg::{escaped, line};
use std::fmt::Write;
use taxel::body::{DVec3, Surface, TaxelPlace};
use taxel_core::garment::Layout;

/// A side from which a link is seen: its name, the directions to the right and up, and that to the viewer.
struct Side {
    name: &'static str,
    right: DVec3,
    up: DVec3,
    toward: DVec3,
}

/// Sides of a link whose frame is as usual: x forward, y to the left, z up.
const SIDES: [Side; 3] = [
    Side { name: "from the front", right: DVec3::Y, up: DVec3::Z, toward: DVec3::X },
    Side { name: "from the left", right: DVec3::NEG_X, up: DVec3::Z, toward: DVec3::Y },
    Side { name: "from behind", right: DVec3::NEG_Y, up: DVec3::Z, toward: DVec3::NEG_X },
];

/// Width and height of a picture of one side, SVG units, and of the text above it.
const SIDE: [f64; 2] = [300.0, 300.0];
const TEXT: f64 = 24.0;

/// Rings around the taxels of regions, in turn: neighbours differ.
const RINGS: [&str; 3] = [
    " stroke=\"#000\" stroke-width=\"0.8\"",
    " stroke=\"#000\" stroke-width=\"0.8\" stroke-dasharray=\"2 1\"",
    " stroke=\"#777\" stroke-width=\"0.8\"",
];

/// A taxel as it is drawn.
struct Dot {
    panel: usize,
    /// Two fifths of the pitch, m.
    radius: f64,
    place: TaxelPlace,
}

/// The picture: a row for each link, or one for all in the frame of one; a colour for each panel. The taxels
/// of regions are ringed, with the region's name at their middle. Taxels that face away are not drawn.
pub fn picture(layout: &Layout, surface: &Surface, frame: Option<&str>) -> String {
    let rows: Vec<(String, Option<usize>)> = match frame {
        Some(frame) => vec![(format!("in the frame of {frame}"), None)],
        None => surface.links().iter().enumerate().map(|(link, name)| (name.clone(), Some(link))).collect(),
    };
    let (width, height) = (SIDE[0] * SIDES.len() as f64, (SIDE[1] + TEXT) * rows.len() as f64);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    for (row, (name, link)) in rows.iter().enumerate() {
        let top = (SIDE[1] + TEXT) * row as f64;
        let is_of_row = |dot: &Dot| link.is_none_or(|link| dot.place.link == link);
        let dots: Vec<Dot> = dots(layout, surface).filter(is_of_row).collect();
        let none = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let places = dots.iter().map(|dot| dot.place.at);
        let (least, most) = places.fold(none, |(least, most), at| (least.min(at), most.max(at)));
        let scale = 0.9 * SIDE[0].min(SIDE[1]) / (most - least).max_element().max(1e-3);
        for (index, side) in SIDES.iter().enumerate() {
            let left = SIDE[0] * index as f64;
            let title = format!("{} {}", escaped(name), side.name);
            let _ = writeln!(svg, "<text x=\"{}\" y=\"{}\">{title}</text>", left + 8.0, top + 16.0);
            let origin = [left + SIDE[0] / 2.0, top + TEXT + SIDE[1] / 2.0];
            draw(&mut svg, &dots, side, (least + most) / 2.0, (origin, scale));
            label(&mut svg, surface, &dots, side, (least + most) / 2.0, (origin, scale));
        }
    }
    svg + "</svg>\n"
}

/// The taxels that have a place.
fn dots(layout: &Layout, surface: &Surface) -> impl Iterator<Item = Dot> {
    surface.places().iter().enumerate().filter_map(|(taxel, place)| {
        let panel = usize::from(layout.place(taxel)?.panel);
        let pitch = layout.areas()[panel].pitch_um.into_iter().min().unwrap_or(0);
        Some(Dot { panel, radius: f64::from(pitch) * 0.4e-6, place: (*place)? })
    })
}

/// Draws the taxels that face this side, those farther away first; paler where they are seen askew.
fn draw(svg: &mut String, dots: &[Dot], side: &Side, middle: DVec3, (origin, scale): ([f64; 2], f64)) {
    let depth = |dot: &Dot| dot.place.at.dot(side.toward);
    let mut seen: Vec<&Dot> = dots.iter().filter(|dot| dot.place.normal.dot(side.toward) > 0.0).collect();
    seen.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    for Dot { panel, radius, place } in seen {
        let [x, y] = drawn(place.at - middle, side, (origin, scale));
        let ring = place.region.map_or("", |region| RINGS[region % RINGS.len()]);
        let _ = writeln!(
            svg,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{:.1}\" fill=\"{}\" fill-opacity=\"{:.2}\"{ring}/>",
            radius.max(1e-3) * scale,
            line("", *panel).0,
            0.3 + 0.7 * place.normal.dot(side.toward),
        );
    }
}

/// Writes the name of each region at the middle of its taxels that face this side.
fn label(
    svg: &mut String,
    surface: &Surface,
    dots: &[Dot],
    side: &Side,
    middle: DVec3,
    (origin, scale): ([f64; 2], f64),
) {
    for (region, name) in surface.regions().iter().enumerate() {
        let is_seen =
            |dot: &&Dot| dot.place.region == Some(region) && dot.place.normal.dot(side.toward) > 0.0;
        let seen: Vec<DVec3> = dots.iter().filter(is_seen).map(|dot| dot.place.at).collect();
        if seen.is_empty() {
            continue;
        }
        let at = seen.iter().sum::<DVec3>() / seen.len() as f64;
        let [x, y] = drawn(at - middle, side, (origin, scale));
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\" paint-order=\"stroke\" stroke=\"#fff\" \
             stroke-width=\"3\">{}</text>",
            escaped(name)
        );
    }
}

/// Returns where a point is drawn that is so far from the middle, m.
fn drawn(from_middle: DVec3, side: &Side, ([x, y], scale): ([f64; 2], f64)) -> [f64; 2] {
    [x + from_middle.dot(side.right) * scale, y - from_middle.dot(side.up) * scale]
}
