//! Force, moment and centre of pressure by link.

use super::pose::Pose;
use super::surface::Surface;
use glam::DVec3;

/// Force and moment on a link. Friction is not felt: forces are along the normals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wrench {
    /// Index into [`Surface::links`].
    pub link: usize,
    /// Sum of the taxels' forces, N: each presses against its normal. In the surface's frame: that of the
    /// link, unless it is seen from another.
    pub force: DVec3,
    /// Their moment about the origin of that frame, N m.
    pub moment: DVec3,
    /// Sum of the magnitudes, N: more than that of `force` where the surface is curved.
    pub pressed: f64,
    /// Centre of pressure, m: the taxels' places, weighted by magnitude; 0 if nothing presses.
    pub center: DVec3,
}

impl Wrench {
    /// Returns the same force and centre in another frame, by the pose of this one in it, and the moment about the
    /// other's origin.
    pub fn seen_from(&self, pose: &Pose) -> Wrench {
        let force = pose.direction(self.force);
        let moment = pose.direction(self.moment) + pose.at.cross(force);
        let center = if self.pressed > 0.0 { pose.point(self.center) } else { self.center };
        Wrench { force, moment, center, ..*self }
    }
}

/// Returns the force and moment on each link: `newtons` by taxel, those without a place are left out.
pub fn wrenches(surface: &Surface, newtons: &[f64]) -> Vec<Wrench> {
    let none =
        |link| Wrench { link, force: DVec3::ZERO, moment: DVec3::ZERO, pressed: 0.0, center: DVec3::ZERO };
    let mut all: Vec<Wrench> = (0..surface.links().len()).map(none).collect();
    for (place, newtons) in surface.places().iter().zip(newtons) {
        let Some(place) = place.filter(|_| *newtons != 0.0) else { continue };
        let force = place.normal * -newtons;
        let wrench = &mut all[place.link];
        wrench.force += force;
        wrench.moment += place.at.cross(force);
        wrench.pressed += newtons;
        wrench.center += place.at * *newtons;
    }
    for wrench in all.iter_mut().filter(|wrench| wrench.pressed > 0.0) {
        wrench.center /= wrench.pressed;
    }
    all
}
