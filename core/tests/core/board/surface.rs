//! The surface on the board: what presses on the robot is reported.

use super::tables::streaming;
use super::{BoardAndHost, FINGER};
use taxel_core::board::TableKind;
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Layout};
use taxel_core::surface::{
    BodyDirection, LinkMotion, LinkName, LinkPose, ONE, Pose, RegionPhase, TaxelRecord, table_bytes,
    write_table,
};
use taxel_core::wire::{Poses, PressingReport, RegionsReport, Report, Request, TABLE_PIECE};

/// Units of a table in a pitch: 10.01 mm.
const PITCH: i16 = 164;

/// A block of 4 x 16 taxels, [`PITCH`] apart, in the plane z = 0 of the link `hand`; the first one at its
/// origin.
pub fn flat() -> Vec<u8> {
    let layout = Layout::build(&Garment::block(), 64, 4095).unwrap();
    let place = |taxel: usize| {
        let [x, y] = [taxel % 16, taxel / 16].map(|at| PITCH * at as i16);
        TaxelRecord {
            link: 0,
            region: u8::from(taxel % 16 >= 8),
            at: [x, y, 0],
            normal: [0, 0, ONE],
            arm: [y, -x, 0],
        }
    };
    let mut bytes = vec![0; table_bytes(64)];
    write_table(
        &["hand"],
        &["palm", "fingers"],
        &(0..64).map(place).collect::<Vec<_>>(),
        &layout,
        &mut bytes,
    )
    .unwrap();
    bytes
}

impl BoardAndHost {
    /// What presses on the robot by the next scans.
    fn pressing(&mut self, scans: usize) -> Vec<PressingReport> {
        let mut reports = Vec::new();
        for _ in 0..scans {
            self.scan();
            self.drain(usize::MAX, |report| {
                if let Report::Pressing(report) = report {
                    reports.push(report.clone());
                }
            });
        }
        reports
    }

    /// Asks for so many reports a second of what presses on the robot.
    fn ask_for_pressing(&mut self, hz: u16) -> Option<String> {
        let scene = self.scene_with(hz);
        self.answer(&Request::SetScene(&scene))
    }

    fn scene_with(&self, pressing_hz: u16) -> Vec<u8> {
        let mut scene = self.board.setup().scene.clone();
        scene.stream.pressing_hz = pressing_hz;
        postcard::to_allocvec(&scene).unwrap()
    }

    /// Sends the pose of a link.
    fn pose(&mut self, at: Option<u64>, link: LinkPose) -> Option<String> {
        self.answer(&Request::SetPoses(&poses(at, link)))
    }
}

fn poses(at: Option<u64>, link: LinkPose) -> Vec<u8> {
    let poses = Poses { at: at.map(Micros), links: [link].into_iter().collect() };
    postcard::to_allocvec(&poses).unwrap()
}

/// With another rate what was reported is reported anew: an end that waited for the link is not dropped, and
/// without a rate nothing presses any more.
#[test]
fn the_end_of_a_press_is_reported_when_the_rate_changes() {
    for (still, hz) in [(0, u16::MAX), (0, 20), (1000, 0)] {
        let mut bench = streaming();
        bench.board.recall_table(TableKind::Surface, Some(flat().leak()));
        assert_eq!(bench.ask_for_pressing(u16::MAX), None);
        bench.press(&FINGER, 1000);
        assert_eq!(bench.pressing(6).last().unwrap().contacts.len(), 1);
        bench.press(&FINGER, still);
        // The link takes nothing meanwhile.
        (0..20).for_each(|_| bench.scan());
        let scene = bench.scene_with(hz);
        bench.ask(&Request::SetScene(&scene));
        let mut left = None;
        bench.drain(usize::MAX, |report| {
            if let Report::Pressing(report) = report {
                left = Some(report.contacts.len());
            }
        });
        assert_eq!(left, Some(0), "{still} counts, then {hz} Hz");
    }
}

