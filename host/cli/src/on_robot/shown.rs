//! A robot, its posture, and the garment on it.

use super::lines::{BodyLine, BodyLink, FigureLine, FigureLink, PoseOfLink, PosesLine};
use crate::fault::Blame;
use anyhow::Result;
use std::path::Path;
use std::sync::Arc;
use taxel::body::mesh::{self, Figure};
use taxel::body::robot::{self, Robot, RobotLink};
use taxel::body::{self, Pose, ReadBody, RobotSurface, Surface, TaxelPlace};
use taxel::client::{BoardDescription, Client};
use taxel::json::{computed_pressing, lines::PressingLine, pressing};
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Layout};
use taxel_core::wire::PressingReport;

/// Age up to which a report of the board belongs to a frame, us; a board may report ten times a second.
const FRESH: u64 = 150_000;

/// The robot, and its garment once that is known.
#[derive(Debug)]
pub struct ShownRobot {
    body: ReadBody,
    robot: Option<Arc<Robot>>,
    /// Figure of the robot.
    figure: Figure,
    /// Positions of the robot's joints, rad or m; empty without a robot.
    posture: Vec<f64>,
    garment: Option<GarmentOn>,
    /// Last report of the board.
    reported: Option<Box<PressingReport>>,
}

/// A garment on the body.
#[derive(Debug)]
struct GarmentOn {
    garment: Garment,
    layout: Layout,
    /// Surface in the frames of the links, where the posture has slid the cloth to.
    surface: Surface,
    /// With a robot: what follows from its posture.
    on_robot: Option<RobotSurface>,
    /// Number of each of the surface's links among those of [`BodyLine`].
    links: Vec<usize>,
}

impl ShownRobot {
    /// Reads a body, and a robot and the positions of its joints (`elbow=30deg`); the others rest.
    pub fn read(body: &str, robot: Option<&str>, joints: &str) -> Result<ShownRobot> {
        let body = body::read(body)?;
        let figure = robot.map(|robot| mesh::figure(robot, &[])).transpose()?.unwrap_or_default();
        let robot = robot.map(robot::read).transpose()?.map(Arc::new);
        let posture = robot.as_ref().map(|robot| robot.posture_of(joints)).transpose().usage()?;
        Ok(ShownRobot {
            body,
            robot,
            figure,
            posture: posture.unwrap_or_default(),
            garment: None,
            reported: None,
        })
    }

    /// The posture in which these joints have moved, rad or m, and the others not; none without a robot. Joints
    /// that have no position of their own do not count.
    pub fn moved(&self, positions: &[(String, f64)]) -> Option<Vec<f64>> {
        let robot = self.robot.as_ref()?;
        let mut posture = self.posture.clone();
        for (name, position) in positions {
            let free = robot.free().iter().position(|joint| robot.joints()[*joint].name == *name);
            if let Some(to) = free.and_then(|free| posture.get_mut(free)) {
                *to = *position;
            }
        }
        Some(posture)
    }

    /// The lists of taxels that were read with the body.
    pub fn lists(&self) -> impl Iterator<Item = &Path> {
        self.body.lists()
    }

    /// True if it has this garment already.
    pub fn has(&self, description: &BoardDescription) -> bool {
        self.garment.as_ref().is_some_and(|on| on.garment == description.garment)
    }

    /// Puts a garment on. Errors name the body's file, line and key; then no garment is on.
    pub fn put_on(&mut self, description: &BoardDescription) -> Result<()> {
        self.garment = None;
        self.reported = None;
        let (garment, layout) = (description.garment.clone(), description.layout.clone());
        self.garment = Some(match &self.robot {
            Some(robot) => {
                let on_robot = self.body.on_robot(&garment, &layout, robot.clone())?;
                let surface = on_robot.slid(&self.posture)?.into_owned();
                // Each was found when the surface was made.
                let links = surface.links().iter().filter_map(|name| robot.link(name).ok()).collect();
                GarmentOn { garment, layout, surface, on_robot: Some(on_robot), links }
            }
            None => {
                let surface = self.body.surface(&garment, &layout)?;
                let links = (0..surface.links().len()).collect();
                GarmentOn { garment, layout, surface, on_robot: None, links }
            }
        });
        Ok(())
    }

