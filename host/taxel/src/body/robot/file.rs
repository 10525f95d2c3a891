//! Files of robots.

use super::model::Robot;
use super::tree::tree;
use super::urdf::{document, parts};
use crate::error::{Context, Result, RobotError, UsageError};
use crate::files::input;
use crate::text::words;
use std::borrow::Cow;
use std::path::Path;

/// Names and texts of the presets.
const PRESETS: [(&str, &str); 1] = [("reference", include_str!("../../../bodies/reference.urdf"))];

/// Reads the text of a URDF; `file` is what errors name, together with the line, and the link or the joint.
///
/// Read are links, and joints that are fixed, revolute, continuous or prismatic, with origin, axis, limits
/// and mimic. Masses, shapes, transmissions and extensions are passed over.
pub fn parse(file: &str, text: &str) -> Result<Robot, RobotError> {
    let document = document(file, text)?;
    let (links, joints) = parts(file, &document)?;
    tree(file, &links, &joints)
}

/// Reads the robot of a preset (`reference`), or a URDF file.
pub fn read(name_or_path: &str) -> Result<Robot> {
    Ok(parse(name_or_path, &text(name_or_path)?)?)
}

/// The text of a preset, or of a URDF file.
pub(in crate::body) fn text(name_or_path: &str) -> Result<Cow<'static, str>> {
    if let Some((_, text)) = PRESETS.iter().find(|(preset, _)| *preset == name_or_path) {
        return Ok(Cow::Borrowed(text));
    }
    let path = Path::new(name_or_path);
    if path.extension().is_none() && !path.is_file() {
        let unknown = words::unknown("robot", name_or_path, PRESETS.map(|(preset, _)| preset));
        fail!(UsageError::Unknown, "{unknown}, or give a .urdf file");
    }
    let text = input::text(path).with_context(|| format!("cannot read {}", path.display()))?;
    Ok(Cow::Owned(text))
}
