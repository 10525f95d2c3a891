//! URDF files: what is read, what is refused, and with which sentence; nothing panics.

use super::rig::{rigs, urdf};
use proptest::prelude::*;
use taxel::body::robot::{parse, read};
use taxel::error::{ErrorKind, FileError, RobotError, UsageError};

const REFERENCE: &str = include_str!("../../../bodies/reference.urdf");

/// Two links and a joint, whose parts are put in by the test.
fn arm(joint: &str) -> String {
    format!("<robot name=\"arm\">\n<link name=\"a\"/>\n<link name=\"b\"/>\n{joint}\n</robot>\n")
}

/// A joint from `a` to `b` with these elements.
fn elbow(kind: &str, elements: &str) -> String {
    arm(&format!(
        "<joint name=\"elbow\" type=\"{kind}\"><parent link=\"a\"/><child link=\"b\"/>\n{elements}</joint>"
    ))
}

fn why(text: &str) -> String {
    parse("r.urdf", text).unwrap_err().to_string()
}

#[test]
fn the_reference_robot_has_the_links_of_its_body() {
    let robot = read("reference").unwrap();
    for link in ["base_link", "torso", "left_upper_arm", "left_forearm", "left_hand", "right_upper_arm"] {
        assert!(robot.link(link).is_ok(), "{link}");
    }
    assert_eq!((robot.links().len(), robot.joints().len(), robot.free().len()), (12, 11, 9));
    assert_eq!(robot.rest(), [0.0; 9]);
    // An elbow bends the forearm forward, on both sides; arms lift away from the body.
    for (side, left) in [("left", 1.0), ("right", -1.0)] {
        let hand = |posture: &str| {
            let posture = robot.posture_of(posture).unwrap();
            let [hand, torso] =
                [format!("{side}_hand"), "torso".into()].map(|name| robot.link(&name).unwrap());
            robot.poses(&posture).of(hand, torso).unwrap().at
        };
        assert!(hand("").abs_diff_eq([0.0, left * 0.12, -0.24].into(), 1e-12));
        let bent = hand(&format!("{side}_elbow=90deg,waist=20deg"));
        assert!(bent.abs_diff_eq([0.26, left * 0.12, 0.02].into(), 1e-12), "{bent}");
        let lifted = hand(&format!("{side}_shoulder_roll=90deg"));
        assert!(lifted.abs_diff_eq([0.0, left * 0.72, 0.36].into(), 1e-12), "{lifted}");
        let forward = hand(&format!("{side}_shoulder_pitch=90deg"));
        assert!(forward.abs_diff_eq([0.6, left * 0.12, 0.36].into(), 1e-12), "{forward}");
    }
}

#[test]
fn what_is_no_urdf_is_reported_with_its_line() {
    for (text, sentence) in [
        ("", "r.urdf, line 1: not XML: the document does not have a root node"),
        ("\n\nhello", "r.urdf, line 3: not XML: unknown token"),
        (
            "<robot>\n<link name=\"a\"/>\n",
            "r.urdf, line 2: not XML: the root node was opened but never closed",
        ),
        ("<robot>\n<link name=\"a\">\n</robot>", "r.urdf, line 3: not XML: expected 'link' tag, not 'robot'"),
        ("<?xml version=\"1.0\"?>\n<sdf/>", "r.urdf, line 2: not a URDF: its root is <sdf>, not <robot>"),
        ("<robot name=\"r\"/>", "r.urdf: has no links"),
        ("<robot>\n<link/></robot>", "r.urdf, line 2: a <link> without a name"),
        ("<robot>\n<joint type=\"fixed\"/></robot>", "r.urdf, line 2: a <joint> without a name"),
        (
            "<robot xmlns:xacro=\"http://wiki.ros.org/xacro\">\n<link name=\"a\"/>\n<xacro:arm/></robot>",
            "r.urdf, line 3: this is xacro: expand it to a URDF first",
        ),
        ("<!DOCTYPE a [<!ENTITY b \"c\">]><robot/>", "r.urdf, line 1: not XML: XML with DTD detected"),
    ] {
        let error = parse("r.urdf", text).unwrap_err();
        assert_eq!(error.to_string(), sentence);
        assert!(matches!(error, RobotError::NotUrdf(_)));
    }
}

