//! Files of meshes.

use super::model::Mesh;
use super::obj::obj;
use super::stl::stl;
use crate::error::{Context, Result, RobotError};
use crate::files::input;
use std::path::Path;

/// Reads a mesh from the bytes of an STL (binary or text) or an OBJ file, as the end of its name says. Its unit is
/// that of the file; a URDF says by what to scale it. Errors name the file, and the line or the triangle.
pub fn parse(file: &str, bytes: &[u8]) -> Result<Mesh, RobotError> {
    let ends = |end: &str| Path::new(file).extension().is_some_and(|has| has.eq_ignore_ascii_case(end));
    let mesh = match (ends("stl"), ends("obj")) {
        (true, _) => stl(file, bytes)?,
        (_, true) => obj(file, &String::from_utf8_lossy(bytes))?,
        _ => return Err(RobotError::Mesh(format!("{file}: meshes are read from .stl and .obj files"))),
    };
    match mesh.triangles().is_empty() {
        true => Err(RobotError::Mesh(format!("{file}: it has no triangles"))),
        false => Ok(mesh),
    }
}

/// Reads the mesh of a file, see [`parse`].
pub fn read(path: &Path) -> Result<Mesh> {
    let bytes = input::bytes(path).with_context(|| format!("cannot read {}", path.display()))?;
    Ok(parse(&path.display().to_string(), &bytes)?)
}