#[test]
fn a_table_in_pieces_is_put_in_force_and_presses_are_reported() {
    let mut bench = streaming();
    let none = Some("no surface is in force".to_string());
    assert_eq!(bench.answer(&Request::SetPoses(&[0])), none);
    let table = flat();
    assert_eq!(bench.send_table(TableKind::Surface, &table), vec![None; table.len().div_ceil(TABLE_PIECE)]);
    assert_eq!(bench.board.surface().unwrap().link(0), Some("hand"));
    assert_eq!(bench.ask_for_pressing(u16::MAX), None);
    assert_eq!(bench.pressing(5), [], "nothing touches");

    bench.press(&FINGER, 1000);
    let reports = bench.pressing(6);
    let last = reports.last().unwrap();
    let [contact] = &last.contacts[..] else { panic!("{last:?}") };
    // In the middle of four taxels: column 1.5, row 1.5.
    assert_eq!((contact.spot.at, contact.spot.normal), ([15_015, 15_015, 0], [0, 0, ONE]));
    let [hand] = &last.links[..] else { panic!("{last:?}") };
    assert_eq!(
        (hand.name.as_str(), hand.force[2], hand.force),
        ("hand", -(hand.pressed as i32), contact.force)
    );
    assert_eq!(hand.center, contact.spot.at);
    // r x F about the origin, counts times mm.
    let want = [-15, 15, 0].map(|mm| mm * i64::from(hand.pressed));
    assert!(
        (0..3).all(|axis| (hand.moment[axis] - want[axis]).abs() <= i64::from(hand.pressed / 10)),
        "{hand:?}"
    );
    assert_eq!((last.posed, contact.base), (None, None));

    // A quarter about z, and a metre up.
    let turn = [0, 0, 759_250_125, 759_250_125];
    let pose = Pose { at: [0, 0, 1_000_000], turn };
    let hand = LinkName::try_from("hand").unwrap();
    let poses = poses(None, (hand, pose, None));
    assert_eq!(
        bench.answer(&Request::SetPoses(&poses[..9])).unwrap(),
        "poses: these 9 bytes are none that this board can hold"
    );
    assert_eq!(bench.answer(&Request::SetPoses(&poses)), None);
    let reported = bench.now;
    let reports = bench.pressing(2);
    let last = reports.last().unwrap();
    let base = last.contacts[0].base.unwrap();
    assert_eq!((base.at, base.normal), ([-15_015, 15_015, 1_000_000], [0, 0, ONE]));
    assert_eq!((base.force, last.posed), (last.contacts[0].force, Some(Micros(reported))));

    bench.press(&FINGER, 0);
    let reports = bench.pressing(20);
    assert!(reports.last().unwrap().contacts.is_empty(), "the end is reported");
    assert_eq!(bench.pressing(20), [], "once");
}

#[test]
fn a_table_is_in_force_while_its_garment_is_in_use() {
    let mut bench = streaming();
    bench.board.recall_table(TableKind::Surface, Some(Box::leak(flat().into_boxed_slice())));
    assert!(bench.board.surface().is_some());
    let mut other = Garment::block();
    (other.panels[0].rows, other.panels[0].columns) = (2, 16);
    other.blocks[0].rows = 2;
    for (garment, is_in_force) in [(other, false), (Garment::block(), true)] {
        let bytes = postcard::to_allocvec(&garment).unwrap();
        assert_eq!(bench.answer(&Request::SetGarment(&bytes)), None, "{}", garment.name);
        assert_eq!(bench.board.surface().is_some(), is_in_force);
        (0..3).for_each(|_| bench.scan());
    }
}

/// What the bench's regions feel by the next scans, and their names.
#[derive(Default)]
struct ReportedRegions {
    names: Vec<String>,
    states: Vec<RegionsReport>,
}

impl BoardAndHost {
    fn regions(&mut self, scans: usize) -> ReportedRegions {
        let mut reported = ReportedRegions::default();
        for _ in 0..scans {
            self.scan();
            self.drain(usize::MAX, |report| match report {
                Report::RegionNames(report) => {
                    assert!(reported.states.is_empty(), "names come first");
                    reported.names = report.names.iter().map(ToString::to_string).collect();
                }
                Report::Regions(report) => reported.states.push(report.clone()),
                _ => {}
            });
        }
        reported
    }
}

