//! The garment on the robot, against surfaces whose geometry is known.

use std::path::Path;
use taxel::body::{self, Body, DVec3, Surface, listed, wrenches};
use taxel_core::garment::{Garment, Layout};

/// Pitch of the mat, m.
const PITCH: f64 = 0.01;

fn layout(garment: &Garment) -> Layout {
    Layout::build(garment, 2048, 4095).unwrap()
}

/// The mat of 64 x 32 on a surface.
fn mat_on(on: &str) -> Result<Surface, String> {
    let text = format!("[[patches]]\npanel = \"mat\"\n{on}");
    let body: Body = toml::from_str(&text).map_err(|error| error.to_string())?;
    let garment = Garment::mat();
    Surface::build(&body, &garment, &layout(&garment)).map_err(|error| error.to_string())
}

/// Places of the mat's taxels.
fn places(surface: &Surface) -> Vec<(DVec3, DVec3)> {
    surface.places().iter().map(|place| place.map(|place| (place.at, place.normal)).unwrap()).collect()
}

#[test]
fn a_plane_keeps_every_distance() {
    let surface = mat_on("on.plane = { at = [1, 2, 3], normal = [0, 0, 2], down = [0, -1, 0] }").unwrap();
    for (taxel, (at, normal)) in places(&surface).into_iter().enumerate() {
        let (x, y) = ((taxel % 32) as f64 - 15.5, (taxel / 32) as f64 - 31.5);
        assert!(at.abs_diff_eq(DVec3::new(1.0 + x * PITCH, 2.0 - y * PITCH, 3.0), 1e-12), "{taxel}: {at}");
        assert!(normal.abs_diff_eq(DVec3::Z, 1e-12));
    }
}

#[test]
fn turned_by_a_quarter_the_columns_run_down() {
    let surface =
        mat_on("turn = 90\non.plane = { at = [0, 0, 0], normal = [0, 0, 1], down = [0, -1, 0] }").unwrap();
    let step = places(&surface)[1].0 - places(&surface)[0].0;
    assert!(step.abs_diff_eq(DVec3::new(0.0, -PITCH, 0.0), 1e-12), "{step}");
}

#[test]
fn on_a_cylinder_every_taxel_lies_at_its_radius_and_arcs_are_kept() {
    for (radius, turn) in [(0.06, 0.0), (0.25, 30.0), (0.11, 90.0)] {
        let on = format!(
            "turn = {turn}\non.cylinder = {{ at = [0, 0, 0.4], axis = [0, 0, -1], radius = {radius}, facing = [1, 0, 0] }}"
        );
        let all = places(&mat_on(&on).unwrap());
        for (at, normal) in &all {
            assert!((at.truncate().length() - radius).abs() < 1e-12 && normal.z == 0.0);
            assert!(normal.abs_diff_eq((at.truncate() / radius).extend(0.0), 1e-12));
        }
        // Along the surface the neighbours are a pitch apart, whatever the turn.
        for taxel in (0..2047).filter(|taxel| taxel % 32 != 31) {
            let (a, b) = (all[taxel].0, all[taxel + 1].0);
            let angle = a.truncate().angle_to(b.truncate());
            assert!(((angle * radius).hypot(a.z - b.z) - PITCH).abs() < 1e-12);
        }
    }
}

/// The columns run to the right as seen from outside, whatever the surface.
#[test]
fn normals_point_to_whoever_sees_the_panel_as_it_is_drawn() {
    for on in [
        "on.plane = { at = [0, 0, 0], normal = [0, 1, 0], down = [0, 0, -1] }",
        "on.cylinder = { at = [0, 0, 0.4], axis = [0, 0, -1], radius = 0.06, facing = [0, 1, 0] }",
        "on.cone = { at = [0, 0, 0.4], axis = [0, 0, -1], radius = 0.1, facing = [0, 1, 0], angle = 8 }",
        "on.cone = { at = [0, 0, 0.4], axis = [0, 0, -1], radius = 0.1, facing = [0, 1, 0], angle = -8 }",
        "on.grid = { points = [[[1, 0, 1], [0, 0, 1]], [[1, 0, 0], [0, 0, 0]]] }",
    ] {
        let all = places(&mat_on(on).unwrap());
        let (here, right, below) = (32 * 31 + 15, 32 * 31 + 16, 32 * 32 + 15);
        let (right, down) = (all[right].0 - all[here].0, all[below].0 - all[here].0);
        let normal = down.cross(right).normalize();
        assert!(normal.dot(all[here].1) > 0.99 && normal.y > 0.9, "{on}: {normal} {}", all[here].1);
    }
}

