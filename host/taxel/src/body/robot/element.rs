//! Elements of a URDF, whose errors name file, line, and the link or joint that they belong to.

use crate::body::pose::Pose;
use crate::error::RobotError;
use glam::DVec3;
use roxmltree::Node;
use std::fmt::Display;

/// Link or joint that an element belongs to.
#[derive(Debug, Clone, Copy)]
pub(super) enum Owner<'a> {
    Link(&'a str),
    Joint(&'a str),
}

impl Owner<'_> {
    /// Error about it: `arm.urdf, line 7, joint "elbow": ...`.
    pub fn wrong(self, file: &str, line: usize, what: impl Display) -> RobotError {
        let text = |kind: &str, name: &str| format!("{file}, line {line}, {kind} \"{name}\": {what}");
        match self {
            Owner::Link(link) => RobotError::Link { link: link.into(), text: text("link", link) },
            Owner::Joint(joint) => RobotError::Joint { joint: joint.into(), text: text("joint", joint) },
        }
    }
}

/// An element.
#[derive(Debug, Clone, Copy)]
pub(super) struct Element<'a> {
    pub file: &'a str,
    pub owner: Owner<'a>,
    pub node: Node<'a, 'a>,
}

impl<'a> Element<'a> {
    /// Error about the element, with its line.
    pub fn wrong(&self, what: impl Display) -> RobotError {
        self.owner.wrong(self.file, line(self.node), what)
    }

    fn tag(&self) -> &'a str {
        self.node.tag_name().name()
    }

    /// The element of this name in it, at most one.
    pub fn child(&self, tag: &str) -> Result<Option<Element<'a>>, RobotError> {
        let mut found = self.node.children().filter(|node| node.has_tag_name(tag));
        let Some(node) = found.next() else { return Ok(None) };
        if let Some(node) = found.next() {
            return Err(Element { node, ..*self }.wrong(format!("a second <{tag}>")));
        }
        Ok(Some(Element { node, ..*self }))
    }

    /// The element of this name in it.
    pub fn one(&self, tag: &str) -> Result<Element<'a>, RobotError> {
        self.child(tag)?.ok_or_else(|| self.wrong(format!("lacks <{tag}>")))
    }

    /// An attribute, not empty.
    pub fn text(&self, key: &str) -> Result<&'a str, RobotError> {
        let text = self.node.attribute(key).filter(|text| !text.trim().is_empty());
        text.ok_or_else(|| self.wrong(format!("<{}> lacks `{key}`", self.tag())))
    }

    /// A number; none without the attribute.
    pub fn number(&self, key: &str) -> Result<Option<f64>, RobotError> {
        let Some(text) = self.node.attribute(key) else { return Ok(None) };
        let number = text.trim().parse().ok().filter(|number: &f64| number.is_finite());
        let wrong = || self.wrong(format!("`{key}` of <{}> must be a number, not \"{text}\"", self.tag()));
        number.ok_or_else(wrong).map(Some)
    }

    /// Three numbers; none without the attribute.
    pub fn vector(&self, key: &str) -> Result<Option<DVec3>, RobotError> {
        let Some(text) = self.node.attribute(key) else { return Ok(None) };
        let numbers: Result<Vec<f64>, _> = text.split_whitespace().map(str::parse).collect();
        match numbers.as_deref() {
            Ok([x, y, z]) if [x, y, z].iter().all(|number| number.is_finite()) => {
                Ok(Some(DVec3::new(*x, *y, *z)))
            }
            _ => {
                Err(self.wrong(format!("`{key}` of <{}> must be three numbers, not \"{text}\"", self.tag())))
            }
        }
    }

    /// The pose of its `origin`, if it has one.
    pub fn origin(&self) -> Result<Pose, RobotError> {
        let Some(origin) = self.child("origin")? else { return Ok(Pose::IDENTITY) };
        origin.only(&["xyz", "rpy"])?;
        let [xyz, rpy] = [origin.vector("xyz")?, origin.vector("rpy")?].map(Option::unwrap_or_default);
        Ok(Pose::from_xyz_rpy(xyz, rpy))
    }

    /// Refuses attributes other than these: each changes what the element means.
    pub fn only(&self, known: &[&str]) -> Result<(), RobotError> {
        match self.node.attributes().find(|attribute| !known.contains(&attribute.name())) {
            Some(other) => {
                let (tag, known) = (self.tag(), known.join(" and "));
                Err(self.wrong(format!("`{}` of <{tag}> is not read, only {known}", other.name())))
            }
            None => Ok(()),
        }
    }
}

/// Line of an element. It is counted from the beginning of the file: for errors alone.
pub(super) fn line(node: Node<'_, '_>) -> usize {
    node.document().text_pos_at(node.range().start).row as usize
}
