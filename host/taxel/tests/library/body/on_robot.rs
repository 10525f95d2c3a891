//! A garment on a robot: places and wrenches in any frame, links that do not exist.

use glam::DQuat;
use proptest::prelude::*;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;
use taxel::body::posture::Estimate;
use taxel::body::robot::{self, Robot};
use taxel::body::{self, Body, DVec3, RobotSurface, Surface, wrenches};
use taxel_core::garment::{Garment, Layout};

fn layout(garment: &Garment) -> Layout {
    Layout::build(garment, 2048, 4095).unwrap()
}

fn reference() -> (Arc<Robot>, RobotSurface) {
    let robot = Arc::new(robot::read("reference").unwrap());
    let garment = Garment::reference();
    let on_robot =
        body::read("reference").unwrap().on_robot(&garment, &layout(&garment), robot.clone()).unwrap();
    (robot, on_robot)
}

const POSTURES: [&str; 3] = [
    "",
    "waist=40deg,left_shoulder_pitch=70deg,left_shoulder_roll=30deg",
    "right_shoulder_yaw=-60deg,right_shoulder_roll=100deg,waist=-50deg,left_elbow=90deg",
];

/// The moment about the other frame's origin is that of the moved taxels, one by one; what a force does is
/// the same in all frames.
#[test]
fn a_wrench_is_that_of_the_moved_taxels() {
    let (robot, on_robot) = reference();
    let newtons: Vec<f64> = (0..2048u32).map(|taxel| f64::from(taxel * 7919 % 13) / 4.0).collect();
    for posture in POSTURES {
        let posture = robot.posture_of(posture).unwrap();
        let poses = robot.poses(&posture);
        for frame in 0..robot.links().len() {
            let moved = wrenches(&on_robot.seen_from(&posture, frame).unwrap(), &newtons);
            let by_link = on_robot.poses(&poses, frame).unwrap();
            for own in wrenches(on_robot.surface(), &newtons) {
                let (seen, exact) = (own.seen_from(&by_link[own.link]), moved[own.link]);
                assert!(seen.force.abs_diff_eq(exact.force, 1e-9), "{seen:?} {exact:?}");
                assert!(seen.moment.abs_diff_eq(exact.moment, 1e-9) && seen.pressed == exact.pressed);
                assert!(seen.center.abs_diff_eq(exact.center, 1e-12));
            }
        }
        let error = on_robot.seen_from(&posture, 99).unwrap_err().to_string();
        assert_eq!(error, "reference: there is no link of number 99");
    }
    let nothing = wrenches(on_robot.surface(), &[])[0];
    let poses = robot.poses(&robot.rest());
    let seen = nothing.seen_from(&poses.of(robot.link("left_upper_arm").unwrap(), 0).unwrap());
    assert_eq!((seen.center, seen.force), (DVec3::ZERO, DVec3::ZERO));
}

/// A contact between taxels is seen where the surface, once moved, has it.
#[test]
fn contacts_move_with_their_link() {
    let (robot, on_robot) = reference();
    let layout = layout(&Garment::reference());
    let posture = robot.posture_of(POSTURES[1]).unwrap();
    let poses = robot.poses(&posture);
    let (hand, by_link) = (robot.link("right_hand").unwrap(), |frame| on_robot.poses(&poses, frame).unwrap());
    for frame in [0, hand] {
        let moved = on_robot.seen_from(&posture, frame).unwrap();
        for panel in 0..4 {
            let place = on_robot.surface().at(&layout, panel, 3.4, 20.7).unwrap();
            let seen = place.seen_from(&by_link(frame)[place.link]);
            let exact = moved.at(&layout, panel, 3.4, 20.7).unwrap();
            assert!(seen.at.abs_diff_eq(exact.at, 1e-12) && seen.normal.abs_diff_eq(exact.normal, 1e-12));
            assert_eq!(seen.link, exact.link);
        }
    }
}

/// Of the joints those alone that carry patches: the waist and the shoulders, in the base.
#[test]
fn joints_that_move_the_garment_are_known() {
    let (robot, on_robot) = reference();
    let names = |free: Vec<usize>| {
        let name = |free: &usize| robot.joints()[robot.free()[*free]].name.clone();
        free.iter().map(name).collect::<Vec<_>>().join(" ")
    };
    let shoulders = ["left", "right"]
        .map(|side| ["pitch", "roll", "yaw"].map(|way| format!("{side}_shoulder_{way}")).join(" "));
    assert_eq!(names(on_robot.moving(0)), format!("waist {}", shoulders.join(" ")));
    let torso = robot.link("torso").unwrap();
    assert_eq!(names(on_robot.moving(torso)), shoulders.join(" "));
    let forearm = robot.link("right_forearm").unwrap();
    assert_eq!(names(on_robot.moving(forearm)), shoulders.join(" ") + " right_elbow");
}