#[test]
fn on_a_cone_every_taxel_lies_on_it_and_distances_are_kept() {
    for angle in [8.0f64, -8.0, 1.0, 20.0] {
        let on = format!(
            "on.cone = {{ at = [0, 0, 0], axis = [0, 0, 1], radius = 0.15, facing = [1, 0, 0], angle = {angle} }}"
        );
        let all = places(&mat_on(&on).unwrap());
        let (sin, cos) = angle.to_radians().sin_cos();
        for (at, normal) in &all {
            let radius = 0.15 - at.z * sin / cos;
            assert!((at.truncate().length() - radius).abs() < 1e-12, "{angle}: {at}");
            assert!((normal.z - sin).abs() < 1e-12 && (normal.length() - 1.0).abs() < 1e-12);
        }
        // Chords of a pitch's arc; less by no more than a straight line through the bend.
        for taxel in (0..2047).filter(|taxel| taxel % 32 != 31) {
            for next in [taxel + 1, taxel + 32].into_iter().filter(|next| *next < 2048) {
                let share = all[taxel].0.distance(all[next].0) / PITCH;
                assert!((0.99..=1.0 + 1e-9).contains(&share), "{angle}, {taxel}: {share}");
            }
        }
    }
}

#[test]
fn what_does_not_fit_is_reported_with_its_key() {
    let why = |on: &str| mat_on(on).unwrap_err();
    let cone =
        why("on.cone = { at = [0, 0, 0], axis = [0, 0, 1], radius = 0.05, facing = [1, 0, 0], angle = 20 }");
    assert_eq!(cone, "`patches[0].on` does not hold the whole panel: row 38, column 0 has no place");
    let narrow = why("on.cylinder = { at = [0, 0, 0], axis = [0, 0, 1], radius = 0.02, facing = [1, 0, 0] }");
    assert!(narrow.starts_with("`patches[0].on` does not hold the whole panel"), "{narrow}");
    let along = why("on.cylinder = { at = [0, 0, 0], axis = [0, 0, 1], radius = 0.1, facing = [0, 0, 1] }");
    assert_eq!(along, "`patches[0].on.facing` must be a direction across `axis`");
    let thin = why("on.cylinder = { at = [0, 0, 0], axis = [0, 0, 1], radius = 0, facing = [0, 1, 0] }");
    assert_eq!(thin, "`patches[0].on.radius` must be above 0");
    let ragged = why("on.grid = { points = [[[1, 0, 1], [0, 0, 1]], [[1, 0, 0]]] }");
    assert!(ragged.starts_with("`patches[0].on.points` must be at least two rows"), "{ragged}");
    let turned = why("turn = 90\non.grid = { points = [[[1, 0, 1], [0, 0, 1]], [[1, 0, 0], [0, 0, 0]]] }");
    assert_eq!(turned, "`patches[0].turn` must be left out: the points say how the panel lies");
    let twice = why(
        "on.plane = { at = [0, 0, 0], normal = [0, 0, 1], down = [0, 1, 0] }\n\n[[patches]]\npanel = \"mat\"\non.plane = { at = [0, 0, 0], normal = [0, 0, 1], down = [0, 1, 0] }",
    );
    assert_eq!(twice, "`patches[1].panel` lies somewhere else already");
    let body = Body {
        patches: vec![toml::from_str("panel = \"chest\"\non.taxels = \"x\"").unwrap()],
        ..Body::default()
    };
    let garment = Garment::mat();
    let other = Surface::build(&body, &garment, &layout(&garment)).unwrap_err().to_string();
    assert_eq!(other, "`patches[0].panel` must be a panel of the garment: mat");
}

