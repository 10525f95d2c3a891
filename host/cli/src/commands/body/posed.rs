//! The robot that carries the garment, and its posture.

use crate::fault::Blame;
use anyhow::Result;
use clap::Args;
use std::sync::Arc;
use taxel::body::{ReadBody, Surface, robot};
use taxel_core::garment::{Garment, Layout};

/// Name of the root's frame, if no link has it.
const BASE: &str = "base";

/// A robot, a posture and a frame.
#[derive(Debug, Clone, Args)]
pub struct PosedArgs {
    /// The robot that carries it: a URDF file or `reference`
    #[arg(long, value_name = "URDF")]
    pub robot: Option<String>,
    /// Positions of joints, deg, rad or m: elbow=30deg,wrist=-0.5rad. The others rest
    #[arg(long, value_name = "JOINTS", requires = "robot")]
    joints: Option<String>,
    /// The link in whose frame the places are; `base`, the robot's root, if left out
    #[arg(long, value_name = "LINK", requires = "robot")]
    frame: Option<String>,
}

impl PosedArgs {
    /// Places the taxels: with a robot in one frame, whose link is returned, else each in that of its own link.
    pub fn surface(
        &self,
        body: &ReadBody,
        garment: &Garment,
        layout: &Layout,
    ) -> Result<(Surface, Option<String>)> {
        let Some(file) = &self.robot else { return Ok((body.surface(garment, layout)?, None)) };
        let robot = Arc::new(robot::read(file)?);
        let on_robot = body.on_robot(garment, layout, robot.clone())?;
        let frame = self.frame.as_deref().unwrap_or(BASE);
        let frame = match robot.link(frame) {
            Err(_) if frame == BASE => 0,
            found => found.usage()?,
        };
        let posture = robot.posture_of(self.joints.as_deref().unwrap_or_default()).usage()?;
        let name = robot.links().get(frame).map(|link| link.name.clone());
        Ok((on_robot.seen_from(&posture, frame)?, name))
    }
}
