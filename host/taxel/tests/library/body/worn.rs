//! A garment on a robot: places and wrenches in any frame, links that do not exist.

use std::path::Path;
use std::sync::Arc;
use taxel::body::robot::{self, Robot};
use taxel::body::{self, DVec3, RobotSurface, wrenches};
use taxel_core::garment::{Garment, Layout};

fn layout(garment: &Garment) -> Layout {
    Layout::build(garment, 2048, 4095).unwrap()
}

fn reference() -> (Arc<Robot>, RobotSurface) {
    let robot = Arc::new(robot::read("reference").unwrap());
    let garment = Garment::reference();
    let worn = body::read("reference").unwrap().on_robot(&garment, &layout(&garment), robot.clone()).unwrap();
    (robot, worn)
}

const POSTURES: [&str; 3] = [
    "",
    "waist=40deg,left_shoulder_pitch=70deg,left_shoulder_roll=30deg",
    "right_shoulder_yaw=-60deg,right_shoulder_roll=100deg,waist=-50deg,left_elbow=90deg",
];

/// The moment about the other frame's origin is that of the moved taxels, one by one; what a force does is the
/// same in all frames.
#[test]
fn a_wrench_is_that_of_the_moved_taxels() {
    let (robot, worn) = reference();
    let newtons: Vec<f64> = (0..2048u32).map(|taxel| f64::from(taxel * 7919 % 13) / 4.0).collect();
    for posture in POSTURES {
        let poses = robot.poses(&robot.posture_of(posture).unwrap());
        for frame in 0..robot.links().len() {
            let moved = wrenches(&worn.seen_from(&poses, frame).unwrap(), &newtons);
            let by_link = worn.poses(&poses, frame).unwrap();
            for own in wrenches(worn.surface(), &newtons) {
                let (seen, exact) = (own.seen_from(&by_link[own.link]), moved[own.link]);
                assert!(seen.force.abs_diff_eq(exact.force, 1e-9), "{seen:?} {exact:?}");
                assert!(seen.moment.abs_diff_eq(exact.moment, 1e-9) && seen.pressed == exact.pressed);
                assert!(seen.center.abs_diff_eq(exact.center, 1e-12));
            }
        }
        assert!(worn.seen_from(&poses, 99).is_none());
    }
    let nothing = wrenches(worn.surface(), &[])[0];
    let poses = robot.poses(&robot.rest());
    let seen = nothing.seen_from(&poses.of(robot.link("left_upper_arm").unwrap(), 0).unwrap());
    assert_eq!((seen.center, seen.force), (DVec3::ZERO, DVec3::ZERO));
}

/// A contact between taxels is seen where the surface, once moved, has it.
#[test]
fn contacts_move_with_their_link() {
    let (robot, worn) = reference();
    let layout = layout(&Garment::reference());
    let poses = robot.poses(&robot.posture_of(POSTURES[1]).unwrap());
    let (hand, by_link) = (robot.link("right_hand").unwrap(), |frame| worn.poses(&poses, frame).unwrap());
    for frame in [0, hand] {
        let moved = worn.seen_from(&poses, frame).unwrap();
        for panel in 0..4 {
            let place = worn.surface().at(&layout, panel, 3.4, 20.7).unwrap();
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
    let (robot, worn) = reference();
    let names = |free: Vec<usize>| {
        let name = |free: &usize| robot.joints()[robot.free()[*free]].name.clone();
        free.iter().map(name).collect::<Vec<_>>().join(" ")
    };
    let shoulders = ["left", "right"]
        .map(|side| ["pitch", "roll", "yaw"].map(|way| format!("{side}_shoulder_{way}")).join(" "));
    assert_eq!(names(worn.moving(0)), format!("waist {}", shoulders.join(" ")));
    let torso = robot.link("torso").unwrap();
    assert_eq!(names(worn.moving(torso)), shoulders.join(" "));
    let forearm = robot.link("right_forearm").unwrap();
    assert_eq!(names(worn.moving(forearm)), shoulders.join(" ") + " right_elbow");
}

#[test]
fn a_link_that_the_robot_lacks_is_told_with_file_line_and_key() {
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
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("worn-{}.toml", std::process::id()));
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
    let surface = body::read("reference").unwrap().surface(&garment, &layout(&garment)).unwrap();
    let error = RobotSurface::new(surface, robot("<robot><link name=\"a\"/></robot>")).unwrap_err();
    assert_eq!(error.to_string(), "r.urdf: there is no link \"torso\"; known are a");
}
