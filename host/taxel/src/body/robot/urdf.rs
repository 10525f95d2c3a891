//! A URDF's links and joints as its author writes them.

use super::element::{Element, Owner, line};
use super::model::JointKind;
use crate::body::pose::Pose;
use crate::error::RobotError;
use crate::text::words;
use glam::DVec3;
use roxmltree::{Document, Node};
use std::ops::RangeInclusive;

/// A link.
#[derive(Debug, Clone, Copy)]
pub(super) struct UrdfLink<'a> {
    pub name: &'a str,
    pub line: usize,
}

/// A joint; links and joints that it names may not exist.
#[derive(Debug)]
pub(super) struct UrdfJoint<'a> {
    pub name: &'a str,
    pub line: usize,
    pub kind: JointKind,
    pub parent: &'a str,
    pub child: &'a str,
    pub origin: Pose,
    pub axis: DVec3,
    pub limits: Option<RangeInclusive<f64>>,
    pub velocity: Option<f64>,
    pub mimic: Option<UrdfMimic<'a>>,
}

/// A joint's position by that of another.
#[derive(Debug, Clone, Copy)]
pub(super) struct UrdfMimic<'a> {
    pub joint: &'a str,
    pub multiplier: f64,
    pub offset: f64,
}

/// Reads an XML document.
pub(super) fn document<'a>(file: &str, text: &'a str) -> Result<Document<'a>, RobotError> {
    Document::parse(text).map_err(|error| {
        let pos = error.pos();
        let what = error.to_string();
        // Errors at the end of the file have no place of their own.
        let at = format!(" at {pos}");
        let (line, what) = match what.contains(&at) {
            true => (pos.row as usize, what.replace(&at, "")),
            false => (text.lines().count().max(1), what),
        };
        RobotError::NotUrdf(format!("{file}, line {line}: not XML: {what}"))
    })
}

/// Links and joints of a document, in the order of the file.
pub(super) fn parts<'a>(
    file: &'a str,
    document: &'a Document<'a>,
) -> Result<(Vec<UrdfLink<'a>>, Vec<UrdfJoint<'a>>), RobotError> {
    let root = document.root_element();
    let tag = root.tag_name().name();
    if tag != "robot" {
        let line = line(root);
        let what = format!("{file}, line {line}: not a URDF: its root is <{tag}>, not <robot>");
        return Err(RobotError::NotUrdf(what));
    }
    let (mut links, mut joints) = (Vec::new(), Vec::new());
    let mut lines = LineCount { text: document.input_text(), line: 1, at: 0 };
    for node in root.children().filter(Node::is_element) {
        let line = lines.at(node.range().start);
        if node.tag_name().namespace().is_some_and(|space| space.contains("xacro")) {
            let what = format!("{file}, line {line}: this is xacro: expand it to a URDF first");
            return Err(RobotError::NotUrdf(what));
        }
        let name = node.attribute("name").unwrap_or_default();
        let (is_link, is_joint) = (node.has_tag_name("link"), node.has_tag_name("joint"));
        if !is_link && !is_joint {
            continue;
        }
        if name.trim().is_empty() {
            let tag = node.tag_name().name();
            return Err(RobotError::NotUrdf(format!("{file}, line {line}: a <{tag}> without a name")));
        }
        match is_link {
            true => links.push(UrdfLink { name, line }),
            false => joints.push(joint(&Element { file, owner: Owner::Joint(name), node }, name, line)?),
        }
    }
    Ok((links, joints))
}

fn joint<'a>(element: &Element<'a>, name: &'a str, line: usize) -> Result<UrdfJoint<'a>, RobotError> {
    let kind = kind(element)?;
    let limit = element.child("limit")?;
    let velocity = limit.map(|limit| limit.number("velocity")).transpose()?.flatten();
    let mimic = element.child("mimic")?.map(mimic).transpose()?;
    Ok(UrdfJoint {
        name,
        line,
        kind,
        parent: element.one("parent")?.text("link")?,
        child: element.one("child")?.text("link")?,
        origin: element.origin()?,
        axis: if kind == JointKind::Fixed { DVec3::X } else { axis(element)? },
        limits: limits(element, kind, limit)?,
        // 0 is what exporters write that do not know it.
        velocity: velocity.filter(|velocity| *velocity > 0.0),
        mimic: mimic.filter(|_| kind != JointKind::Fixed),
    })
}

fn kind(element: &Element<'_>) -> Result<JointKind, RobotError> {
    const KINDS: [(&str, JointKind); 4] = [
        ("revolute", JointKind::Revolute),
        ("continuous", JointKind::Continuous),
        ("prismatic", JointKind::Prismatic),
        ("fixed", JointKind::Fixed),
    ];
    let said = element.text("type")?;
    match KINDS.iter().find(|(name, _)| *name == said) {
        Some((_, kind)) => Ok(*kind),
        None if ["floating", "planar"].contains(&said) => {
            let known = KINDS.map(|(name, _)| name).join(", ");
            Err(element.wrong(format!("joints that are {said} are not supported, only {known}")))
        }
        None => Err(element.wrong(words::unknown("type of joint", said, KINDS.map(|(name, _)| name)))),
    }
}

/// Reads its axis, (1, 0, 0) unless the file says otherwise.
fn axis(element: &Element<'_>) -> Result<DVec3, RobotError> {
    let Some(axis) = element.child("axis")? else { return Ok(DVec3::X) };
    let direction = axis.vector("xyz")?.unwrap_or(DVec3::X);
    direction.try_normalize().ok_or_else(|| axis.wrong("`xyz` of <axis> must be a direction"))
}

fn limits(
    element: &Element<'_>,
    kind: JointKind,
    limit: Option<Element<'_>>,
) -> Result<Option<RangeInclusive<f64>>, RobotError> {
    if matches!(kind, JointKind::Fixed | JointKind::Continuous) {
        return Ok(None);
    }
    let Some(limit) = limit else { return Err(element.wrong("lacks <limit>")) };
    let [lower, upper] = [limit.number("lower")?, limit.number("upper")?].map(Option::unwrap_or_default);
    match lower <= upper {
        true => Ok(Some(lower..=upper)),
        false => Err(limit.wrong(format!("`lower` of <limit> is above `upper`: {lower} and {upper}"))),
    }
}

fn mimic(element: Element<'_>) -> Result<UrdfMimic<'_>, RobotError> {
    Ok(UrdfMimic {
        joint: element.text("joint")?,
        multiplier: element.number("multiplier")?.unwrap_or(1.0),
        offset: element.number("offset")?.unwrap_or(0.0),
    })
}

/// Counts lines from place to place, so that a file is counted once and not for each of its elements.
struct LineCount<'a> {
    text: &'a str,
    line: usize,
    at: usize,
}

impl LineCount<'_> {
    /// Line of a place that is not before the last one.
    fn at(&mut self, at: usize) -> usize {
        let passed = self.text.as_bytes().get(self.at..at).unwrap_or_default();
        self.line += passed.iter().filter(|byte| **byte == b'\n').count();
        self.at = at;
        self.line
    }
}
