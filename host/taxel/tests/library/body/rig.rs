//! Robots made at random, with forward kinematics by 4 x 4 matrices beside ours.

use proptest::prelude::*;
use std::fmt::Write;

/// A joint between the link `parent` and the link after its own number.
#[derive(Debug, Clone)]
pub struct RigJoint {
    pub parent: usize,
    pub kind: &'static str,
    pub xyz: [f64; 3],
    pub rpy: [f64; 3],
    pub axis: [f64; 3],
    /// rad or m
    pub position: f64,
}

/// A robot: joint `j0` carries link `l1`, and so on; `l0` is the root.
pub type Rig = Vec<RigJoint>;

/// A matrix by rows.
pub type Matrix = [[f64; 4]; 4];

/// Robots of up to ten joints.
pub fn rigs() -> impl Strategy<Value = Rig> {
    let kinds = prop::sample::select(vec!["revolute", "continuous", "prismatic", "fixed"]);
    let axis = prop::array::uniform3(-1.0..1.0f64)
        .prop_filter("a direction", |axis| axis.iter().map(|part| part * part).sum::<f64>() > 0.01);
    let joint = (any::<prop::sample::Index>(), kinds, prop::array::uniform3(-0.5..0.5f64));
    let joint = (joint, prop::array::uniform3(-4.0..4.0f64), axis, -2.0..2.0f64);
    prop::collection::vec(joint, 1..10).prop_map(|joints| {
        let joint = |(number, ((parent, kind, xyz), rpy, axis, position)): (usize, (_, _, _, _))| {
            let parent: prop::sample::Index = parent;
            let position = if kind == "fixed" { 0.0 } else { position };
            RigJoint { parent: parent.index(number + 1), kind, xyz, rpy, axis, position }
        };
        joints.into_iter().enumerate().map(joint).collect()
    })
}

/// Its URDF, the last joint first: the order of a file is of no importance.
pub fn urdf(rig: &[RigJoint]) -> String {
    let mut text = String::from("<robot name=\"rig\">\n");
    for (number, joint) in rig.iter().enumerate().rev() {
        let list = |numbers: [f64; 3]| numbers.map(|number| format!("{number:?}")).join(" ");
        let (xyz, rpy, axis) = (list(joint.xyz), list(joint.rpy), list(joint.axis));
        let _ = writeln!(
            text,
            "<link name=\"l{}\"/><joint name=\"j{number}\" type=\"{}\"><parent link=\"l{}\"/>\
             <child link=\"l{}\"/><origin xyz=\"{xyz}\" rpy=\"{rpy}\"/><axis xyz=\"{axis}\"/>\
             <limit lower=\"-3\" upper=\"3\" effort=\"1\" velocity=\"1\"/></joint>",
            number + 1,
            joint.kind,
            joint.parent,
            number + 1,
        );
    }
    text + "<link name=\"l0\"/></robot>\n"
}

/// Poses of the links in the base.
pub fn matrices(rig: &[RigJoint]) -> Vec<Matrix> {
    let mut all = vec![identity()];
    for joint in rig {
        let [roll, pitch, yaw] = joint.rpy;
        let [x, y, z] = joint.xyz;
        let turns = [([0.0, 0.0, 1.0], yaw), ([0.0, 1.0, 0.0], pitch), ([1.0, 0.0, 0.0], roll)];
        let mut origin = moved([x, y, z]);
        for (axis, angle) in turns {
            origin = product(&origin, &turned(axis, angle));
        }
        let length = joint.axis.iter().map(|part| part * part).sum::<f64>().sqrt();
        let axis = joint.axis.map(|part| part / length);
        let motion = match joint.kind {
            "prismatic" => moved(axis.map(|part| part * joint.position)),
            _ => turned(axis, joint.position),
        };
        let pose = product(&all[joint.parent], &product(&origin, &motion));
        all.push(pose);
    }
    all
}

/// A point under a matrix.
pub fn point(matrix: &Matrix, [x, y, z]: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|row| {
        let [a, b, c, d] = matrix[row];
        a * x + b * y + c * z + d
    })
}

fn identity() -> Matrix {
    moved([0.0; 3])
}

fn moved([x, y, z]: [f64; 3]) -> Matrix {
    [[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z], [0.0, 0.0, 0.0, 1.0]]
}

/// By the formula of Rodrigues.
fn turned([x, y, z]: [f64; 3], angle: f64) -> Matrix {
    let (sin, cos) = angle.sin_cos();
    let rest = 1.0 - cos;
    [
        [cos + x * x * rest, x * y * rest - z * sin, x * z * rest + y * sin, 0.0],
        [y * x * rest + z * sin, cos + y * y * rest, y * z * rest - x * sin, 0.0],
        [z * x * rest - y * sin, z * y * rest + x * sin, cos + z * z * rest, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|row| std::array::from_fn(|column| (0..4).map(|k| a[row][k] * b[k][column]).sum()))
}
