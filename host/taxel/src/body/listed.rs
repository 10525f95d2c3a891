//! Lists of taxels' places, a line each: measured by others.

use crate::error::{Result, SettingError};
use glam::DVec3;

/// Place and normal of a taxel, if it has them.
pub type Listed = Option<(DVec3, DVec3)>;

/// Heading that begins the taxels of an iCub position file.
const CALIBRATION: &str = "[calibration]";
/// Normals of lists need not be exactly of length 1.
const LENGTHS: std::ops::RangeInclusive<f64> = 0.9..=1.1;

/// Reads a list of taxels: `x y z nx ny nz` a line, in metres, separated by blanks or commas, in the order of
/// the panel's taxels, row by row. A line of zeros is a taxel without a place. Empty lines and those that
/// begin with `#` do not count. iCub's position files are read as well: of these the lines below
/// `[calibration]` count. Errors name the line.
pub fn listed(name: &str, text: &str) -> Result<Vec<Listed>, SettingError> {
    let begins = text.lines().position(|line| line.trim() == CALIBRATION).map_or(0, |line| line + 1);
    let mut list = Vec::new();
    for (number, line) in text.lines().enumerate().skip(begins) {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        if line.starts_with('[') {
            // The next part of an iCub file.
            break;
        }
        let wrong =
            |what: &str| SettingError::Malformed(format!("{name}, line {}: {what}: {line:?}", number + 1));
        let numbers: Result<Vec<f64>, _> =
            line.split([' ', '\t', ',', ';']).filter(|part| !part.is_empty()).map(str::parse).collect();
        let numbers = numbers.map_err(|_| wrong("not numbers"))?;
        let [x, y, z, nx, ny, nz] = numbers[..] else { return Err(wrong("not six numbers: x y z nx ny nz")) };
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err(wrong("not finite"));
        }
        let (at, normal) = (DVec3::new(x, y, z), DVec3::new(nx, ny, nz));
        if at == DVec3::ZERO && normal == DVec3::ZERO {
            list.push(None);
            continue;
        }
        if !LENGTHS.contains(&normal.length()) {
            return Err(wrong("the normal must have a length of 1"));
        }
        list.push(Some((at, normal.normalize())));
    }
    Ok(list)
}