    /// Takes another posture: the positions of [`Robot::free`], rad or m, within their limits. Returns whether
    /// cloth has slid over the skin, so that the places are others. The error names a panel that has slid off.
    pub fn pose(&mut self, posture: Vec<f64>) -> Result<bool> {
        let mut has_slid = false;
        if let Some(on) = &mut self.garment
            && let Some(on_robot) = &on.on_robot
        {
            let slid = on_robot.slid(&posture)?;
            has_slid = *slid != on.surface;
            if has_slid {
                on.surface = slid.into_owned();
            }
        }
        self.posture = posture;
        Ok(has_slid)
    }

    /// Returns where the taxels lie; none before a garment is on.
    pub fn body(&self) -> Option<BodyLine<'_>> {
        let on = self.garment.as_ref()?;
        let links = match &self.robot {
            Some(robot) => {
                let parent = |link: usize| Some(robot.joints().get(link.checked_sub(1)?)?.parent);
                let links = robot.links().iter().enumerate();
                links.map(|(at, link)| BodyLink { name: &link.name, parent: parent(at) }).collect()
            }
            None => {
                let names = on.surface.links().iter();
                names.map(|name| BodyLink { name, parent: None }).collect()
            }
        };
        let taxel = |place: &Option<TaxelPlace>| {
            let place = place.as_ref()?;
            Some((*on.links.get(place.link)?, rounded(place.at), rounded(place.normal)))
        };
        let taxels = on.surface.places().iter().map(taxel).collect();
        Some(BodyLine { name: &self.body.name, links, taxels })
    }

    /// Returns where the links are; none without a robot.
    pub fn poses<'a>(&'a self) -> Option<PosesLine<'a>> {
        let robot = self.robot.as_ref()?;
        let poses = robot.poses(&self.posture);
        let pose = |(at, link): (usize, &'a RobotLink)| {
            let Pose { at, turn } = poses.of(at, 0)?;
            Some((link.name.as_str(), PoseOfLink { at_m: rounded(at), turn: turn.to_array() }))
        };
        Some(PosesLine { links: robot.links().iter().enumerate().filter_map(pose).collect() })
    }

    /// Returns what the robot looks like; none if that is not known.
    pub fn figure(&self) -> Option<FigureLine<'_>> {
        fn link((name, mesh): &(String, mesh::Mesh)) -> FigureLink<'_> {
            let points = mesh.points().iter().map(|point| rounded(*point)).collect();
            FigureLink { name, points, triangles: mesh.triangles() }
        }
        let links = &self.figure.links;
        (!links.is_empty()).then(|| FigureLine { links: links.iter().map(link).collect() })
    }

    /// Returns why a link has no shape although the robot's file gives it one, and how many others have none; none if
    /// all are there.
    pub fn lacks(&self) -> Option<String> {
        let [first, others @ ..] = self.figure.lacks.as_slice() else { return None };
        let more =
            if others.is_empty() { String::new() } else { format!("; and {} more links", others.len()) };
        Some(format!("not all of the robot is drawn: {first}{more}"))
    }

    /// Takes a report of the board.
    pub fn take(&mut self, report: &PressingReport) {
        self.reported = Some(Box::new(report.clone()));
    }

    /// Returns the contacts and forces on the robot in the client's newest frame, of this time: by the board's
    /// report, if there is one of that time, else computed. None before a garment is on.
    pub fn pressing<'a>(&'a self, client: &Client, time: Micros) -> Option<PressingLine<'a>> {
        let on = self.garment.as_ref()?;
        match &self.reported {
            Some(report) if report.time.0.abs_diff(time.0) <= FRESH => {
                Some(pressing(report, client.newtons()))
            }
            _ => computed_pressing(client, time, &on.layout, &on.surface),
        }
    }
}

/// To a micrometre, and 0 without a sign.
fn rounded(vector: body::DVec3) -> [f64; 3] {
    vector.to_array().map(|part| (part * 1e6).round() / 1e6 + 0.0)
}