/// Measured points of a sphere, 9 x 9 for 64 x 32 taxels.
#[test]
fn a_grid_of_measured_points_follows_a_sphere() {
    let radius = 0.5;
    let point = |row: usize, column: usize| {
        let (a, b) = ((column as f64 / 8.0 - 0.5) * 0.62, (row as f64 / 8.0 - 0.5) * 1.26);
        DVec3::new(b.cos() * a.sin(), -b.sin(), b.cos() * a.cos()) * radius
    };
    let rows = (0..9).map(|row| {
        let points: Vec<String> =
            (0..9).map(|column| format!("{:?}", point(row, column).to_array())).collect();
        format!("[{}]", points.join(","))
    });
    let rows: Vec<String> = rows.collect();
    let all = places(&mat_on(&format!("on.grid = {{ points = [{}] }}", rows.join(","))).unwrap());
    let mut off: Vec<f64> = all.iter().map(|(at, _)| (at.length() - radius).abs() / PITCH).collect();
    off.sort_by(f64::total_cmp);
    let leaning = all.iter().map(|(at, normal)| at.normalize().angle_between(*normal)).fold(0.0, f64::max);
    println!(
        "a sphere of 0.5 m: median {:.4}, most {:.4} pitch; normals within {leaning:.4} rad",
        off[1024], off[2047]
    );
    assert!(off[1024] < 0.02 && off[2047] < 0.2 && leaning < 0.1);
}

#[test]
fn a_pressure_from_all_sides_is_no_force() {
    // 32 taxels of 10 mm close a cylinder of 32 cm around.
    let radius = 0.32 / std::f64::consts::TAU;
    let on = format!(
        "on.cylinder = {{ at = [0.1, 0, 0], axis = [0, 0, 1], radius = {radius}, facing = [1, 0, 0] }}"
    );
    let wrench = wrenches(&mat_on(&on).unwrap(), &[0.5; 2048])[0];
    assert!(wrench.force.length() < 1e-9 && wrench.moment.length() < 1e-9, "{wrench:?}");
    assert!(wrench.center.abs_diff_eq(DVec3::new(0.1, 0.0, 0.0), 1e-12) && wrench.pressed == 1024.0);
}

/// A single force: its moment is that of its place.
#[test]
fn the_moment_is_that_of_the_place() {
    let surface =
        mat_on("on.plane = { at = [0.3, 0.2, 0.1], normal = [0, 0, 1], down = [0, -1, 0] }").unwrap();
    let mut newtons = [0.0; 2048];
    newtons[77] = 3.0;
    let wrench = wrenches(&surface, &newtons)[0];
    let at = surface.places()[77].unwrap().at;
    assert_eq!((wrench.force, wrench.pressed), (DVec3::new(0.0, 0.0, -3.0), 3.0));
    assert!(wrench.center.abs_diff_eq(at, 1e-15) && wrench.moment.abs_diff_eq(at.cross(wrench.force), 1e-15));
}

#[test]
fn a_centroid_lies_between_its_taxels() {
    let garment = Garment::mat();
    let surface =
        mat_on("on.cylinder = { at = [0, 0, 0.4], axis = [0, 0, -1], radius = 0.06, facing = [1, 0, 0] }")
            .unwrap();
    let layout = layout(&garment);
    let place = surface.at(&layout, 0, 3.25, 7.5).unwrap();
    let angle = (3.25 - 15.5) * PITCH / 0.06;
    let exact = DVec3::new(0.06 * angle.cos(), 0.06 * angle.sin(), 0.4 - (7.5 - 31.5) * PITCH);
    // The chord is within the arc.
    assert!(place.at.distance(exact) < 0.03 * PITCH, "{} {exact}", place.at);
    assert_eq!(surface.at(&layout, 0, 31.9, 63.9).unwrap().at, surface.places()[2047].unwrap().at);
    assert_eq!(surface.at(&layout, 1, 0.0, 0.0), None);
}

#[test]
fn lists_are_read_as_they_are_written() {
    let text = "# comment\n0.1 0.2 0.3 0 0 1\n\n0,0,0,0,0,0\n";
    let list = listed("a.txt", text).unwrap();
    assert_eq!(list, [Some((DVec3::new(0.1, 0.2, 0.3), DVec3::Z)), None]);
    let icub = "name left_forearm\nspec x y\n\n[calibration]\n0 0 0 0 0 0\n0.1 0 0 1.001 0 0\n[other]\nx\n";
    assert_eq!(listed("f", icub).unwrap(), [None, Some((DVec3::new(0.1, 0.0, 0.0), DVec3::X))]);
    let why = |text: &str| listed("f", text).unwrap_err().to_string();
    assert_eq!(why("0 0 0\n"), "f, line 1: not six numbers: x y z nx ny nz: \"0 0 0\"");
    assert_eq!(why("\n0 0 1 0 0 2\n"), "f, line 2: the normal must have a length of 1: \"0 0 1 0 0 2\"");
    assert_eq!(why("0 0 a 0 0 2\n"), "f, line 1: not numbers: \"0 0 a 0 0 2\"");
    assert_eq!(why("0 0 nan 0 0 1\n"), "f, line 1: not finite: \"0 0 nan 0 0 1\"");
}

