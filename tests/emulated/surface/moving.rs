//! A robot that moves: its joints become poses and a posture on the host, which are sent over USB. Contacts come
//! back in the base, and what the elbow folds is none.

use super::{REST, sent, storing, table};
use crate::twin::{Course, Reports, RobotState, SCAN_US, followed};
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::Arc;
use taxel::body::robot::{self, Robot};
use taxel::body::{self, DVec3, Pose, RobotSurface};
use taxel::files::scripts::load;
use taxel::sim::{frame_codes, scale_rate};
use taxel_core::board::TableKind;
use taxel_core::capacity::TAXELS;
use taxel_core::fold::{FoldTable, JointAngle, Posture, STALE_US};
use taxel_core::garment::{Garment, Layout};
use taxel_core::scene::Scene;
use taxel_core::wire::{FoldsReport, PressingReport, Report, Request, decode};
use taxel_suite::folds::FOLDS;

/// Scans that are shown.
const SCANS: usize = 600;
/// Time in which nobody sends where the robot is, us.
const SILENT: Range<u64> = 1_000_000..2_000_000;
/// Most by which a place in the base may differ from that in f64, m.
const APART: f64 = 1e-4;

/// Angle of the left elbow after so many us, degrees.
fn elbow(us: u64) -> f64 {
    60.0 - 60.0 * (TAU * us as f64 / 1.7e6).cos()
}

/// A robot in a garment.
pub struct Moving {
    robot: Arc<Robot>,
    surface: RobotSurface,
}

impl Moving {
    pub fn new(garment: &Garment, layout: &Layout) -> Moving {
        let robot = Arc::new(robot::read("reference").unwrap());
        let body = body::read("reference").unwrap();
        Moving { surface: body.on_robot(garment, layout, robot.clone()).unwrap(), robot }
    }

    /// Poses of the links in the base after so many us.
    fn poses(&self, us: u64) -> Vec<Pose> {
        let swing = (TAU * us as f64 / 2.3e6).sin();
        let at = [
            ("waist", 0.6 * swing),
            ("left_shoulder_roll", 0.4 + 0.3 * swing),
            ("right_shoulder_pitch", -0.5 * swing),
            ("left_elbow", elbow(us).to_radians()),
        ];
        let posture = self.robot.posture(at).unwrap();
        self.surface.poses(&self.robot.poses(&posture), 0).unwrap()
    }

    /// What is sent of the robot after so many us.
    pub fn sent(&self, us: u64) -> RobotState {
        let bent = JointAngle { joint: 0, centidegrees: (100.0 * elbow(us)) as i16 };
        RobotState {
            us,
            posture: Posture { joints: [bent].into_iter().collect() },
            poses: sent(self.surface.surface().links().iter().zip(self.poses(us))),
        }
    }
}

/// Codes of five contacts, and of what the elbow presses, scan by scan.
fn codes(garment: &Garment, layout: &Layout) -> Vec<u16> {
    let script = scale_rate(&load("five").unwrap(), 0.6);
    let mut codes = frame_codes(&script, garment, SCAN_US, SCANS).unwrap();
    codes.iter_mut().for_each(|code| *code = code.saturating_sub(REST));
    bend(&mut codes, layout);
    codes
}

/// Adds what the elbow presses to codes, scan by scan.
pub fn bend(codes: &mut [u16], layout: &Layout) {
    let table = FoldTable::check(&FOLDS.0, layout).unwrap();
    let (fold, unit) = (table.folds()[0], f64::from(table.unit()));
    let play = f64::from(fold.play[0]);
    let mut followed = 100.0 * elbow(0);
    for (scan, frame) in codes.chunks_mut(TAXELS).enumerate() {
        let bent = 100.0 * elbow(scan as u64 * SCAN_US);
        // The sleeve follows the joint.
        followed = followed.clamp(bent - play, bent + play);
        let along = followed / f64::from(fold.step[0]);
        let (knot, share) = (along as usize, along.fract());
        for taxel in table.folded().flat_map(|(_, taxels)| taxels) {
            let [below, above] =
                [0, 1].map(|next| f64::from(table.cell(*taxel, knot + next).expect("a knot").mean));
            frame[usize::from(*taxel)] += (unit * (below + (above - below) * share)) as u16;
        }
    }
}

fn metres(um: [i32; 3]) -> DVec3 {
    DVec3::from(um.map(|um| f64::from(um) * 1e-6))
}

/// Reports of folds and of what presses.
fn read(reports: &Reports) -> (Vec<FoldsReport>, Vec<PressingReport>) {
    let (mut folds, mut pressing) = (Vec::new(), Vec::new());
    for (.., report) in reports {
        match decode(report).unwrap() {
            Report::Folds(report) => folds.push(report),
            Report::Pressing(report) => pressing.push(report),
            _ => {}
        }
    }
    (folds, pressing)
}

#[test]
fn a_robot_that_moves_is_felt_in_its_base_and_not_where_it_folds() {
    let garment = Garment::reference();
    let layout = Layout::build(&garment, TAXELS, 4095).unwrap();
    let moving = Moving::new(&garment, &layout);
    let codes = codes(&garment, &layout);
    let tables = [(TableKind::Surface, table().0), (TableKind::Folds, &FOLDS.0[..])];
    let mut board = storing(("moving.bin", "usb"), &tables, (&codes, 1));
    let mut scene = Scene::shipped();
    scene.condition.track_baseline = false;
    scene.stream.pressing_hz = u16::MAX;
    let scene = postcard::to_allocvec(&scene).unwrap();
    let requests = [Request::Start, Request::SetScene(&scene)];
    let course = Course { tables: &tables, requests: &requests, codes: &codes, dwell: 1 };
    let state_at = |us: u64| (!SILENT.contains(&us)).then(|| moving.sent(us));
    let kinds = ["Frame", "Contacts", "Symbols", "Intent", "Pressing", "Folds"];
    let (reports, sent) = followed(&mut board, &course, &kinds, &state_at);
    board.end();

    // Posture, none any more, and one again: each report says which.
    let (folds, pressing) = read(&reports);
    let is_reported = |it: &FoldsReport| it.posed.is_some_and(|at| it.time.since(at) < STALE_US);
    assert!(folds.iter().all(|it| it.followed == is_reported(it)));
    let mut turns: Vec<bool> = folds.iter().map(|it| it.followed).collect();
    turns.dedup();
    assert_eq!(turns.strip_prefix(&[false]).unwrap_or(&turns), [true, false, true]);

    // Contacts in the base are where the host's kinematics have them.
    let mut judged = 0;
    for PressingReport { posed, contacts, .. } in &pressing {
        let sent = sent.iter().find(|(arrived, _)| Some(*arrived) == *posed);
        let Some((_, RobotState { us, .. })) = sent else { continue };
        let poses = moving.poses(*us);
        for contact in contacts {
            let exact = poses[usize::from(contact.spot.link)].point(metres(contact.spot.at));
            let off = (exact - metres(contact.base.unwrap().at)).length();
            assert!(off < APART, "{off} m");
            judged += 1;
        }
    }
    println!("{} reports, {judged} places in the base, {} of folds", reports.len(), folds.len());
    assert!(judged > SCANS);
}
