//! The places of all taxels as CSV.

use super::surface::Surface;
use std::fmt::Write;

/// A line for each taxel: taxel, link, x, y, z, nx, ny, nz. Those without a place are left out.
pub fn text(surface: &Surface) -> String {
    let mut text = String::from("taxel,link,x,y,z,nx,ny,nz\n");
    for (taxel, place) in surface.places().iter().enumerate() {
        let Some(place) = place else { continue };
        let numbers = [place.at.to_array(), place.normal.to_array()].concat();
        // A micrometre is the last digit; 0 has no sign.
        let rounded = numbers.iter().map(|number| (number * 1e6).round() / 1e6 + 0.0);
        let numbers: Vec<String> = rounded.map(|number| format!("{number:.6}")).collect();
        let _ = writeln!(text, "{taxel},{},{}", surface.links()[place.link], numbers.join(","));
    }
    text
}