#[test]
fn every_region_always_has_a_state() {
    let mut bench = streaming();
    bench.board.recall_table(TableKind::Surface, Some(Box::leak(flat().into_boxed_slice())));
    let reported = bench.regions(410);
    assert_eq!(reported.names, ["palm", "fingers"]);
    assert_eq!(reported.states.len(), 3, "once a second");
    assert!(reported.states[0].regions.iter().all(|region| region.phase == RegionPhase::Free));
    let phases = |reported: &ReportedRegions, region: usize| {
        let mut phases: Vec<_> = reported.states.iter().map(|report| report.regions[region].phase).collect();
        phases.dedup();
        phases
    };

    bench.press(&FINGER, 1000);
    let reported = bench.regions(60);
    assert_eq!(phases(&reported, 0), [RegionPhase::Onset, RegionPhase::Held]);
    assert_eq!(phases(&reported, 1), [RegionPhase::Free]);
    let [palm, fingers] = reported.states.last().unwrap().regions[..] else { panic!("two regions") };
    assert_eq!((palm.contacts, palm.way, fingers.contacts), (1, BodyDirection::None, 0));
    bench.press(&FINGER, 0);
    let reported = bench.regions(300);
    assert_eq!(phases(&reported, 0), [RegionPhase::Released, RegionPhase::Free]);

    // A fingertip that slides from the palm to the fingers: along x of the link.
    let slide = |bench: &mut BoardAndHost| {
        let mut reported = ReportedRegions::default();
        for step in 0..90 {
            let x = 2.0 + 0.125 * f64::from(step);
            for taxel in 0..64 {
                let (column, row) = ((taxel % 16) as f64, taxel / 16);
                let share = (1.0 - (column - x).abs() / 1.8).max(0.0);
                bench.press(&[taxel], if (1..3).contains(&row) { (share * 2500.0) as u16 } else { 0 });
            }
            reported.states.extend(bench.regions(1).states);
        }
        reported
    };
    let reported = slide(&mut bench);
    let moving = |reported: &ReportedRegions, region: usize| -> Vec<BodyDirection> {
        let of = reported.states.iter().map(|report| report.regions[region]);
        let mut ways: Vec<_> = of.filter(|it| it.phase == RegionPhase::Moving).map(|it| it.way).collect();
        ways.dedup();
        ways
    };
    assert_eq!(moving(&reported, 0), [BodyDirection::Forward]);
    assert_eq!(moving(&reported, 1), [BodyDirection::Forward]);
    bench.press(&(0..64).collect::<Vec<_>>(), 0);
    bench.regions(200);

    // The link is turned by a quarter about z in the robot's frame: there it slides to the left.
    let pose = Pose { at: [0; 3], turn: [0, 0, 759_250_125, 759_250_125] };
    let hand = LinkName::try_from("hand").unwrap();
    let still = LinkMotion { error: 700, ..LinkMotion::default() };
    assert_eq!(bench.pose(Some(bench.now), (hand.clone(), pose, Some(still))), None);
    assert_eq!(bench.pose(None, (hand, pose, None)), None);
    assert_eq!(moving(&slide(&mut bench), 0), [BodyDirection::Left]);
}

/// Poses of links that move say how far off a place may be, and are forgotten after 0.2 s.
#[test]
fn bounds_are_reported_with_what_they_bound() {
    let mut bench = streaming();
    bench.board.recall_table(TableKind::Surface, Some(Box::leak(flat().into_boxed_slice())));
    assert_eq!(bench.ask_for_pressing(u16::MAX), None);
    let hand = LinkName::try_from("hand").unwrap();
    let motion =
        LinkMotion { velocity: [1_000_000, 0, 0], error: 700, drift: 10_000, ..LinkMotion::default() };
    let pose = Pose { at: [0; 3], turn: [0, 0, 0, 1 << 30] };
    let reported = bench.now;
    assert_eq!(bench.pose(Some(reported), (hand, pose, Some(motion))), None);
    bench.press(&FINGER, 1000);
    let mut judged = 0;
    for _ in 0..60 {
        bench.scan();
        let now = bench.now;
        bench.drain(usize::MAX, |report| {
            if let Report::Pressing(report) = report {
                let age = now - reported;
                let base = report.contacts.first().and_then(|contact| contact.base);
                let Some(base) = base else {
                    return assert!(report.contacts.is_empty() || age > 200_000);
                };
                assert!(age <= 200_000 && report.posed == Some(Micros(reported)));
                let [(0, off)] = report.pose_errors[..] else { panic!("{report:?}") };
                let want = 700 + age / 100;
                assert!((want..want + 70).contains(&u64::from(off)), "{off} {want}");
                // A metre a second.
                let at = base.at[0] - report.contacts[0].spot.at[0];
                assert!((i64::from(at) - age as i64).abs() < 5, "{at} {age}");
                judged += 1;
            }
        });
    }
    assert!(judged > 30, "{judged}");
}
