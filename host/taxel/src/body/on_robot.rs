//! A garment's surface on a robot: places, forces and moments in the frame of any link.

use super::config::Body;
use super::listed::Listed;
use super::pose::Pose;
use super::posture::Estimate;
use super::robot::{JointKind, Poses, Robot};
use super::slides::{PatchSlide, slides};
use super::surface::Surface;
use crate::error::{Error, Result, RobotError, SettingError};
use glam::DVec2;
use std::borrow::Cow;
use std::f64::consts::TAU;
use std::sync::Arc;
use taxel_core::garment::{Garment, Layout};

/// A garment's surface whose links, and joints that move the cloth, are those of a robot.
#[derive(Debug, Clone)]
pub struct RobotSurface {
    parts: SurfaceParts,
    robot: Arc<Robot>,
    /// The surface with the joints at 0.
    surface: Surface,
    slides: Vec<PatchSlide>,
    /// Number in the robot of each of [`Surface::links`].
    links: Vec<usize>,
    /// Distance of the farthest taxel from the origin of each of them, m.
    farthest: Vec<f64>,
}

/// Parts of the surface.
#[derive(Debug, Clone)]
struct SurfaceParts {
    body: Body,
    garment: Garment,
    layout: Layout,
    listed: Vec<(usize, Vec<Listed>)>,
}

impl SurfaceParts {
    fn surface(&self, shifts: &[DVec2]) -> Result<Surface, SettingError> {
        Surface::build_with(&self.body, &self.garment, &self.layout, &self.listed, shifts)
    }

    /// Checks that each patch lies on a link of the robot: its own link, or that of its panel.
    fn check_links(&self, robot: &Robot) -> Result<(), SettingError> {
        for (index, patch) in self.body.patches.iter().enumerate() {
            let panel = self.garment.panels.iter().find(|panel| panel.name.as_str() == patch.panel);
            let (key, link) = match (&patch.link, panel) {
                (Some(link), _) => ("link", link.as_str()),
                (None, Some(panel)) => ("panel", panel.link.as_str()),
                (None, None) => continue,
            };
            if let Err(error) = robot.link(link) {
                let key = format!("patches[{index}].{key}");
                return Err(SettingError::Key { text: format!("`{key}` {error}"), key });
            }
        }
        Ok(())
    }
}

impl RobotSurface {
    /// Places the taxels of a garment on a robot. Errors name the patch by index and key: a link or a joint
    /// that the robot does not have, or a panel that slides off its surface.
    pub fn build(body: &Body, garment: &Garment, layout: &Layout, robot: Arc<Robot>) -> Result<RobotSurface> {
        RobotSurface::build_with(body, garment, layout, robot, &[]).map_err(Error::from)
    }

    /// [`RobotSurface::build`] with the taxels of files, by patch.
    pub(super) fn build_with(
        body: &Body,
        garment: &Garment,
        layout: &Layout,
        robot: Arc<Robot>,
        listed: &[(usize, Vec<Listed>)],
    ) -> Result<RobotSurface, SettingError> {
        let (body, garment, layout) = (body.clone(), garment.clone(), layout.clone());
        let parts = SurfaceParts { body, garment, layout, listed: listed.to_vec() };
        let surface = parts.surface(&[])?;
        parts.check_links(&robot)?;
        // Each was found just now.
        let links: Vec<usize> = surface.links().iter().filter_map(|name| robot.link(name).ok()).collect();
        let mut farthest = vec![0.0; links.len()];
        for place in surface.places().iter().flatten() {
            farthest[place.link] = place.at.length().max(farthest[place.link]);
        }
        let slides = slides(&parts.body, &robot)?;
        let made = RobotSurface { parts, robot, surface, slides, links, farthest };
        made.check_slides()?;
        Ok(made)
    }

    /// Checks that the patches stay on their surfaces while one joint goes from limit to limit.
    fn check_slides(&self) -> Result<(), SettingError> {
        for slide in &self.slides {
            let joint = self.robot.free().get(slide.free()).and_then(|joint| self.robot.joints().get(*joint));
            let limits =
                joint.and_then(|joint| joint.limits.clone()).map(|limits| [*limits.start(), *limits.end()]);
            for end in limits.into_iter().flatten() {
                let mut posture = self.robot.rest();
                posture[slide.free()] = end;
                self.slid(&posture).map_err(|error| {
                    let key = format!("patches[{}].slides", slide.patch);
                    SettingError::Key {
                        text: format!("`{key}` move the panel off its surface: {error}"),
                        key,
                    }
                })?;
            }
        }
        Ok(())
    }

