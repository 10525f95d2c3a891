//! Meshes: a sphere and a cube in each format, the nearest point, and files that are none.

use glam::DQuat;
use proptest::prelude::*;
use std::fmt::Write;
use taxel::body::mesh::{Drape, Mesh, parse};
use taxel::body::{DVec3, Pose};

/// A cube of 1 m, as an OBJ of six squares.
const CUBE: &str = "# a cube\no cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1 0.5 0.5 0.5\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
                    vn 0 0 1\nf 4 3 2 1\nf 5//1 6//1 7//1 8//1\nf 1/1 2/2 6/3 5/4\nf -6 -5 -1 -2\nf 2 3 7 6\nf 1 5 8 4\n";

/// Triangles of a sphere of 1 m about the origin, by longitude and latitude.
fn sphere(steps: usize) -> Vec<[DVec3; 3]> {
    let point = |row: usize, column: usize| {
        let (up, round) = (
            std::f64::consts::PI * row as f64 / steps as f64,
            std::f64::consts::PI * column as f64 / steps as f64,
        );
        DVec3::new(up.sin() * round.cos(), up.sin() * round.sin(), up.cos())
    };
    let squares = (0..steps).flat_map(|row| (0..2 * steps).map(move |column| (row, column)));
    let both = |(row, column): (usize, usize)| {
        let [a, b, c, d] = [(row, column), (row + 1, column), (row + 1, column + 1), (row, column + 1)]
            .map(|(r, c)| point(r, c));
        [[a, b, c], [a, c, d]]
    };
    squares.flat_map(both).collect()
}

