//! A robot's description, the meshes of its links, marks on it and touches of it, as people and exporters
//! write them.

use taxel::body::DVec3;
use taxel::body::fit::{known_touches, marks};
use taxel::body::mesh;
use taxel::body::robot::{LinkShape, Robot, meshes, parse, solids};

/// Reads the bytes as a URDF, as meshes, as marks and as touches. A robot is a tree that has a pose in each
/// posture, a mesh has a nearest point; an error names the file.
pub fn run(data: &[u8]) {
    for file in ["any.stl", "any.obj"] {
        match mesh::parse(file, data) {
            Ok(mesh) => _ = mesh.nearest(DVec3::ONE),
            Err(error) => assert!(error.to_string().starts_with(file), "{error}"),
        }
    }
    let text = String::from_utf8_lossy(data);
    match parse("any.urdf", &text) {
        Ok(robot) => {
            moves(&robot);
            let of = solids("any.urdf", &text, LinkShape::Visual).expect("what is a robot has links");
            for error in of.into_iter().filter_map(|(_, solids)| solids.err()) {
                assert!(error.to_string().starts_with("any.urdf"), "{error}");
            }
            for link in robot.links() {
                match meshes("any.urdf", &text, &link.name, LinkShape::Visual) {
                    Ok(meshes) => assert!(!meshes.is_empty()),
                    Err(error) => assert!(error.to_string().starts_with("any.urdf"), "{error}"),
                }
            }
        }
        Err(error) => assert!(error.to_string().starts_with("any.urdf"), "{error}"),
    }
    match known_touches("any.csv", &text) {
        Ok(touches) => assert!(touches.iter().all(|touch| touch.at().is_finite())),
        Err(error) => assert!(error.to_string().starts_with("any.csv"), "{error}"),
    }
    match marks("any.txt", &text) {
        Ok(marks) => assert!(marks.iter().all(|mark| mark.at.is_finite())),
        Err(error) => assert!(error.to_string().starts_with("any.txt"), "{error}"),
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
