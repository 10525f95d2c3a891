//! The shapes of links, as the file has them.

use super::element::{Element, Owner, line};
use super::urdf::document;
use crate::body::pose::Pose;
use crate::error::RobotError;
use crate::text::words;
use glam::DVec3;
use roxmltree::Node;

/// A mesh that a link names.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkMesh {
    /// File of the mesh: `package://NAME/PATH`, `file://PATH` or a path, not looked for.
    pub file: String,
    /// Factors for its axes: metres of one unit.
    pub scale: DVec3,
    /// Pose of its frame in the link's.
    pub origin: Pose,
    /// Line of the URDF.
    pub line: usize,
}

/// A shape of a link, with its pose in the link's frame; sizes in m, more than 0.
#[derive(Debug, Clone, PartialEq)]
pub enum LinkSolid {
    /// A file.
    Mesh(LinkMesh),
    /// A box of this size around the origin.
    Box(DVec3, Pose),
    /// A cylinder of this radius and length around the z axis, half of it below the origin.
    Cylinder([f64; 2], Pose),
    /// A sphere of this radius around the origin.
    Sphere(f64, Pose),
}

/// Name of a link, and its shapes; an error names file, line and link.
pub type SolidsOf = (String, Result<Vec<LinkSolid>, RobotError>);

/// Kind of a link's shapes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinkShape {
    /// Shapes as the link looks.
    Visual,
    /// Shapes as it collides with others, often simpler.
    Collision,
}

impl LinkShape {
    /// Returns its element.
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

/// The shapes of each link in the text of a URDF, of those that are known. Error if it is no URDF.
pub fn solids(file: &str, text: &str, shape: LinkShape) -> Result<Vec<SolidsOf>, RobotError> {
    let document = document(file, text)?;
    let links = document.root_element().children().filter(|node| node.has_tag_name("link"));
    let of = |node: Node<'_, '_>| {
        let name = node.attribute("name").unwrap_or_default();
        let link = Element { file, owner: Owner::Link(name), node };
        (
            name.to_string(),
            parts(&link, shape).map(|part| solid(&part)).filter_map(Result::transpose).collect(),
        )
    };
    Ok(links.map(of).collect())
}

fn of_shape(link: &Element<'_>, shape: LinkShape) -> Result<Vec<LinkMesh>, RobotError> {
    parts(link, shape).map(|part| mesh(&part)).filter_map(Result::transpose).collect()
}

/// The elements of a kind in a link.
fn parts<'a>(link: &Element<'a>, shape: LinkShape) -> impl Iterator<Item = Element<'a>> {
    let link = *link;
    let nodes = link.node.children().filter(move |node| node.has_tag_name(shape.tag()));
    nodes.map(move |node| Element { node, ..link })
}

/// The mesh of a part; none if it is another shape.
fn mesh(part: &Element<'_>) -> Result<Option<LinkMesh>, RobotError> {
    let Some(mesh) = part.one("geometry")?.child("mesh")? else { return Ok(None) };
    let scale = mesh.vector("scale")?.unwrap_or(DVec3::ONE);
    if scale.to_array().contains(&0.0) {
        return Err(mesh.wrong("`scale` of <mesh> must not have a 0"));
    }
    let file = mesh.text("filename")?.trim().to_string();
    Ok(Some(LinkMesh { file, scale, origin: part.origin()?, line: line(mesh.node) }))
}

/// The shape of a part; none if it is not known.
fn solid(part: &Element<'_>) -> Result<Option<LinkSolid>, RobotError> {
    if let Some(mesh) = mesh(part)? {
        return Ok(Some(LinkSolid::Mesh(mesh)));
    }
    let (geometry, origin) = (part.one("geometry")?, part.origin()?);
    let positive = |of: &Element<'_>, key: &str| {
        let found = of.number(key)?.filter(|number| *number > 0.0);
        found.ok_or_else(|| of.wrong(format!("`{key}` must be more than 0")))
    };
    if let Some(of) = geometry.child("box")? {
        let size = of.vector("size")?.filter(|size| size.min_element() > 0.0);
        let size = size.ok_or_else(|| of.wrong("`size` of <box> must be three numbers of more than 0"))?;
        return Ok(Some(LinkSolid::Box(size, origin)));
    }
    if let Some(of) = geometry.child("cylinder")? {
        return Ok(Some(LinkSolid::Cylinder([positive(&of, "radius")?, positive(&of, "length")?], origin)));
    }
    let sphere = geometry.child("sphere")?;
    sphere.map(|of| Ok(LinkSolid::Sphere(positive(&of, "radius")?, origin))).transpose()
}
