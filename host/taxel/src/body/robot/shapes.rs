//! The meshes of a link, as the file names them.

use super::element::{Element, Owner, line};
use super::urdf::document;
use crate::body::pose::Pose;
use crate::error::RobotError;
use crate::tell::words;
use glam::DVec3;
use roxmltree::Node;

/// A mesh that a link names.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkMesh {
    /// Its file: `package://NAME/PATH`, `file://PATH` or a path, not looked for.
    pub file: String,
    /// Factors for its axes: metres of one unit.
    pub scale: DVec3,
    /// Pose of its frame in the link's.
    pub origin: Pose,
    /// Line of the URDF.
    pub line: usize,
}

/// What of a link has meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinkShape {
    /// As it looks.
    Visual,
    /// As it collides with others, often simpler.
    Collision,
}

impl LinkShape {
    /// Its element.
    fn tag(self) -> &'static str {
        match self {
            LinkShape::Visual => "visual",
            LinkShape::Collision => "collision",
        }
    }

    fn other(self) -> LinkShape {
        match self {
            LinkShape::Visual => LinkShape::Collision,
            LinkShape::Collision => LinkShape::Visual,
        }
    }
}

/// The meshes of a link in the text of a URDF. Errors name file, line and link: a link that the file lacks,
/// or one without a mesh.
pub fn meshes(file: &str, text: &str, link: &str, shape: LinkShape) -> Result<Vec<LinkMesh>, RobotError> {
    let document = document(file, text)?;
    let links = || document.root_element().children().filter(|node| node.has_tag_name("link"));
    let name = |node: &Node<'_, '_>| node.attribute("name").unwrap_or_default().to_string();
    let node = links().find(|node| name(node) == link).ok_or_else(|| {
        let known: Vec<String> = links().map(|node| name(&node)).collect();
        let text = format!("{file}: {}", words::unknown("link", link, known.iter().map(String::as_str)));
        RobotError::NoLink { link: link.into(), text }
    })?;
    let element = Element { file, owner: Owner::Link(link), node };
    let found = of_shape(&element, shape)?;
    if !found.is_empty() {
        return Ok(found);
    }
    let (tag, other) = (shape.tag(), shape.other());
    let hint = match of_shape(&element, other) {
        Ok(found) if !found.is_empty() => format!("its <{}> has one", other.tag()),
        _ => "on boxes, cylinders and spheres, panels lie by `on.plane` and `on.cylinder`".into(),
    };
    Err(element.wrong(format!("has no mesh in a <{tag}>; {hint}")))
}

fn of_shape(link: &Element<'_>, shape: LinkShape) -> Result<Vec<LinkMesh>, RobotError> {
    let mut found = Vec::new();
    for node in link.node.children().filter(|node| node.has_tag_name(shape.tag())) {
        let part = Element { node, ..*link };
        let Some(mesh) = part.one("geometry")?.child("mesh")? else { continue };
        let scale = mesh.vector("scale")?.unwrap_or(DVec3::ONE);
        if scale.to_array().contains(&0.0) {
            return Err(mesh.wrong("`scale` of <mesh> must not have a 0"));
        }
        let file = mesh.text("filename")?.trim().to_string();
        found.push(LinkMesh { file, scale, origin: part.origin()?, line: line(mesh.node) });
    }
    Ok(found)
}