    /// The surface in the frames of its links, with the joints at 0.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// The robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Numbers, among [`Robot::free`], of the joints that move the surface in a frame, by the number of the
    /// frame's link: 0 is the base.
    pub fn moving(&self, frame: usize) -> Vec<usize> {
        let carry = self.links.iter().flat_map(|link| self.robot.moving(*link, frame));
        let mut all: Vec<usize> = carry.chain(self.slides.iter().map(PatchSlide::free)).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The surface in the frames of its links, where the cloth has slid to in a posture: the positions of
    /// [`Robot::free`], rad or m. The error names a patch that is off its surface.
    pub fn slid(&self, posture: &[f64]) -> Result<Cow<'_, Surface>, SettingError> {
        if self.slides.is_empty() {
            return Ok(Cow::Borrowed(&self.surface));
        }
        let mut shifts = vec![DVec2::ZERO; self.parts.body.patches.len()];
        for slide in &self.slides {
            shifts[slide.patch] += slide.way(posture);
        }
        self.parts.surface(&shifts).map(Cow::Owned)
    }

    /// Poses of [`Surface::links`] in a frame. Contacts and wrenches of a link are seen from there by
    /// [`TaxelPlace::seen_from`](super::TaxelPlace::seen_from) and
    /// [`Wrench::seen_from`](super::Wrench::seen_from). None without such a frame.
    pub fn poses(&self, poses: &Poses, frame: usize) -> Option<Vec<Pose>> {
        self.links.iter().map(|link| poses.of(*link, frame)).collect()
    }

    /// The surface in a posture, in the frame of one link: places and normals, and whatever is computed from
    /// them. Errors name a patch that has slid off its surface, or a frame that the robot does not have.
    pub fn seen_from(&self, posture: &[f64], frame: usize) -> Result<Surface> {
        let poses = self.poses(&self.robot.poses(posture), frame).ok_or_else(|| {
            let text = format!("{}: there is no link of number {frame}", self.robot.file());
            RobotError::NoLink { link: frame.to_string(), text }
        })?;
        Ok(self.slid(posture)?.moved(&poses))
    }

    /// The most, in metres, by which any taxel is elsewhere in a frame than an estimated posture says.
    pub fn displacement(&self, estimate: &Estimate, frame: usize) -> f64 {
        let Estimate { posture, errors, .. } = estimate;
        // Panels do not stretch: no taxel goes farther than its panel.
        let off: f64 = self.slides.iter().map(|slide| slide.error(errors)).sum();
        let way: f64 = self.slides.iter().map(|slide| slide.way(posture).length()).sum();
        let of = |(link, farthest): (&usize, &f64)| {
            self.robot.displacement((*link, frame), farthest + way + off, posture, errors)
        };
        self.links.iter().zip(&self.farthest).map(of).fold(0.0, f64::max) + off
    }

    /// The most, in metres, by which any taxel is elsewhere in a frame, at the time of an estimate, than a
    /// board says whose links were sent in the posture `sent`. A board's table has the cloth as it lies with
    /// the joints at 0: the way that it slides counts, too.
    pub(crate) fn sent_displacement(&self, sent: &[f64], estimate: &Estimate, frame: usize) -> f64 {
        let errors: Vec<f64> = (0..estimate.posture.len())
            .map(|free| {
                let off = sent.get(free).map_or(f64::INFINITY, |sent| (sent - estimate.posture[free]).abs());
                let turns = self.robot.free().get(free).and_then(|joint| self.robot.joints().get(*joint));
                let is_continuous = turns.is_some_and(|joint| joint.kind == JointKind::Continuous);
                // Whole turns are none.
                let off = if is_continuous { (off % TAU).min(TAU - off % TAU) } else { off };
                off + estimate.errors.get(free).copied().unwrap_or(f64::INFINITY)
            })
            .collect();
        let slid: f64 = self.slides.iter().map(|slide| slide.way(&estimate.posture).length()).sum();
        let sent = Estimate { posture: sent.to_vec(), errors, age: estimate.age };
        self.displacement(&sent, frame) + slid
    }
}
