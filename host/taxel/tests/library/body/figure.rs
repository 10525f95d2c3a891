//! What a robot looks like: shapes of its URDF as triangles, and what is said of those that cannot be read.

use std::fmt::Write;
use std::path::Path;
use taxel::body::DVec3;
use taxel::body::mesh::{Figure, Mesh, figure};

const BALL: &str = "<geometry><sphere radius=\"0.1\"/></geometry>";

/// The figure of a URDF with these links, beside a file `ball.obj` of many triangles.
fn read(name: &str, links: &str) -> Figure {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("figure-{name}"));
    std::fs::create_dir_all(&folder).unwrap();
    let mut ball = String::new();
    let steps = 60;
    for (row, column) in (0..=steps).flat_map(|row| (0..steps).map(move |column| (row, column))) {
        let [tilt, turn] =
            [row, 2 * column].map(|step| f64::from(step) * std::f64::consts::PI / f64::from(steps));
        let [x, y, z] =
            [tilt.sin() * turn.cos(), tilt.sin() * turn.sin(), tilt.cos()].map(|part| 100.0 * part);
        writeln!(ball, "v {x} {y} {z}").unwrap();
    }
    for (row, column) in (0..steps).flat_map(|row| (0..steps).map(move |column| (row, column))) {
        let next = (column + 1) % steps;
        let [a, b] = [column, next].map(|column| row * steps + column + 1);
        writeln!(ball, "f {a} {} {} {b}", a + steps, b + steps).unwrap();
    }
    std::fs::write(folder.join("ball.obj"), ball).unwrap();
    let urdf = folder.join("robot.urdf");
    std::fs::write(&urdf, format!("<robot name=\"r\">\n{links}</robot>\n")).unwrap();
    figure(urdf.to_str().unwrap(), &[]).unwrap()
}

/// Least and greatest coordinates.
fn extent(mesh: &Mesh) -> [DVec3; 2] {
    let points = || mesh.points().iter().copied();
    [points().reduce(DVec3::min).unwrap(), points().reduce(DVec3::max).unwrap()]
}

/// Volume, m3: more than 0 if all triangles look outwards.
fn volume(mesh: &Mesh) -> f64 {
    let corners = mesh.triangles().iter().map(|triangle| triangle.map(|number| mesh.points()[number]));
    corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

#[test]
fn shapes_have_their_sizes_and_look_outwards() {
    let link = |name: &str, geometry: &str| {
        let origin = "<origin xyz=\"1 0 0\" rpy=\"0 0 1.5707963267948966\"/>";
        format!("<link name=\"{name}\"><visual>{origin}<geometry>{geometry}</geometry></visual></link>\n")
    };
    let links = link("box", "<box size=\"0.2 0.4 0.6\"/>")
        + &link("can", "<cylinder radius=\"0.1\" length=\"0.6\"/>")
        + &link("ball", "<sphere radius=\"0.1\"/>")
        + &link("file", "<mesh filename=\"ball.obj\" scale=\"0.001 0.001 0.001\"/>");
    let figure = read("sizes", &links);
    assert!(figure.lacks.is_empty(), "{:?}", figure.lacks);
    // Half of the size as the origin turns it, and the volume.
    let round = 4.0 / 3.0 * std::f64::consts::PI * 0.001;
    let wanted = [
        ("box", [0.2, 0.1, 0.3], 0.048),
        ("can", [0.1, 0.1, 0.3], 0.006 * std::f64::consts::PI),
        ("ball", [0.1, 0.1, 0.1], round),
        ("file", [0.1, 0.1, 0.1], round),
    ];
    assert_eq!(figure.links.len(), wanted.len());
    for ((name, mesh), (link, half, size)) in figure.links.iter().zip(wanted) {
        assert_eq!(name, link);
        let (middle, half) = (DVec3::new(1.0, 0.0, 0.0), DVec3::from(half));
        let [least, most] = extent(mesh);
        let off = (least - (middle - half)).abs().max((most - (middle + half)).abs()).max_element();
        assert!(off < 0.01, "{link}: {least}, {most}");
        let share = volume(mesh) / size;
        assert!((0.85..=1.05).contains(&share), "{link}: {share} of its volume");
        assert!((12..=1000).contains(&mesh.triangles().len()), "{link}: {}", mesh.triangles().len());
    }
}

#[test]
fn a_shape_that_cannot_be_read_costs_its_link_alone() {
    let links = format!(
        "<link name=\"plain\"/>\n<link name=\"head\"><visual>{BALL}</visual></link>\n\
         <link name=\"arm\"><visual><geometry><mesh filename=\"arm.dae\"/></geometry></visual>\n\
         <collision>{BALL}</collision></link>\n\
         <link name=\"hand\"><visual><geometry><mesh filename=\"hand.stl\"/></geometry></visual></link>\n\
         <link name=\"foot\"><visual><geometry><box size=\"1 0 1\"/></geometry></visual></link>\n\
         <link name=\"tail\"><visual><geometry><capsule radius=\"1\"/></geometry></visual></link>\n"
    );
    let figure = read("lacks", &links);
    let names: Vec<_> = figure.links.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["head", "arm"], "the arm as it collides");
    let [hand, foot] = figure.lacks.as_slice() else { panic!("{:?}", figure.lacks) };
    assert!(hand.contains("robot.urdf, line 6, link \"hand\"") && hand.contains("hand.stl"), "{hand}");
    assert!(foot.contains("line 7, link \"foot\": `size` of <box> must be"), "{foot}");
}

#[test]
fn the_reference_robot_has_a_figure_within_its_garment() {
    let Figure { links, lacks } = figure("reference", &[]).unwrap();
    assert!(lacks.is_empty(), "{lacks:?}");
    let (_, torso) = links.iter().find(|(name, _)| name == "torso").unwrap();
    let below_shoulders = torso.points().iter().filter(|at| at.z < 0.3);
    let widest = below_shoulders.map(|at| at.x.hypot(at.y)).fold(0.0, f64::max);
    assert!(widest > 0.05 && widest < 0.061_12, "{widest} m: the cloth is on a cylinder of 61.12 mm");
    assert!(links.len() >= 5, "{} links", links.len());
}
