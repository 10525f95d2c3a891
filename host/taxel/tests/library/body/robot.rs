//! Where a robot's links are, and how far off: against matrices, closed forms and motions.

use super::rig::{self, Rig, matrices, point, rigs, urdf};
use proptest::prelude::*;
use taxel::body::robot::{JointKind, Robot, parse};
use taxel::body::{DVec3, Pose};

/// A robot, and its posture by the positions of its joints.
fn built(rig: &Rig) -> (Robot, Vec<f64>) {
    let robot = parse("rig.urdf", &urdf(rig)).unwrap();
    let named: Vec<(String, f64)> = rig
        .iter()
        .enumerate()
        .filter(|(_, joint)| joint.kind != "fixed")
        .map(|(number, joint)| (format!("j{number}"), joint.position))
        .collect();
    let posture = robot.posture(named.iter().map(|(name, position)| (name.as_str(), *position))).unwrap();
    (robot, posture)
}

/// A point of a link in a frame, m.
fn seen(robot: &Robot, posture: &[f64], (link, frame): (usize, usize), at: DVec3) -> DVec3 {
    robot.poses(posture).of(link, frame).unwrap().point(at)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

    /// Every link of every robot is where the matrices say, within 1e-12 m.
    #[test]
    fn links_are_where_matrices_say(rig in rigs()) {
        let (robot, posture) = built(&rig);
        let poses = robot.poses(&posture);
        let at = [0.3, -0.2, 0.1];
        for (number, matrix) in matrices(&rig).iter().enumerate() {
            let link = robot.link(&format!("l{number}")).unwrap();
            let ours = poses.of(link, 0).unwrap().point(at.into());
            prop_assert!(ours.abs_diff_eq(point(matrix, at).into(), 1e-12), "l{number}: {ours}");
        }
    }

    /// A point seen from any link is the same point.
    #[test]
    fn frames_agree(rig in rigs(), at in prop::array::uniform3(-0.5..0.5f64)) {
        let (robot, posture) = built(&rig);
        let poses = robot.poses(&posture);
        for link in 0..robot.links().len() {
            for frame in 0..robot.links().len() {
                let there = poses.of(link, frame).unwrap().point(at.into());
                let back = poses.of(frame, link).unwrap().point(there);
                let by_base = poses.of(frame, 0).unwrap().point(there);
                prop_assert!(back.abs_diff_eq(at.into(), 1e-12));
                prop_assert!(by_base.abs_diff_eq(poses.of(link, 0).unwrap().point(at.into()), 1e-12));
            }
        }
        prop_assert!(poses.of(0, 99).is_none() && poses.of(99, 0).is_none());
    }

    /// With all joints fixed, a chain is the product of its origins.
    #[test]
    fn fixed_chains_compose(steps in prop::collection::vec(
        (prop::array::uniform3(-0.5..0.5f64), prop::array::uniform3(-4.0..4.0f64)), 1..8
    )) {
        let joint = |(number, (xyz, rpy)): (usize, &([f64; 3], [f64; 3]))| rig::RigJoint {
            parent: number, kind: "fixed", xyz: *xyz, rpy: *rpy, axis: [1.0, 0.0, 0.0], position: 0.0,
        };
        let rig: Rig = steps.iter().enumerate().map(joint).collect();
        let (robot, posture) = built(&rig);
        prop_assert!(posture.is_empty());
        let whole = steps.iter().fold(Pose::IDENTITY, |pose, (xyz, rpy)| {
            pose.then(&Pose::from_xyz_rpy((*xyz).into(), (*rpy).into()))
        });
        let last = robot.poses(&[]).of(rig.len(), 0).unwrap();
        let at = DVec3::new(0.1, 0.2, 0.3);
        prop_assert!(last.point(at).abs_diff_eq(whole.point(at), 1e-12));
        prop_assert_eq!(robot.displacement((rig.len(), 0), 0.5, &[], &[]), 0.0);
    }

    /// However the joints are off, no point is off by more than the bound, in any frame.
    #[test]
    fn no_point_is_off_by_more_than_its_bound(
        rig in rigs(),
        at in prop::array::uniform3(-0.5..0.5f64),
        size in prop::sample::select(vec![1e-4, 0.01, 0.3, 4.0]),
        shares in prop::collection::vec(-1.0..=1.0f64, 10),
    ) {
        let (robot, posture) = built(&rig);
        let errors: Vec<f64> = posture.iter().enumerate().map(|(number, _)| size / (number + 1) as f64).collect();
        let truth: Vec<f64> =
            posture.iter().zip(&errors).zip(&shares).map(|((q, error), share)| q + error * share).collect();
        let at = DVec3::from(at);
        for link in 0..robot.links().len() {
            for frame in 0..robot.links().len() {
                let off = seen(&robot, &posture, (link, frame), at).distance(seen(&robot, &truth, (link, frame), at));
                let bound = robot.displacement((link, frame), at.length(), &posture, &errors);
                prop_assert!(off <= bound + 1e-12, "link {link} in {frame}: {off} > {bound}");
                let moving = robot.moving(link, frame);
                let still: Vec<f64> =
                    errors.iter().enumerate().map(|(n, error)| if moving.contains(&n) { 0.0 } else { *error }).collect();
                prop_assert_eq!(robot.displacement((link, frame), at.length(), &posture, &still), 0.0);
            }
        }
    }
}