/// The reference body: no panel stretches or lies on another, and the trunk's panels meet at both flanks.
#[test]
fn the_reference_garment_lies_on_its_robot() {
    let garment = Garment::reference();
    let layout = layout(&garment);
    let surface = body::read("reference").unwrap().surface(&garment, &layout).unwrap();
    assert_eq!(surface.links(), ["torso", "left_upper_arm", "right_upper_arm"]);
    for fit in surface.fits(&layout) {
        let pitch = fit.pitch.unwrap();
        assert!(fit.taxels == 512 && *pitch.start() > 0.99 && *pitch.end() < 1.000_001, "{pitch:?}");
    }
    assert_eq!(surface.overlap(&layout), None);
    let at = |taxel: usize| surface.places()[taxel].unwrap().at;
    for row in 0..32 {
        let [chest, back] = [row * 16, 512 + row * 16];
        for (left, right) in [(chest + 15, back), (back + 15, chest)] {
            assert!((at(left).distance(at(right)) / 0.012 - 0.998).abs() < 0.002, "row {row}");
        }
    }
}

#[test]
fn panels_that_lie_on_each_other_are_reported() {
    let text = "[[patches]]\npanel = \"chest\"\non.plane = { at = [0, 0, 0], normal = [1, 0, 0], down = [0, 0, -1] }\n";
    let both = text.to_string() + &text.replace("chest", "back").replace("0, 0, 0]", "0, 0.1, 0]");
    let garment = Garment::reference();
    let layout = layout(&garment);
    let surface = |text: &str| Surface::build(&toml::from_str(text).unwrap(), &garment, &layout).unwrap();
    assert_eq!(surface(&both).overlap(&layout), Some(("chest", "back")));
    assert_eq!(surface(&both.replace("0, 0.1, 0]", "0, 0.2, 0]")).overlap(&layout), None);
}

#[test]
fn errors_of_files_name_file_line_and_key() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("body-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_string()
    };
    let garment = Garment::mat();
    let why = |name: &str| {
        let surface = body::read(name).and_then(|read| read.surface(&garment, &layout(&garment)));
        format!("{:#}", surface.unwrap_err()).replace(folder.to_str().unwrap(), "")
    };
    let thin = "# mine\n[[patches]]\npanel = \"mat\"\n[patches.on.cylinder]\nat = [0, 0, 0]\naxis = [0, 0, 1]\nradius = -1\nfacing = [1, 0, 0]\n";
    assert_eq!(why(&file("a.toml", thin)), "/a.toml, line 4, `patches[0].on.radius`: must be above 0");
    let unknown = why(&file("b.toml", "[[patches]]\npanel = \"mat\"\non.sphere = 3\n"));
    assert!(unknown.starts_with("/b.toml, line 3: ") && unknown.contains("sphere"), "{unknown}");
    file("two.txt", "0 0 0.1 0 0 1\n0 0 0.2 0 0 1\n");
    let few = why(&file("c.toml", "[[patches]]\npanel = \"mat\"\non.taxels = \"two.txt\"\n"));
    assert_eq!(few, "/c.toml, line 3, `patches[0].on.taxels`: lists 2 taxels, and the panel has 2048");
    file("bad.txt", "0 0 0.1 0 0\n");
    let bad = why(&file("d.toml", "[[patches]]\npanel = \"mat\"\non.taxels = \"bad.txt\"\n"));
    assert_eq!(bad, "/bad.txt, line 1: not six numbers: x y z nx ny nz: \"0 0 0.1 0 0\"");
    let none = why(&file("e.toml", "# mine\n[[patches]]\npanel = \"mat\"\non.taxels = \"none.txt\"\n"));
    assert!(none.starts_with("/e.toml, line 4, `patches[0].on.taxels`: cannot read /none.txt: "), "{none}");
    assert!(why("nothing").starts_with("there is no body \"nothing\""));
    std::fs::remove_dir_all(&folder).unwrap();
}