fn binary(triangles: &[[DVec3; 3]]) -> Vec<u8> {
    let mut bytes = b"solid in its name, and binary".to_vec();
    bytes.resize(80, b' ');
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for corners in triangles {
        bytes.extend([0; 12]);
        corners
            .iter()
            .flat_map(|corner| corner.to_array())
            .for_each(|x| bytes.extend((x as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn ascii(triangles: &[[DVec3; 3]]) -> String {
    let mut text = String::from("solid sphere\n");
    for corners in triangles {
        let _ = writeln!(text, "  facet normal 0 0 0\n    outer loop");
        corners.iter().for_each(|at| _ = writeln!(text, "      vertex {:e} {:e} {:e}", at.x, at.y, at.z));
        let _ = writeln!(text, "    endloop\n  endfacet");
    }
    text + "endsolid sphere\n"
}

#[test]
fn a_sphere_is_the_same_in_each_format() {
    let triangles = sphere(24);
    for (file, bytes, within) in
        [("a.STL", binary(&triangles), 1e-7), ("b.stl", ascii(&triangles).into_bytes(), 1e-15)]
    {
        let mesh = parse(file, &bytes).unwrap();
        // Those at the poles have no area.
        assert!((2 * 24 * 46..=2 * 24 * 48).contains(&mesh.triangles().len()), "{}", mesh.triangles().len());
        assert!(
            mesh.points().len() < mesh.triangles().len()
                && mesh.points().iter().all(|at| (at.length() - 1.0).abs() < within)
        );
        for to in [DVec3::new(2.0, 1.0, 0.5), DVec3::new(-0.1, 0.3, -0.7), DVec3::new(0.0, 3.0, 0.0)] {
            let near = mesh.nearest(to).unwrap();
            // The flat triangles lie within the sphere by a 24th of a half turn's arc.
            assert!(near.at.distance(to.normalize()) < 0.1 && near.at.length() > 0.99, "{near:?}");
            assert!(
                near.normal.dot(to.normalize()) > 0.99
                    && (near.distance - near.at.distance(to)).abs() < 1e-12
            );
        }
    }
}

#[test]
fn a_cube_is_read_from_its_squares() {
    let cube = parse("cube.obj", CUBE.as_bytes()).unwrap();
    assert_eq!((cube.points().len(), cube.triangles().len()), (8, 12));
    let near =
        |mesh: &Mesh, at: [f64; 3]| mesh.nearest(at.into()).map(|near| (near.at, near.normal)).unwrap();
    // Inside a face, at an edge, at a corner.
    assert_eq!(near(&cube, [0.25, 0.5, 1.5]), (DVec3::new(0.25, 0.5, 1.0), DVec3::Z));
    assert_eq!(near(&cube, [-1.0, 0.5, 0.25]), (DVec3::new(0.0, 0.5, 0.25), DVec3::NEG_X));
    assert_eq!(near(&cube, [2.0, 0.25, 2.0]).0, DVec3::new(1.0, 0.25, 1.0));
    assert_eq!(near(&cube, [-1.0, -1.0, -1.0]).0, DVec3::ZERO);
    // A URDF's scale and origin; one that mirrors keeps the normals outside.
    let pose =
        Pose { at: DVec3::new(0.0, 0.0, 2.0), turn: DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2) };
    let placed = cube.placed(DVec3::new(0.001, 0.001, -0.002), &pose);
    let (at, normal) = near(&placed, [0.0005, 1.0, 2.0005]);
    assert!(
        at.abs_diff_eq(DVec3::new(0.0005, 0.002, 2.0005), 1e-12) && normal.abs_diff_eq(DVec3::Y, 1e-12),
        "{at} {normal}"
    );
}

#[test]
fn what_is_no_mesh_is_reported() {
    let why = |file: &str, bytes: &[u8]| parse(file, bytes).unwrap_err().to_string();
    let cut = &binary(&sphere(3))[..400];
    let mut bent = binary(&sphere(3));
    bent[84 + 50 + 12..84 + 50 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(why("a.dae", b""), "a.dae: meshes are read from .stl and .obj files");
    assert_eq!(why("a.stl", b""), "a.stl: not an STL");
    assert_eq!(why("a.stl", b"solid\n facet\n"), "a.stl, line 2: it ends without `endsolid`");
    assert_eq!(why("a.stl", &[0xff; 90]), "a.stl: it says 4294967295 triangles, and holds 0");
    assert_eq!(
        why("a.stl", &cut.iter().map(|byte| byte | 128).collect::<Vec<_>>()),
        "a.stl: it says 2155905188 triangles, and holds 6"
    );
    assert_eq!(why("a.stl", &bent), "a.stl, triangle 1: not finite");
    assert_eq!(why("a.stl", b"solid\nvertex 0 0\n"), "a.stl, line 2: a vertex must have three numbers");
    assert_eq!(
        why("a.stl", b"solid\nvertex 0 0 1\nendfacet"),
        "a.stl, line 3: a facet must have three vertices"
    );
    assert_eq!(why("a.stl", b"solid\nendsolid"), "a.stl: it has no triangles");
    assert_eq!(why("a.obj", b"v 0 0 inf"), "a.obj, line 1: a point must have three numbers");
    assert_eq!(why("a.obj", b"v 0 0 0\nf 1 1"), "a.obj, line 2: a face must have three corners or more");
    assert_eq!(why("a.obj", b"f"), "a.obj, line 1: a face without corners");
    assert_eq!(why("a.obj", b"f 1 2 3"), "a.obj, line 1: there is no point 1 among the 0 above");
    assert_eq!(why("a.obj", b"v 0 0 0\nf 1 0 1"), "a.obj, line 2: there is no point 0 among the 1 above");
    assert_eq!(why("a.obj", b"v 0 0 0\nf 1 -2 1"), "a.obj, line 2: there is no point -2 among the 1 above");
    assert_eq!(why("a.obj", b"f a"), "a.obj, line 1: a corner must be a number of a point, not \"a\"");
    // All in one place: no area.
    assert_eq!(why("a.obj", b"v 0 0 0\nf 1 1 1"), "a.obj: it has no triangles");
}

/// A closed cylinder's side of 6 cm by 40 cm about the z axis, of 96 strips.
fn cylinder() -> Mesh {
    let point = |step: usize, z: f64| {
        let around = std::f64::consts::TAU * step as f64 / 96.0;
        DVec3::new(0.06 * around.cos(), 0.06 * around.sin(), z)
    };
    let both = |step: usize| {
        let [a, b, c, d] = [point(step, 0.0), point(step + 1, 0.0), point(step + 1, 0.4), point(step, 0.4)];
        [[a, b, c], [a, c, d]]
    };
    let triangles: Vec<[DVec3; 3]> = (0..96).flat_map(both).collect();
    parse("cylinder.stl", ascii(&triangles).as_bytes()).unwrap()
}

/// Least and greatest distance of neighbours, as a share of 1 cm.
fn stretch(all: &[(DVec3, DVec3)], columns: usize) -> (f64, f64) {
    let steps = (0..all.len()).flat_map(|taxel| {
        let right = (taxel % columns + 1 < columns).then_some(taxel + 1);
        right
            .into_iter()
            .chain(Some(taxel + columns))
            .filter(|next| *next < all.len())
            .map(move |next| (taxel, next))
    });
    let shares = steps.map(|(a, b)| all[a].0.distance(all[b].0) / 0.01);
    shares.fold((f64::MAX, 0.0), |(least, most), share| (least.min(share), most.max(share)))
}

#[test]
fn cloth_lies_on_a_cylinder_as_on_its_form() {
    let drape = Drape {
        rows: 30,
        columns: 16,
        pitch: [0.01; 2],
        at: DVec3::new(0.1, 0.0, 0.2),
        down: DVec3::new(0.1, 0.0, -1.0),
    };
    let all = drape.over(&cylinder()).unwrap();
    assert_eq!(all.len(), 480);
    let (least, most) = stretch(&all, 16);
    let mut worst = (0.0f64, 0.0f64);
    for (taxel, (at, normal)) in all.iter().enumerate() {
        let angle = (taxel % 16) as f64 - 7.5;
        let (sin, cos) = (angle * 0.01 / 0.06).sin_cos();
        let exact = DVec3::new(0.06 * cos, 0.06 * sin, 0.2 - ((taxel / 16) as f64 - 14.5) * 0.01);
        worst.0 = worst.0.max(at.distance(exact));
        worst.1 = worst.1.max(normal.angle_between(DVec3::new(cos, sin, 0.0)));
    }
    println!(
        "on a cylinder: at most {:.3} mm and {:.4} rad off, neighbours at {least:.5} to {most:.5}",
        worst.0 * 1e3,
        worst.1
    );
    assert!(least > 0.999 && most < 1.001 && worst.0 < 1e-3 && worst.1 < 0.06);
}

#[test]
fn cloth_on_a_sphere_shears_and_does_not_stretch() {
    let ball =
        parse("ball.stl", ascii(&sphere(60)).as_bytes()).unwrap().placed(DVec3::splat(0.15), &Pose::IDENTITY);
    let drape = Drape { rows: 16, columns: 16, pitch: [0.01; 2], at: DVec3::X, down: DVec3::NEG_Z };
    let all = drape.over(&ball).unwrap();
    let (least, most) = stretch(&all, 16);
    let off = all.iter().map(|(at, normal)| normal.angle_between(*at)).fold(0.0, f64::max);
    println!("on a sphere: neighbours at {least:.5} to {most:.5}, normals within {off:.3} rad");
    assert!(least > 0.99 && most < 1.01 && off < 0.12);
    assert!(all.iter().all(|(at, _)| (at.length() - 0.15).abs() < 3e-4));
}

#[test]
fn a_panel_larger_than_the_mesh_finds_no_place() {
    let at = DVec3::new(0.1, 0.0, 0.2);
    let drape = Drape { rows: 42, columns: 4, pitch: [0.01; 2], at, down: DVec3::NEG_Z };
    let error = drape.over(&cylinder()).unwrap_err().to_string();
    assert!(error.ends_with("has no place on the mesh: an edge, a hole or a fold is there"), "{error}");
    assert!(Drape { rows: 40, ..drape }.over(&cylinder()).is_ok());
    let edge = Drape { at: DVec3::X, rows: 4, ..drape }.over(&cylinder()).unwrap_err().to_string();
    assert!(edge.ends_with("has no place on the mesh: an edge, a hole or a fold is there"), "{edge}");
    let along = Drape { down: DVec3::X, rows: 4, ..drape }.over(&cylinder()).unwrap_err().to_string();
    assert_eq!(along, "`down` must be a direction across the surface");
    let none = Drape { pitch: [0.0; 2], ..drape }.over(&cylinder()).unwrap_err().to_string();
    assert_eq!(none, "a panel must have two rows and columns, and a pitch");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(500) })]

    /// The nearest point is nearer than any other of the same triangle.
    #[test]
    fn no_point_is_nearer(
        corners in prop::array::uniform9(-1.0..1.0f64),
        to in prop::array::uniform3(-2.0..2.0f64),
        (u, v) in (0.0..1.0f64, 0.0..1.0f64),
    ) {
        let [ax, ay, az, bx, by, bz, cx, cy, cz] = corners;
        let text = format!("v {ax:e} {ay:e} {az:e}\nv {bx:e} {by:e} {bz:e}\nv {cx:e} {cy:e} {cz:e}\nf 1 2 3\n");
        let mesh = parse("t.obj", text.as_bytes()).unwrap();
        let near = mesh.nearest(to.into()).unwrap();
        let [a, b, c] = [0, 1, 2].map(|corner| mesh.points()[corner]);
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        let other = a + (b - a) * u + (c - a) * v;
        prop_assert!(near.distance <= other.distance(to.into()) + 1e-12);
        // It lies on the triangle's plane.
        prop_assert!((near.at - a).dot(near.normal).abs() < 1e-9);
    }

    #[test]
    fn nothing_panics(
        is_stl in any::<bool>(),
        kind in 0usize..3,
        edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), any::<bool>()), 0..8),
    ) {
        let mut bytes = vec![binary(&sphere(2)), ascii(&sphere(2)).into_bytes(), CUBE.as_bytes().to_vec()].swap_remove(kind);
        for (at, byte, is_cut) in edits {
            let at = at.index(bytes.len());
            if is_cut { _ = bytes.remove(at) } else { bytes[at] = byte }
        }
        if let Ok(mesh) = parse(if is_stl { "m.stl" } else { "m.obj" }, &bytes) {
            let _ = mesh.nearest(DVec3::ONE);
        }
    }
}