#[test]
fn a_link_that_the_robot_lacks_is_reported_with_file_line_and_key() {
    let robot = |text: &str| Arc::new(robot::parse("r.urdf", text).unwrap());
    let garment = Garment::reference();
    let why = |name: &str, urdf: &str| {
        let read = body::read(name).unwrap();
        format!("{:#}", read.on_robot(&garment, &layout(&garment), robot(urdf)).unwrap_err())
    };
    // The link is the garment's own: the panel is named.
    assert_eq!(
        why("reference", "<robot><link name=\"trso\"/></robot>"),
        "reference, line 6, `patches[0].panel`: r.urdf: there is no link \"torso\": did you mean \"trso\"? Known are trso"
    );
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("on-robot-{}.toml", std::process::id()));
    let text = "[[patches]]\npanel = \"chest\"\non.plane = { at = [0, 0, 0], normal = [1, 0, 0], down = [0, 0, -1] }\n\n\
                [[patches]]\npanel = \"back\"\nlink = \"trunk\"\non.plane = { at = [0, 0, 0], normal = [-1, 0, 0], down = [0, 0, -1] }\n";
    std::fs::write(&path, text).unwrap();
    let said = why(path.to_str().unwrap(), "<robot><link name=\"torso\"/></robot>");
    let file = path.display();
    assert_eq!(
        said,
        format!("{file}, line 7, `patches[1].link`: r.urdf: there is no link \"trunk\"; known are torso")
    );
    std::fs::remove_file(&path).unwrap();
    let body = body::read("reference").unwrap().body;
    let error =
        RobotSurface::build(&body, &garment, &layout(&garment), robot("<robot><link name=\"a\"/></robot>"));
    let text = "`patches[0].panel` r.urdf: there is no link \"torso\"; known are a";
    assert_eq!(error.unwrap_err().to_string(), text);
}

/// The reference body, with slides at its patches: the left arm's is the third.
fn sliding(slides: [&str; 4]) -> Result<RobotSurface, taxel::Error> {
    let mut body = body::read("reference").unwrap().body;
    for (patch, slides) in body.patches.iter_mut().zip(slides) {
        let Body { patches, .. } =
            toml::from_str(&format!("[[patches]]\npanel = \"x\"\nslides = [{slides}]\non.taxels = \"none\""))
                .unwrap();
        patch.slides = patches.into_iter().next().unwrap().slides;
    }
    let garment = Garment::reference();
    RobotSurface::build(&body, &garment, &layout(&garment), Arc::new(robot::read("reference").unwrap()))
}