/// Two links in a plane, and a third that slides: closed forms.
const PLANAR: &str = r#"<robot name="planar">
  <link name="base"/><link name="upper"/><link name="lower"/><link name="tip"/>
  <joint name="shoulder" type="continuous">
    <parent link="base"/><child link="upper"/><axis xyz="0 0 2"/>
  </joint>
  <joint name="elbow" type="revolute">
    <parent link="upper"/><child link="lower"/><origin xyz="0.3 0 0"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="2.5" velocity="3" effort="1"/>
  </joint>
  <joint name="reach" type="prismatic">
    <parent link="lower"/><child link="tip"/><origin xyz="0.2 0 0"/><limit lower="0" upper="0.1" effort="1"/>
  </joint>
</robot>"#;

#[test]
fn a_planar_arm_is_where_trigonometry_says() {
    let robot = parse("planar.urdf", PLANAR).unwrap();
    for (a, b, c) in [(0.0, 0.0, 0.0), (0.5, 1.0, 0.05), (-2.0, 2.5, 0.1), (40.0, 0.3, 0.0)] {
        let posture = robot.posture([("shoulder", a), ("elbow", b), ("reach", c)]).unwrap();
        let tip = seen(&robot, &posture, (3, 0), DVec3::ZERO);
        let exact = DVec3::new(
            0.3 * f64::cos(a) + (0.2 + c) * f64::cos(a + b),
            0.3 * f64::sin(a) + (0.2 + c) * f64::sin(a + b),
            0.0,
        );
        assert!(tip.abs_diff_eq(exact, 1e-14), "{tip} {exact}");
    }
    // The bound of a stretched arm is its length times the angle: nothing is given away.
    let posture = robot.posture_of("").unwrap();
    let bound = robot.displacement((3, 0), 0.1, &posture, &[0.001, 0.0, 0.0]);
    assert!((bound - 0.001 * 0.6).abs() < 1e-15, "{bound}");
    // Slid out by 5 cm, or by twice that: it is longer.
    let posture = robot.posture_of("reach=0.05m").unwrap();
    let bound = robot.displacement((3, 0), 0.1, &posture, &[0.001, 0.0, 0.05]);
    assert!((bound - (0.05 + 0.001 * 0.7)).abs() < 1e-15, "{bound}");
    let joints = robot.joints();
    assert_eq!(
        joints.iter().map(|joint| joint.kind).collect::<Vec<_>>(),
        [JointKind::Continuous, JointKind::Revolute, JointKind::Prismatic]
    );
    assert_eq!((joints[1].velocity, joints[2].velocity), (Some(3.0), None));
}

