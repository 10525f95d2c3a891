//! A robot's description and the meshes of its links, as people and exporters write them.

use taxel::body::DVec3;
use taxel::body::mesh;
use taxel::body::robot::{Robot, parse};

/// Reads the bytes as a URDF and as meshes. A robot is a tree that has a pose in each posture, a mesh has a nearest
/// point; an error names the file.
pub fn run(data: &[u8]) {
    for file in ["any.stl", "any.obj"] {
        match mesh::parse(file, data) {
            Ok(mesh) => _ = mesh.nearest(DVec3::ONE),
            Err(error) => assert!(error.to_string().starts_with(file), "{error}"),
        }
    }
    match parse("any.urdf", &String::from_utf8_lossy(data)) {
        Ok(robot) => moves(&robot),
        Err(error) => assert!(error.to_string().starts_with("any.urdf"), "{error}"),
    }
}

fn moves(robot: &Robot) {
    let (links, joints) = (robot.links().len(), robot.joints());
    assert!(
        links == joints.len() + 1 && joints.iter().enumerate().all(|(number, joint)| joint.parent <= number)
    );
    let rest = robot.rest();
    assert_eq!(rest.len(), robot.free().len(), "each free joint has a position");
    let poses = robot.poses(&rest);
    let last = links - 1;
    assert!(poses.of(last, 0).is_some() && poses.of(links, 0).is_none());
    let moving = robot.moving(last, 0);
    let errors = vec![0.1; rest.len()];
    let is_off = robot.displacement((last, 0), 0.1, &rest, &errors) > 0.0;
    assert!(!is_off || !moving.is_empty(), "what no joint moves is not off");
}
