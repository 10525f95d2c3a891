//! Whose motion has caused a touch, by the joints that are sent. MuJoCo judges the same in `tests/physics`.

use super::dropped::report;
use super::touched::robot;
use std::sync::Arc;
use taxel::body::DVec3;
use taxel::fcm::load;
use taxel::mind::{
    BoardPlacement, BoardSense, BodyPlace, FeltContact, HostInputLine, Mover, RobotMind, SurfaceSpot,
};
use taxel_core::intent::Leading;

const LINK: &str = "left_upper_arm";

fn spot(link: &str, at: [f64; 3], normal: [f64; 3]) -> SurfaceSpot {
    SurfaceSpot { link: link.into(), at: DVec3::from(at), normal: DVec3::from(normal) }
}

fn contact(contact: u32, load: u32, spot: SurfaceSpot) -> FeltContact {
    let place = Arc::new(BodyPlace { region: "left arm".into(), link: spot.link.clone() });
    FeltContact {
        contact,
        place,
        spot: Some(spot),
        load,
        cover_mm2: 400,
        peak: load / 3,
        panel: 0,
        at_mm: [20.0; 2],
    }
}

fn begins() -> BoardSense {
    let place = Arc::new(BodyPlace { region: "left arm".into(), link: LINK.into() });
    let map = Some(Arc::new(load::map("tactile").unwrap()));
    BoardSense::Begins(BoardPlacement { places: vec![place], map })
}

/// A mind whose left arm swings about a joint at so many rad/s until `stop_us`; the time is then 1 s.
fn swinging(joint: &str, rate: f64, stop_us: u64) -> RobotMind {
    let mut mind = RobotMind::new(&robot([None; 2])).unwrap();
    (0..2).for_each(|board| _ = mind.board(board, &begins(), 0).map(|_| ()));
    for us in (0..=1_000_000).step_by(10_000) {
        let at = rate * (us.min(stop_us) as f64 - 1e6) * 1e-6;
        let positions = [(joint.to_string(), at)].into();
        mind.take_input(&HostInputLine { positions, ..HostInputLine::default() }, us).unwrap();
    }
    mind
}

/// Whose motion it is said to be that touches this spot at 1 s.
fn reported(mind: &mut RobotMind, spot: SurfaceSpot) -> Mover {
    let touches = BoardSense::Contacts(vec![contact(1, 3000, spot)]);
    mind.board(0, &touches, 1_000_000);
    mind.senses().touches(0)[0].mover
}

#[test]
fn the_surface_that_moves_into_something_has_caused_the_touch() {
    let front = || spot(LINK, [0.04, 0.0, -0.2], [1.0, 0.0, 0.0]);
    let back = || spot(LINK, [-0.04, 0.0, -0.2], [-1.0, 0.0, 0.0]);
    let side = || spot(LINK, [0.0, 0.04, -0.2], [0.0, 1.0, 0.0]);
    let joint = "left_shoulder_pitch";
    // 0.5 rad/s at 0.2 m are 0.1 m/s, forwards or backwards.
    let forwards = [0.5, -0.5]
        .into_iter()
        .find(|rate| reported(&mut swinging(joint, *rate, 1_000_000), front()) == Mover::Own);
    let rate = forwards.expect("one of both is forwards");
    assert_eq!(reported(&mut swinging(joint, rate, 1_000_000), back()), Mover::Other);
    assert_eq!(reported(&mut swinging(joint, rate, 1_000_000), side()), Mover::Other);
    assert_eq!(reported(&mut swinging(joint, -rate, 1_000_000), back()), Mover::Own);
    // It has stopped before; it is too slow to be sure; nothing moves; nothing is known.
    assert_eq!(reported(&mut swinging(joint, rate, 900_000), front()), Mover::Other);
    assert_eq!(reported(&mut swinging(joint, 0.07 * rate.signum(), 1_000_000), front()), Mover::Unsure);
    assert_eq!(reported(&mut swinging(joint, 0.0, 0), front()), Mover::Other);
    let mut unreported = RobotMind::new(&robot([None; 2])).unwrap();
    assert_eq!(reported(&mut unreported, front()), Mover::Unsure);
    let other_link = spot("no_such_link", [0.0; 3], [1.0, 0.0, 0.0]);
    assert_eq!(reported(&mut swinging(joint, rate, 1_000_000), other_link), Mover::Unsure);
}

