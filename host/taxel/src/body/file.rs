//! Body files.

use super::config::Body;
use super::fit::{BodyFit, KnownTouch, PatchFit, fit, written};
use super::form::Form;
use super::listed::{Listed, listed};
use super::on_robot::RobotSurface;
use super::robot::Robot;
use super::surface::Surface;
use crate::error::{Context, Error, Result, SettingError, UsageError};
use crate::files::input;
use crate::text::{toml_key, words};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use taxel_core::garment::{Garment, Layout};

/// Names and texts of the presets.
const PRESETS: [(&str, &str); 1] = [("reference", include_str!("../../bodies/reference.toml"))];

/// A body's file, and those that it names.
#[derive(Debug, Clone)]
pub struct ReadBody {
    /// Path of the file, or name of the preset.
    pub name: String,
    text: String,
    /// The body, unchecked.
    pub body: Body,
    /// The lists of taxels, by patch.
    listed: Vec<(usize, Vec<Listed>)>,
    /// Their files.
    lists: Vec<PathBuf>,
}

impl ReadBody {
    /// The lists of taxels that were read, too.
    pub fn lists(&self) -> impl Iterator<Item = &Path> {
        self.lists.iter().map(PathBuf::as_path)
    }

    /// Places the taxels of a garment. Errors name file, line and key.
    pub fn surface(&self, garment: &Garment, layout: &Layout) -> Result<Surface> {
        let surface = Surface::build_with(&self.body, garment, layout, &self.listed, &[]);
        surface.map_err(|error| self.error(error))
    }

    /// [`ReadBody::surface`] on a robot: refuses links and joints that it does not have, by file, line and
    /// key.
    pub fn on_robot(&self, garment: &Garment, layout: &Layout, robot: Arc<Robot>) -> Result<RobotSurface> {
        let on_robot = RobotSurface::build_with(&self.body, garment, layout, robot, &self.listed);
        on_robot.map_err(|error| self.error(error))
    }

    /// Checks that no two panels lie on each other on a surface of this body. The error names file, line and
    /// the patch of the second.
    pub fn check_overlap(&self, surface: &Surface, layout: &Layout) -> Result<()> {
        let Some((one, other)) = surface.overlap(layout) else { return Ok(()) };
        let index = self.body.patches.iter().position(|patch| patch.panel == other).unwrap_or_default();
        let key = format!("patches[{index}].panel");
        let text = format!("`{key}` {other} lies on the panel {one}");
        Err(self.error(SettingError::Key { key, text }))
    }

    /// Finds how the panels sit, from touches whose place on the robot is known, with its joints at 0.
    /// Errors name the panel, the link or the touch, or file, line and key.
    pub fn fit(&self, garment: &Garment, layout: &Layout, touches: &[KnownTouch]) -> Result<BodyFit> {
        fit(&self.body, garment, layout, &self.listed, touches).map_err(|error| self.error(error))
    }

    /// The text of the file with `offset` of these panels; comments stay.
    pub fn with_offsets(&self, panels: &[PatchFit]) -> Result<String> {
        Ok(written(&self.name, &self.text, panels)?)
    }

    fn error(&self, error: SettingError) -> Error {
        let SettingError::Key { key, text } = error else { return error.into() };
        let what = text.strip_prefix(&format!("`{key}` ")).unwrap_or(&text);
        toml_key::error(&self.name, &self.text, &key, what).into()
    }
}

/// Reads the body of a preset (`reference`), or a body's TOML file and the lists of taxels that it names,
/// which lie beside it.
pub fn read(name_or_path: &str) -> Result<ReadBody> {
    let load = |path: &Path| -> Result<String> {
        input::text(path).with_context(|| format!("cannot read {}", path.display()))
    };
    let (name, path) = (name_or_path.to_string(), Path::new(name_or_path));
    let text = match PRESETS.iter().find(|(preset, _)| *preset == name) {
        Some((_, text)) => (*text).to_string(),
        None if !name.ends_with(".toml") && !path.is_file() => {
            let unknown = words::unknown("body", &name, PRESETS.map(|(preset, _)| preset));
            fail!(UsageError::Unknown, "{unknown}, or give a .toml file");
        }
        None => load(path)?,
    };
    let body: Body =
        toml::from_str(&text).map_err(|error| SettingError::Malformed(words::toml(&error, &text, &name)))?;
    let (mut rows, mut lists) = (Vec::new(), Vec::new());
    for (index, patch) in body.patches.iter().enumerate() {
        let Form::Taxels(file) = &patch.on else { continue };
        let file = path.parent().unwrap_or(Path::new("")).join(file);
        let text_of = load(&file).with_context(|| {
            let key = format!("patches[{index}].on.taxels");
            match toml_key::line_in(&text, &key) {
                Some(line) => format!("{name}, line {line}, `{key}`"),
                None => format!("{name}, `{key}`"),
            }
        });
        rows.push((index, listed(&file.display().to_string(), &text_of?)?));
        lists.push(file);
    }
    Ok(ReadBody { name, text, body, listed: rows, lists })
}