/// A finger, whose second joint follows the first, and whose third follows the second.
#[test]
fn joints_that_mimic_move_with_their_leader() {
    let text = PLANAR.replace(
        "<origin xyz=\"0.3 0 0\"/>",
        "<origin xyz=\"0.3 0 0\"/><mimic joint=\"shoulder\" multiplier=\"0.5\" offset=\"0.2\"/>",
    );
    let text = text.replace(
        "<origin xyz=\"0.2 0 0\"/>",
        "<origin xyz=\"0.2 0 0\"/><mimic joint=\"elbow\" multiplier=\"-0.1\" offset=\"0.06\"/>",
    );
    let robot = parse("finger.urdf", &text).unwrap();
    let free = parse("planar.urdf", PLANAR).unwrap();
    assert_eq!(robot.free(), [0]);
    let own = free.posture([("shoulder", 0.4), ("elbow", 0.4), ("reach", 0.02)]).unwrap();
    let at = DVec3::new(0.1, 0.0, 0.1);
    let [led, alone] =
        [(&robot, vec![0.4]), (&free, own)].map(|(robot, posture)| seen(robot, &posture, (3, 0), at));
    assert!(led.abs_diff_eq(alone, 1e-15), "{led} {alone}");
    // Its limits are those of the followers, too: at 2 rad the elbow has 1.2, and the tip would slide by -0.06.
    let why = robot.posture_of("shoulder=2rad").unwrap_err().to_string();
    assert_eq!(why, "finger.urdf, line 10, joint \"reach\": -0.06 m is out of its range, 0 m to 0.1 m");
    let bound = robot.displacement((3, 0), 0.1, &[0.4], &[0.01]);
    assert!((bound - (0.01 * 0.62 + 0.01 * 0.5 * 0.32 + 0.01 * 0.05)).abs() < 2e-5, "{bound}");
}

#[test]
fn postures_are_read_with_their_units() {
    let robot = parse("planar.urdf", PLANAR).unwrap();
    let posture = robot.posture_of(" shoulder = 90deg, reach=0.05m,elbow=1.5 rad,").unwrap();
    assert_eq!(posture, [90f64.to_radians(), 1.5, 0.05]);
    assert_eq!(robot.posture_of("").unwrap(), robot.rest());
    let why = |text: &str| robot.posture_of(text).unwrap_err().to_string();
    let form = "write JOINT=30deg, JOINT=0.5rad or JOINT=0.1m";
    for bad in ["elbow", "elbow=", "elbow=30", "elbow=30m", "elbow=xdeg", "reach=2deg", "elbow=1rad=2rad"] {
        assert_eq!(why(bad), format!("{bad}: {form}"));
    }
    assert_eq!(
        why("elbw=3deg"),
        "planar.urdf: there is no joint \"elbw\": did you mean \"elbow\"? Known are shoulder, elbow, reach"
    );
    assert_eq!(
        why("elbow=200deg"),
        "planar.urdf, line 6, joint \"elbow\": 200° is out of its range, 0° to 143.2394°"
    );
    assert_eq!(
        why("reach=-0.2m"),
        "planar.urdf, line 10, joint \"reach\": -0.2 m is out of its range, 0 m to 0.1 m"
    );
    assert_eq!(
        why("elbow=nanrad"),
        "planar.urdf, line 6, joint \"elbow\": its position must be a number, not NaN"
    );
    assert_eq!(
        robot.link("tib").unwrap_err().to_string(),
        "planar.urdf: there is no link \"tib\": did you mean \"tip\"? Known are base, upper, lower, tip"
    );
    let fixed = parse("f.urdf", &PLANAR.replace("revolute", "fixed")).unwrap();
    assert_eq!(
        fixed.posture_of("elbow=1deg").unwrap_err().to_string(),
        "f.urdf, line 6, joint \"elbow\": is fixed"
    );
    let mimics = PLANAR.replace("<origin xyz=\"0.3 0 0\"/>", "<mimic joint=\"shoulder\"/>");
    let mimics = parse("m.urdf", &mimics).unwrap();
    assert_eq!(
        mimics.posture_of("elbow=1deg").unwrap_err().to_string(),
        "m.urdf, line 6, joint \"elbow\": mimics the joint \"shoulder\": move that one"
    );
}

/// A joint that cannot be at 0 rests in the middle of its range.
#[test]
fn a_robot_rests_within_its_limits() {
    let robot =
        parse("r.urdf", &PLANAR.replace("lower=\"0\" upper=\"2.5\"", "lower=\"1\" upper=\"2\"")).unwrap();
    assert_eq!(robot.rest(), [0.0, 1.5, 0.0]);
    assert!(robot.check(&robot.rest()).is_ok());
}
