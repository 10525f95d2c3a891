//! Figure of a robot: a mesh of each link, coarse enough to be drawn while it moves.

use super::link::of_file;
use super::model::Mesh;
use super::solids::mesh_of;
use crate::body::robot::{LinkShape, LinkSolid, solids, text};
use crate::error::{Result, RobotError};
use crate::text::words;
use std::path::PathBuf;

/// Most triangles of a link.
const MOST: usize = 1000;

/// Figure of a robot.
#[derive(Debug, Default, Clone, PartialEq)]
pub struct Figure {
    /// Name and mesh (m, in the link's frame) of each link that has a shape.
    pub links: Vec<(String, Mesh)>,
    /// Reasons why links have none although the URDF gives them one: a sentence each.
    pub lacks: Vec<String>,
}

/// Reads what the robot of a preset or a URDF file looks like: its `<visual>` or, where none can be read, its
/// `<collision>`, with the files that it names (see [`of_link`](super::of_link) for `packages`). Error if it is no URDF.
pub fn figure(urdf: &str, packages: &[(String, PathBuf)]) -> Result<Figure> {
    let text = text(urdf)?;
    let of = |shape| solids(urdf, &text, shape);
    let mut figure = Figure::default();
    for ((name, visual), (_, collision)) in of(LinkShape::Visual)?.into_iter().zip(of(LinkShape::Collision)?)
    {
        let mesh = |solids: Result<Vec<LinkSolid>, RobotError>| joined(urdf, &name, &solids?, packages);
        match mesh(visual) {
            Ok(Some(mesh)) => figure.links.push((name, mesh)),
            visual => match (mesh(collision), visual) {
                (Ok(Some(mesh)), _) => figure.links.push((name, mesh)),
                (_, Err(error)) | (Err(error), _) => figure.lacks.push(words::sentence(&error)),
                (Ok(None), Ok(_)) => {}
            },
        }
    }
    Ok(figure)
}

/// The shapes of a link as one mesh; none without any.
fn joined(
    urdf: &str,
    link: &str,
    solids: &[LinkSolid],
    packages: &[(String, PathBuf)],
) -> Result<Option<Mesh>> {
    let mesh = |solid: &LinkSolid| match solid {
        LinkSolid::Mesh(named) => Ok(of_file(urdf, link, named, packages)?.0),
        solid => Ok(mesh_of(solid).unwrap_or_default()),
    };
    let parts = solids.iter().map(mesh).collect::<Result<Vec<_>>>()?;
    let all = Mesh::joined(&parts).coarse(MOST);
    Ok((!all.triangles().is_empty()).then_some(all))
}