/// On a cylinder, cloth that slides to the right turns about its axis, by the arc; on a cone it stays on the
/// cone, and nothing stretches.
#[test]
fn cloth_slides_over_its_surface_with_the_joint() {
    let on_robot = sliding([
        "{ joint = \"waist\", right = 0.02, down = -0.01 }",
        "",
        "{ joint = \"left_elbow\", down = 0.01 }",
        "",
    ]);
    let on_robot = on_robot.unwrap();
    let robot = on_robot.robot();
    let posture = robot.posture_of("waist=0.5rad,left_elbow=2rad").unwrap();
    let (slid, still) = (on_robot.slid(&posture).unwrap(), on_robot.surface());
    let of = |surface: &Surface, taxel: usize| surface.places()[taxel].unwrap();
    let turn = DQuat::from_rotation_z(0.01 / 0.06112);
    for taxel in 0..512 {
        let (slid, still) = (of(&slid, taxel), of(still, taxel));
        let exact = turn * still.at + DVec3::Z * 0.005;
        assert!(slid.at.abs_diff_eq(exact, 1e-12) && slid.normal.abs_diff_eq(turn * still.normal, 1e-12));
    }
    assert_eq!(slid.places()[512..1024], still.places()[512..1024]);
    assert_eq!(slid.places()[1536..], still.places()[1536..]);
    let (sin, cos) = 1.5f64.to_radians().sin_cos();
    for taxel in 1024..1536 {
        let (slid, still) = (of(&slid, taxel), of(still, taxel));
        let radius = 0.04 + (slid.at.z + 0.16) * sin / cos;
        assert!((slid.at.truncate().length() - radius).abs() < 1e-12, "{}", slid.at);
        let way = slid.at.distance(still.at);
        assert!(way < 0.02 + 1e-12 && way > 0.0199 && slid.at.z < still.at.z, "{way}");
    }
    assert_eq!(*on_robot.slid(&robot.rest()).unwrap(), *still);
    // In its own frame the chest is off by its way over the skin alone.
    let mut errors = vec![0.0; 9];
    errors[0] = 0.1;
    let estimate = Estimate { posture: robot.rest(), errors, age: Duration::ZERO };
    let off = sliding(["{ joint = \"waist\", right = 0.03, down = 0.04 }", "", "", ""])
        .unwrap()
        .displacement(&estimate, 1);
    assert!((off - 0.005).abs() < 1e-15, "{off}");
    // In the base the whole is moved once more; of the joints, the elbow is needed now.
    let turn = DQuat::from_rotation_z(0.5);
    let seen = on_robot.seen_from(&posture, 0).unwrap();
    assert!(of(&seen, 7).at.abs_diff_eq(turn * of(&slid, 7).at, 1e-12));
    assert_eq!(on_robot.moving(0), [0, 1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(on_robot.moving(robot.link("left_upper_arm").unwrap()), [0, 1, 2, 3, 4, 5, 6, 7]);
}

#[test]
fn slides_that_cannot_be_are_reported() {
    let why = |slides: &str| sliding(["", "", slides, ""]).unwrap_err().to_string();
    assert!(
        why("{ joint = \"left_elbov\" }").starts_with(
            "`patches[2].slides[0].joint` reference: there is no joint \"left_elbov\": did you mean \"left_elbow\"?"
        )
    );
    assert_eq!(why("{ joint = \"left_wrist\" }"), "`patches[2].slides[0].joint` must be a joint that moves");
    assert_eq!(
        why("{ joint = \"waist\" }, { joint = \"left_elbow\", down = inf }"),
        "`patches[2].slides[1].down` must be a number"
    );
    // The apex of the sleeve's cone is 1.528 m below its middle, and the way 1.56 m at 2.6 rad.
    assert_eq!(
        why("{ joint = \"left_elbow\", down = 0.6 }"),
        "`patches[2].slides` move the panel off its surface: `patches[2].on` does not hold the whole panel: row 13, column 0 has no place"
    );
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("slides-{}.toml", std::process::id()));
    let text = "[[patches]]\npanel = \"chest\"\non.plane = { at = [0, 0, 0], normal = [1, 0, 0], down = [0, 0, -1] }\n\
                slides = [\n  { joint = \"neck\", down = 1 },\n]\n";
    std::fs::write(&path, text).unwrap();
    let garment = Garment::reference();
    let robot = Arc::new(robot::read("reference").unwrap());
    let error =
        body::read(path.to_str().unwrap()).unwrap().on_robot(&garment, &layout(&garment), robot).unwrap_err();
    let start = format!(
        "{}, line 5, `patches[0].slides[0].joint`: reference: there is no joint \"neck\"",
        path.display()
    );
    assert!(error.to_string().starts_with(&start), "{error}");
    std::fs::remove_file(&path).unwrap();
    let grid = "[[patches]]\npanel = \"chest\"\nslides = [{ joint = \"waist\" }]\non.grid = { points = [[[0, 1, 1], [0, 0, 1]], [[0, 1, 0], [0, 0, 0]]] }\n";
    let grid = Surface::build(&toml::from_str(grid).unwrap(), &garment, &layout(&garment)).unwrap_err();
    assert_eq!(grid.to_string(), "`patches[0].slides` must be left out: the points say where the panel lies");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(40) })]

    /// Whatever the joints are off by, no taxel is off by more than the bound, slides and all.
    #[test]
    fn no_taxel_is_off_by_more_than_the_bound(
        shares in prop::collection::vec(0.0..1.0f64, 9),
        offs in prop::collection::vec(-1.0..=1.0f64, 9),
        size in prop::sample::select(vec![1e-3, 0.03, 0.3]),
        frame in 0usize..12,
    ) {
        let on_robot = sliding([
            "{ joint = \"waist\", right = 0.03, down = -0.01 }",
            "",
            "{ joint = \"left_elbow\", down = 0.02, right = 0.01 }, { joint = \"left_shoulder_yaw\", right = 0.02 }",
            "",
        ]);
        let on_robot = on_robot.unwrap();
        let robot = on_robot.robot();
        let at = |(free, share): (&usize, &f64)| {
            let limits = robot.joints()[*free].limits.clone().unwrap();
            limits.start() + (limits.end() - limits.start()) * share
        };
        let posture: Vec<f64> = robot.free().iter().zip(&shares).map(at).collect();
        let truth: Vec<f64> = posture.iter().zip(&offs).map(|(position, off)| position + off * size).collect();
        let estimate = Estimate { posture, errors: vec![size; 9], age: Duration::ZERO };
        let bound = on_robot.displacement(&estimate, frame);
        let [seen, exact] = [&estimate.posture, &truth].map(|posture| on_robot.seen_from(posture, frame).unwrap());
        for (seen, exact) in seen.places().iter().flatten().zip(exact.places().iter().flatten()) {
            let off = seen.at.distance(exact.at);
            prop_assert!(off <= bound + 1e-12, "{off} > {bound}");
        }
    }
}
