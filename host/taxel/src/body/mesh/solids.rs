//! Boxes, cylinders and spheres as triangles.

use super::model::Mesh;
use crate::body::robot::LinkSolid;
use glam::DVec3;
use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

/// Sides of what is round.
const SIDES: usize = 16;

/// The mesh of a shape in its link's frame, m; none of one that a file has.
pub(super) fn mesh_of(solid: &LinkSolid) -> Option<Mesh> {
    Some(match solid {
        LinkSolid::Mesh(_) => return None,
        LinkSolid::Box(size, origin) => turned(&prism(FRAC_1_SQRT_2, 1.0), 4).placed(*size, origin),
        LinkSolid::Cylinder([radius, length], origin) => {
            turned(&prism(*radius, *length), SIDES).placed(DVec3::ONE, origin)
        }
        LinkSolid::Sphere(radius, origin) => {
            let angles = (0..=SIDES / 2).map(|step| PI * step as f64 / (SIDES / 2) as f64);
            let outline: Vec<_> = angles.map(|angle| [radius * angle.sin(), -radius * angle.cos()]).collect();
            turned(&outline, SIDES).placed(DVec3::ONE, origin)
        }
    })
}

/// The outline of a prism: distance from the z axis and height of each edge, upwards.
fn prism(radius: f64, length: f64) -> [[f64; 2]; 4] {
    let half = length / 2.0;
    [[0.0, -half], [radius, -half], [radius, half], [0.0, half]]
}

/// An outline turned about the z axis.
fn turned(outline: &[[f64; 2]], sides: usize) -> Mesh {
    let corner = |[radius, z]: [f64; 2], side: usize| {
        // A box has its sides across the axes.
        let angle = TAU * ((side % sides) as f64 + 0.5) / sides as f64;
        DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
    };
    let rings = outline.windows(2).flat_map(|pair| (0..sides).map(move |side| (pair[0], pair[1], side)));
    Mesh::of(rings.flat_map(|(below, above, side)| {
        let [a, b] = [side, side + 1].map(|side| corner(below, side));
        let [d, c] = [side, side + 1].map(|side| corner(above, side));
        [[a, b, c], [a, c, d]]
    }))
}
