//! The surface of a link as triangles.

use crate::body::pose::Pose;
use glam::DVec3;
use std::collections::HashMap;

/// The finest grid of a coarse mesh, m.
const FINEST: f64 = 0.002;
/// By how much the next grid is wider.
const WIDER: f64 = 1.4;
/// Most grids that are tried: the widest has 10^9 m.
const GRIDS: usize = 80;

/// A surface of triangles, in metres. Corners at the same place are one.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    points: Vec<DVec3>,
    triangles: Vec<[usize; 3]>,
}

/// The point of a mesh that is nearest to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// The point, m.
    pub at: DVec3,
    /// Normal of its triangle, of length 1: outwards, if the corners run counter-clockwise as seen from
    /// outside.
    pub normal: DVec3,
    /// Number of its triangle.
    pub triangle: usize,
    /// Distance, m.
    pub distance: f64,
}

impl Mesh {
    /// Joins triangles by their corners; those without an area are left out.
    pub(super) fn of(corners: impl IntoIterator<Item = [DVec3; 3]>) -> Mesh {
        let mut mesh = Mesh::default();
        let mut numbers: HashMap<[u64; 3], usize> = HashMap::new();
        for corners in corners {
            let [a, b, c] = corners;
            if (b - a).cross(c - a) == DVec3::ZERO {
                continue;
            }
            let triangle = corners.map(|corner| {
                // 0 and -0 are the same place.
                let place = (corner + DVec3::ZERO).to_array().map(f64::to_bits);
                *numbers.entry(place).or_insert_with(|| {
                    mesh.points.push(corner);
                    mesh.points.len() - 1
                })
            });
            mesh.triangles.push(triangle);
        }
        mesh
    }

    /// Returns its corners, m.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Returns its triangles: numbers of their corners.
    pub fn triangles(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    /// The mesh as a URDF uses it: each axis scaled, then placed in the link's frame.
    pub fn placed(&self, scale: DVec3, pose: &Pose) -> Mesh {
        let points = self.points.iter().map(|point| pose.point(*point * scale)).collect();
        let mut triangles = self.triangles.clone();
        if scale.x * scale.y * scale.z < 0.0 {
            // A mirrored triangle runs the other way round.
            triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        Mesh { points, triangles }
    }

    /// Several meshes as one.
    pub(super) fn joined(parts: &[Mesh]) -> Mesh {
        let of =
            |part: &Mesh| part.triangles.iter().map(|triangle| part.corners(*triangle)).collect::<Vec<_>>();
        Mesh::of(parts.iter().flat_map(of))
    }

    /// The mesh with at most `most` triangles: the corners in a cell of a grid become their mean, and the grid widens until
    /// few enough are left.
    pub fn coarse(self, most: usize) -> Mesh {
        if self.triangles.len() <= most {
            return self;
        }
        let merged = |grid: f64| {
            let cell = |corner: &DVec3| (*corner / grid).floor().to_array().map(|part| part as i64);
            let mut cells: HashMap<[i64; 3], (DVec3, f64)> = HashMap::new();
            for corner in &self.points {
                let (sum, count) = cells.entry(cell(corner)).or_default();
                (*sum, *count) = (*sum + *corner, *count + 1.0);
            }
            let mean = |number: usize| {
                let (sum, count) = cells[&cell(&self.points[number])];
                sum / count
            };
            Mesh::of(self.triangles.iter().map(|triangle| triangle.map(mean)))
        };
        let grids = std::iter::successors(Some(FINEST), |grid| Some(grid * WIDER)).take(GRIDS);
        grids.map(merged).find(|mesh| mesh.triangles.len() <= most).unwrap_or_default()
    }

    /// The triangles that come within a distance of a point, m.
    pub(super) fn around(&self, at: DVec3, distance: f64) -> Mesh {
        let is_near =
            |triangle: &&[usize; 3]| nearest_of(self.corners(**triangle), at).distance(at) <= distance;
        Mesh::of(self.triangles.iter().filter(is_near).map(|triangle| self.corners(*triangle)))
    }

    /// Corners of a triangle.
    fn corners(&self, triangle: [usize; 3]) -> [DVec3; 3] {
        triangle.map(|number| self.points[number])
    }

    /// The point that is nearest to another, ties to the first; none if there are no triangles.
    pub fn nearest(&self, to: DVec3) -> Option<Nearest> {
        let mut best: Option<(usize, DVec3, f64)> = None;
        for (number, triangle) in self.triangles.iter().enumerate() {
            let at = nearest_of(self.corners(*triangle), to);
            let distance = at.distance_squared(to);
            if best.is_none_or(|(_, _, least)| distance < least) {
                best = Some((number, at, distance));
            }
        }
        let (triangle, at, distance) = best?;
        let [a, b, c] = self.corners(self.triangles[triangle]);
        let normal = (b - a).cross(c - a).try_normalize()?;
        Some(Nearest { at, normal, triangle, distance: distance.sqrt() })
    }
}

/// The point of a triangle that is nearest to `to`: by the regions of its corners, edges and inside
/// (C. Ericson, Real-Time Collision Detection, 5.1.5).
fn nearest_of([a, b, c]: [DVec3; 3], to: DVec3) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let [from_a, from_b, from_c] = [to - a, to - b, to - c];
    let (d1, d2) = (ab.dot(from_a), ac.dot(from_a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let (d3, d4) = (ab.dot(from_b), ac.dot(from_b));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let (d5, d6) = (ab.dot(from_c), ac.dot(from_c));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let on_ab = d1 * d4 - d3 * d2;
    if on_ab <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let on_ac = d5 * d2 - d1 * d6;
    if on_ac <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let on_bc = d3 * d6 - d5 * d4;
    if on_bc <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let whole = on_ab + on_ac + on_bc;
    a + ab * (on_ac / whole) + ac * (on_ab / whole)
}
