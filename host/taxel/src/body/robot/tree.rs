//! Links and joints of a URDF as one tree.

use super::element::Owner;
use super::model::{Drive, JointKind, Robot, RobotJoint, RobotLink};
use super::urdf::{UrdfJoint, UrdfLink};
use crate::error::RobotError;
use crate::text::words;
use std::collections::HashMap;

/// Numbers of links and joints by their names.
type Numbers<'a> = HashMap<&'a str, usize>;

/// Joins links and joints. Errors name file, line, and the link or joint that does not fit.
pub(super) fn tree(
    file: &str,
    links: &[UrdfLink<'_>],
    joints: &[UrdfJoint<'_>],
) -> Result<Robot, RobotError> {
    let named = numbers(links.iter().map(|link| (link.name, link.line)), |name, line, first| {
        Owner::Link(name).wrong(file, line, format!("line {first} has a link of this name, too"))
    })?;
    let joint_named = numbers(joints.iter().map(|joint| (joint.name, joint.line)), |name, line, first| {
        Owner::Joint(name).wrong(file, line, format!("line {first} has a joint of this name, too"))
    })?;
    let hangs = hangs(file, &named, joints)?;
    let order = order(file, links, joints, &hangs)?;
    // New numbers: links by their place in the tree, joints by that of their child.
    let mut place = vec![0; links.len()];
    for (new, (link, _)) in order.iter().enumerate() {
        place[*link] = new;
    }
    let in_order: Vec<usize> = order.iter().filter_map(|(_, joint)| *joint).collect();
    let free: Vec<usize> = (0..in_order.len())
        .filter(|new| {
            let joint = &joints[in_order[*new]];
            joint.kind != JointKind::Fixed && joint.mimic.is_none()
        })
        .collect();
    // Number among the free ones, by the file's number of the joint.
    let own = free.iter().enumerate().map(|(number, new)| (in_order[*new], number)).collect();
    let made = |old: &usize| {
        let joint = &joints[*old];
        Ok(RobotJoint {
            name: joint.name.into(),
            line: joint.line,
            kind: joint.kind,
            parent: named.get(joint.parent).map_or(0, |parent| place[*parent]),
            origin: joint.origin,
            axis: joint.axis,
            limits: joint.limits.clone(),
            velocity: joint.velocity,
            drive: drive(file, joints, &joint_named, &own, *old)?,
        })
    };
    Ok(Robot {
        file: file.into(),
        links: order.iter().map(|(link, _)| &links[*link]).map(kept).collect(),
        joints: in_order.iter().map(made).collect::<Result<_, RobotError>>()?,
        free,
    })
}

fn kept(link: &UrdfLink<'_>) -> RobotLink {
    RobotLink { name: link.name.into(), line: link.line }
}

/// Numbers by names, which are unique.
fn numbers<'a>(
    named: impl Iterator<Item = (&'a str, usize)>,
    twice: impl Fn(&'a str, usize, usize) -> RobotError,
) -> Result<Numbers<'a>, RobotError> {
    let mut seen: HashMap<&str, (usize, usize)> = HashMap::new();
    for (number, (name, line)) in named.enumerate() {
        if let Some((_, first)) = seen.insert(name, (number, line)) {
            return Err(twice(name, line, first));
        }
    }
    Ok(seen.into_iter().map(|(name, (number, _))| (name, number)).collect())
}

/// The joint that each link hangs on.
fn hangs(
    file: &str,
    named: &Numbers<'_>,
    joints: &[UrdfJoint<'_>],
) -> Result<Vec<Option<usize>>, RobotError> {
    let mut hangs: Vec<Option<usize>> = vec![None; named.len()];
    for (number, joint) in joints.iter().enumerate() {
        let wrong = |what: String| Owner::Joint(joint.name).wrong(file, joint.line, what);
        let find = |role: &str, name: &str| {
            named.get(name).copied().ok_or_else(|| {
                let meant = words::meant(name, named.keys().copied());
                let meant = meant.map_or(String::new(), |near| format!(": did you mean \"{near}\"?"));
                wrong(format!("its {role} \"{name}\" is not a link of the file{meant}"))
            })
        };
        find("parent", joint.parent)?;
        let held = &mut hangs[find("child", joint.child)?];
        if let Some(other) = held {
            let other: &UrdfJoint<'_> = &joints[*other];
            return Err(wrong(format!(
                "its child \"{}\" hangs on the joint \"{}\" already (line {})",
                joint.child, other.name, other.line
            )));
        }
        *held = Some(number);
    }
    Ok(hangs)
}

/// Links with the joints that they hang on: the root first, each after its parent, siblings as in the file.
fn order(
    file: &str,
    links: &[UrdfLink<'_>],
    joints: &[UrdfJoint<'_>],
    hangs: &[Option<usize>],
) -> Result<Vec<(usize, Option<usize>)>, RobotError> {
    let Some(first) = links.first() else {
        return Err(RobotError::NotUrdf(format!("{file}: has no links")));
    };
    let wrong = |link: &UrdfLink<'_>, what: String| Owner::Link(link.name).wrong(file, link.line, what);
    let mut roots = (0..links.len()).filter(|link| hangs[*link].is_none());
    let Some(root) = roots.next() else {
        return Err(wrong(
            first,
            "joints lead from each link to another, in a circle: none is the root".into(),
        ));
    };
    if let Some(other) = roots.next() {
        let root = &links[root];
        let what = format!("hangs on no joint, and neither does \"{}\" (line {})", root.name, root.line);
        return Err(wrong(&links[other], what));
    }
    let mut children: HashMap<&str, Vec<usize>> = HashMap::new();
    for (link, joint) in hangs.iter().enumerate() {
        if let Some(joint) = joint {
            children.entry(joints[*joint].parent).or_default().push(link);
        }
    }
    let (mut order, mut open) = (Vec::new(), vec![root]);
    // A stack of its own: a chain may be longer than the program's.
    while let Some(link) = open.pop() {
        order.push((link, hangs[link]));
        open.extend(children.get(links[link].name).into_iter().flatten().rev());
    }
    if order.len() < links.len() {
        let mut is_reached = vec![false; links.len()];
        order.iter().for_each(|(link, _)| is_reached[*link] = true);
        let lost = (0..links.len()).find(|link| !is_reached[*link]).map_or(first, |link| &links[link]);
        let root = links[root].name;
        return Err(wrong(lost, format!("hangs on a circle of joints, and not on the root \"{root}\"")));
    }
    Ok(order)
}

/// Finds where the position of a joint comes from, through any number of joints that mimic each other.
fn drive(
    file: &str,
    joints: &[UrdfJoint<'_>],
    named: &Numbers<'_>,
    own: &HashMap<usize, usize>,
    joint: usize,
) -> Result<Option<Drive>, RobotError> {
    let first = &joints[joint];
    let wrong = |what: String| Owner::Joint(first.name).wrong(file, first.line, what);
    let (mut at, mut multiplier, mut offset) = (joint, 1.0, 0.0);
    for _ in 0..joints.len() {
        let UrdfJoint { name, kind, mimic, .. } = &joints[at];
        if *kind == JointKind::Fixed && at == joint {
            return Ok(None);
        }
        if *kind == JointKind::Fixed {
            return Err(wrong(format!("mimics the joint \"{name}\", which is fixed")));
        }
        if let Some(free) = own.get(&at) {
            return Ok(Some(Drive { free: *free, multiplier, offset }));
        }
        let Some(mimic) = mimic else { break };
        let Some(next) = named.get(mimic.joint) else {
            let unknown = words::unknown("joint", mimic.joint, joints.iter().map(|joint| joint.name));
            return Err(wrong(format!("mimics a joint that the file lacks: {unknown}")));
        };
        offset += multiplier * mimic.offset;
        multiplier *= mimic.multiplier;
        if !(f64::is_finite(multiplier) && f64::is_finite(offset)) {
            return Err(wrong("mimics by numbers that are too large".into()));
        }
        at = *next;
    }
    Err(wrong("mimics itself, by way of others or at once".into()))
}