#[test]
fn a_joint_that_is_wrong_is_reported_with_its_name_and_line() {
    let of = |what: &str| format!("r.urdf, line {what}");
    let limit = "<limit lower=\"0\" upper=\"1\"/>";
    for (text, sentence) in [
        (elbow("revolute", ""), "4, joint \"elbow\": lacks <limit>"),
        (elbow("prismatic", ""), "4, joint \"elbow\": lacks <limit>"),
        (
            elbow("revolute", "<limit lower=\"1\" upper=\"0.5\"/>"),
            "5, joint \"elbow\": `lower` of <limit> is above `upper`: 1 and 0.5",
        ),
        (
            elbow("revolute", "<limit lower=\"nan\"/>"),
            "5, joint \"elbow\": `lower` of <limit> must be a number, not \"nan\"",
        ),
        (
            elbow("continuous", "<limit velocity=\"fast\"/>"),
            "5, joint \"elbow\": `velocity` of <limit> must be a number, not \"fast\"",
        ),
        (
            elbow("fixed", "\n<origin xyz=\"0 1\"/>"),
            "6, joint \"elbow\": `xyz` of <origin> must be three numbers, not \"0 1\"",
        ),
        (
            elbow("fixed", "<origin rpy=\"0 1 inf\"/>"),
            "5, joint \"elbow\": `rpy` of <origin> must be three numbers, not \"0 1 inf\"",
        ),
        (
            elbow("fixed", "<origin quat_xyzw=\"0 0 0 1\"/>"),
            "5, joint \"elbow\": `quat_xyzw` of <origin> is not read, only xyz and rpy",
        ),
        (elbow("fixed", "<origin/>\n<origin/>"), "6, joint \"elbow\": a second <origin>"),
        (
            elbow("continuous", "<axis xyz=\"0 0 0\"/>"),
            "5, joint \"elbow\": `xyz` of <axis> must be a direction",
        ),
        (
            elbow("floating", ""),
            "4, joint \"elbow\": joints that are floating are not supported, only revolute, continuous, prismatic, fixed",
        ),
        (
            elbow("planar", ""),
            "4, joint \"elbow\": joints that are planar are not supported, only revolute, continuous, prismatic, fixed",
        ),
        (
            elbow("revolut", limit),
            "4, joint \"elbow\": there is no type of joint \"revolut\": did you mean \"revolute\"? Known are revolute, continuous, prismatic, fixed",
        ),
        (arm("<joint name=\"elbow\"/>"), "4, joint \"elbow\": <joint> lacks `type`"),
        (arm("<joint name=\"elbow\" type=\"fixed\"/>"), "4, joint \"elbow\": lacks <parent>"),
        (
            arm("<joint name=\"elbow\" type=\"fixed\"><parent link=\"a\"/></joint>"),
            "4, joint \"elbow\": lacks <child>",
        ),
        (
            arm("<joint name=\"elbow\" type=\"fixed\"><parent link=\"a\"/>\n<child/></joint>"),
            "5, joint \"elbow\": <child> lacks `link`",
        ),
        (elbow("continuous", "<mimic/>"), "5, joint \"elbow\": <mimic> lacks `joint`"),
        (
            elbow("continuous", "<mimic joint=\"elbow\"/>"),
            "4, joint \"elbow\": mimics itself, by way of others or at once",
        ),
        (
            elbow("continuous", "<mimic joint=\"elbov\"/>"),
            "4, joint \"elbow\": mimics a joint that the file lacks: there is no joint \"elbov\": did you mean \"elbow\"? Known are elbow",
        ),
    ] {
        assert_eq!(why(&text), of(sentence));
        let error = parse("r.urdf", &text).unwrap_err();
        assert!(matches!(error, RobotError::Joint { joint, .. } if joint == "elbow"));
    }
}

#[test]
fn links_that_are_no_tree_are_reported() {
    let joint = |name: &str, parent: &str, child: &str| {
        format!(
            "<joint name=\"{name}\" type=\"fixed\"><parent link=\"{parent}\"/><child link=\"{child}\"/></joint>\n"
        )
    };
    let with = |joints: &[(&str, &str, &str)]| {
        arm(&joints.iter().map(|(name, parent, child)| joint(name, parent, child)).collect::<String>())
    };
    for (text, sentence) in [
        (
            with(&[("j", "a", "bb")]),
            "r.urdf, line 4, joint \"j\": its child \"bb\" is not a link of the file: did you mean \"b\"?",
        ),
        (
            with(&[("j", "elsewhere", "b")]),
            "r.urdf, line 4, joint \"j\": its parent \"elsewhere\" is not a link of the file",
        ),
        (
            with(&[("j", "a", "b"), ("k", "a", "b")]),
            "r.urdf, line 5, joint \"k\": its child \"b\" hangs on the joint \"j\" already (line 4)",
        ),
        (
            with(&[("j", "a", "b"), ("j", "b", "a")]),
            "r.urdf, line 5, joint \"j\": line 4 has a joint of this name, too",
        ),
        (
            with(&[("j", "a", "b"), ("k", "b", "a")]),
            "r.urdf, line 2, link \"a\": joints lead from each link to another, in a circle: none is the root",
        ),
        (with(&[]), "r.urdf, line 3, link \"b\": hangs on no joint, and neither does \"a\" (line 2)"),
        (
            with(&[("j", "b", "b")]),
            "r.urdf, line 3, link \"b\": hangs on a circle of joints, and not on the root \"a\"",
        ),
        (arm("<link name=\"a\"/>"), "r.urdf, line 4, link \"a\": line 2 has a link of this name, too"),
    ] {
        assert_eq!(why(&text), sentence);
    }
    let fixed = with(&[("j", "a", "b")]) + "";
    let led = fixed.replace("</robot>", "<link name=\"c\"/><joint name=\"k\" type=\"continuous\"><parent link=\"b\"/><child link=\"c\"/><mimic joint=\"j\"/></joint></robot>");
    assert_eq!(why(&led), "r.urdf, line 6, joint \"k\": mimics the joint \"j\", which is fixed");
}

