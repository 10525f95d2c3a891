//! The mesh of a robot's link: the files that its URDF names, found, scaled and placed.

use super::file::read;
use super::model::Mesh;
use crate::body::robot::{LinkMesh, LinkShape, meshes, text};
use crate::error::{Context, Result, RobotError};
use std::path::{Path, PathBuf};

/// Prefix of the name of a file in a package of ROS.
const PACKAGE: &str = "package://";
/// Prefix of the name of a file by its whole path.
const FILE: &str = "file://";

/// The mesh of a link.
#[derive(Debug, Clone, PartialEq)]
pub struct OfLink {
    /// All its parts as one, m, in the link's frame.
    pub mesh: Mesh,
    /// The files that were read.
    pub files: Vec<PathBuf>,
}

/// Reads the mesh of a link of a URDF file. Paths are relative to the URDF; `package://NAME/PATH` is looked
/// for in the folder that `packages` has of this name, else in each folder above the URDF that is called NAME
/// or holds one that is. Errors name file, line and link.
pub fn of_link(urdf: &str, link: &str, shape: LinkShape, packages: &[(String, PathBuf)]) -> Result<OfLink> {
    let named = meshes(urdf, &text(urdf)?, link, shape)?;
    let (mut parts, mut files) = (Vec::new(), Vec::new());
    for named in named {
        let (part, file) = of_file(urdf, link, &named, packages)?;
        parts.push(part);
        files.push(file);
    }
    Ok(OfLink { mesh: Mesh::joined(&parts), files })
}

/// Reads a mesh that a link names, m, in the link's frame. Returns it and its file.
pub(super) fn of_file(
    urdf: &str,
    link: &str,
    LinkMesh { file, scale, origin, line }: &LinkMesh,
    packages: &[(String, PathBuf)],
) -> Result<(Mesh, PathBuf)> {
    let place = || format!("{urdf}, line {line}, link \"{link}\"");
    let wrong = |what: String| RobotError::Link { link: link.into(), text: format!("{}: {what}", place()) };
    let path = found(Path::new(urdf), file, packages).map_err(wrong)?;
    Ok((read(&path).with_context(place)?.placed(*scale, origin), path))
}

/// Path of a file that a URDF names. Error if no folder has its package.
fn found(urdf: &Path, file: &str, packages: &[(String, PathBuf)]) -> Result<PathBuf, String> {
    let folder = urdf.parent().unwrap_or(Path::new(""));
    let Some(rest) = file.strip_prefix(PACKAGE) else {
        return Ok(folder.join(file.strip_prefix(FILE).unwrap_or(file)));
    };
    let Some((name, rest)) = rest.split_once('/') else {
        return Err(format!("mesh {file}: must be {PACKAGE}NAME/PATH"));
    };
    if let Some((_, folder)) = packages.iter().find(|(package, _)| package == name) {
        return Ok(folder.join(rest));
    }
    let whole = std::path::absolute(folder).unwrap_or_else(|_| folder.into());
    let folders = whole.ancestors().flat_map(|above| {
        let own = above.file_name().is_some_and(|own| own == name).then(|| above.to_path_buf());
        own.into_iter().chain([above.join(name)])
    });
    let mut files = folders.map(|folder| folder.join(rest));
    files.find(|path| path.is_file()).ok_or_else(|| {
        format!(
            "mesh {file}: no folder above the file has a package \"{name}\" with it; say where the package is"
        )
    })
}