#[test]
fn what_the_robot_bumps_into_does_not_attack_it_and_excuses_no_other_board() {
    let front = || spot(LINK, [0.04, 0.0, -0.2], [1.0, 0.0, 0.0]);
    let back = || spot(LINK, [-0.04, 0.0, -0.2], [-1.0, 0.0, 0.0]);
    let joint = "left_shoulder_pitch";
    let is_own = |rate: &f64| reported(&mut swinging(joint, *rate, 1_000_000), front()) == Mover::Own;
    let rate = [0.5, -0.5].into_iter().find(is_own).unwrap();
    let leads = |spots: Vec<(SurfaceSpot, u32)>, board: usize| {
        let mut mind = swinging(joint, rate, 1_000_000);
        let touches = spots.into_iter().zip(1..).map(|((spot, load), id)| contact(id, load, spot));
        mind.board(0, &BoardSense::Contacts(touches.collect()), 1_000_000);
        mind.board(board, &report(Leading::Attack, 30_000), 1_010_000);
        [1_020_000, 1_040_000].into_iter().for_each(|us| _ = mind.pass(us).map(|_| ()));
        mind.meaning().unwrap().leading
    };
    assert_eq!(leads(vec![(front(), 9000)], 0), Leading::None);
    assert_eq!(leads(vec![(back(), 9000)], 0), Leading::Attack);
    // A blow beside a lighter bump of its own.
    assert_eq!(leads(vec![(front(), 3000), (back(), 9000)], 0), Leading::Attack);
    assert_eq!(leads(vec![(front(), 9000)], 1), Leading::Attack);
}

#[test]
fn a_folded_arm_touches_itself_though_one_side_is_still() {
    let mut mind = RobotMind::new(&robot([None; 2])).unwrap();
    (0..2).for_each(|board| _ = mind.board(board, &begins(), 0).map(|_| ()));
    for us in (0..=1_000_000).step_by(10_000) {
        let positions = [("left_elbow".to_string(), 1.0 + us as f64 * 1e-6)].into();
        mind.take_input(&HostInputLine { positions, ..HostInputLine::default() }, us).unwrap();
    }
    // The same point of space on both links, whose surfaces face each other there.
    let speeds = |spot: &SurfaceSpot| {
        let mut speeds = mind.senses().clone();
        speeds.speeds().unwrap().at(1_000_000).unwrap().point(&spot.link, spot.at, spot.normal).unwrap()
    };
    let upper = spot(LINK, [0.04, 0.0, -0.25], [1.0, 0.0, 0.0]);
    let (at, normal) = speeds(&upper);
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let (origin, _) = speeds(&spot("left_forearm", [0.0; 3], axes[0]));
    let turned = axes.map(|axis| speeds(&spot("left_forearm", [0.0; 3], axis)).1);
    let into = |vector: DVec3| turned.map(|axis| vector.dot(axis));
    let lower = spot("left_forearm", into(at - origin), into(-normal));
    let (there, facing) = speeds(&lower);
    assert!(there.distance(at) < 1e-9 && facing.dot(normal) < -0.999);
    mind.board(0, &BoardSense::Contacts(vec![contact(1, 4000, upper.clone())]), 1_000_000);
    assert_eq!(mind.senses().touches(0)[0].mover, Mover::Other);
    mind.board(1, &BoardSense::Contacts(vec![contact(1, 4000, lower)]), 1_005_000);
    assert_eq!([0, 1].map(|board| mind.senses().touches(board)[0].mover), [Mover::Own; 2]);
}

/// The host's time of a board is known better and better: a later scan may be at an earlier time.
#[test]
fn times_that_go_back_do_no_harm() {
    let mut mind = swinging("left_shoulder_pitch", 0.5, 1_000_000);
    for us in [1_000_000, 1_400_000, 1_390_000, 1_700_000, 900_000, 0, 2_000_000] {
        let spot = spot(LINK, [0.04, 0.0, -0.2], [1.0, 0.0, 0.0]);
        mind.board(0, &BoardSense::Contacts(vec![contact(1, 3000, spot)]), us);
        let probe = mind.senses().touches(0)[0].course.probe();
        assert_eq!((probe.slide, probe.stir), (0, 0), "it rests, {us} us");
    }
}