/// Elements that say nothing about where links are: joints of transmissions, plugins, names of other spaces.
#[test]
fn what_does_not_matter_is_passed_over() {
    let text = elbow("revolute", "<limit upper=\"1\" velocity=\"0\"/><dynamics damping=\"1\"/>").replace(
        "</robot>",
        "<transmission name=\"t\"><joint name=\"elbow\"/><actuator name=\"m\"/></transmission>\n\
         <gazebo reference=\"a\"><x:y xmlns:x=\"z\"/></gazebo><material name=\"grey\"/><!-- end --></robot>",
    );
    let robot = parse("r.urdf", &("\u{feff}".to_string() + &text)).unwrap();
    assert_eq!((robot.links().len(), robot.joints().len()), (2, 1));
    assert_eq!((robot.joints()[0].limits.clone(), robot.joints()[0].velocity), (Some(0.0..=1.0), None));
}

#[test]
fn files_that_are_missing_or_unknown_are_reported() {
    let error = read("/no/such/arm.urdf").unwrap_err();
    assert!(matches!(error.kind(), ErrorKind::File(FileError::Missing { .. })), "{error:#}");
    let error = read("refrence").unwrap_err();
    assert!(matches!(error.kind(), ErrorKind::Usage(UsageError::Unknown(_))));
    assert_eq!(
        format!("{error:#}"),
        "there is no robot \"refrence\": did you mean \"reference\"? Known are reference, or give a .urdf file"
    );
}

/// A file may be deeper than a stack, and a chain longer.
#[test]
fn depth_is_no_matter() {
    let deep = format!("<robot>{}{}</robot>", "<link name=\"a\">".repeat(50_000), "</link>".repeat(50_000));
    assert_eq!(parse("r.urdf", &deep).unwrap().links().len(), 1);
    let long: String = (0..20_000)
        .map(|n| {
            format!(
                "<link name=\"l{n}\"/><joint name=\"j{n}\" type=\"continuous\"><parent link=\"l{n}\"/>\
                 <child link=\"l{}\"/><origin xyz=\"0.001 0 0\"/><axis xyz=\"0 0 1\"/></joint>",
                n + 1
            )
        })
        .collect();
    let robot = parse("r.urdf", &format!("<robot>{long}<link name=\"l20000\"/></robot>")).unwrap();
    let end = robot.poses(&robot.rest()).of(20_000, 0).unwrap().at;
    assert!((end.x - 20.0).abs() < 1e-6, "{end}");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(600) })]

    /// Bytes that are changed, cut out and doubled: an error or a robot, whose kinematics is of numbers.
    #[test]
    fn nothing_panics(
        rig in rigs(),
        is_reference in any::<bool>(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0usize..40, 0u8..3, any::<u8>()), 0..6),
    ) {
        let mut bytes = if is_reference { REFERENCE.to_string() } else { urdf(&rig) }.into_bytes();
        for (at, length, how, byte) in edits {
            let at = at.index(bytes.len().max(1)).min(bytes.len());
            let end = (at + length).min(bytes.len());
            match how {
                0 => _ = bytes.drain(at..end),
                1 => bytes.splice(at..at, bytes[at..end].to_vec()).for_each(drop),
                _ => bytes.splice(at..end.min(at + 1), [byte]).for_each(drop),
            }
        }
        match parse("r.urdf", &String::from_utf8_lossy(&bytes)) {
            Ok(robot) => {
                let poses = robot.poses(&robot.rest());
                for link in 0..robot.links().len() {
                    prop_assert!(poses.of(link, 0).unwrap().at.is_finite());
                }
            }
            Err(error) => prop_assert!(error.to_string().starts_with("r.urdf")),
        }
    }

    #[test]
    fn nor_does_any_text(text in "(<|>|/|\"|=|robot|link|joint|name|type|xyz|mimic|&|;|#|!|-|\\[|[a-z]| |\n){0,60}") {
        let _ = parse("r.urdf", &text);
        let _ = parse("r.urdf", &format!("<robot>{text}</robot>"));
        let _ = parse("r.urdf", &elbow("revolute", &text));
    }
}
