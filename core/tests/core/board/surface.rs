//! The surface on the board: what presses on the robot is told.

use super::tables::streaming;
use super::{BoardAndHost, FINGER};
use taxel_core::board::TableKind;
use taxel_core::format::{Micros, name};
use taxel_core::garment::{Garment, Layout};
use taxel_core::surface::{ONE, Pose, TaxelRecord, table_bytes, write_table};
use taxel_core::wire::{PressingReport, Report, Request, TABLE_PIECE};

/// Units of a table in a pitch: 10.01 mm.
const PITCH: i16 = 164;

/// A block of 4 x 16 taxels, [`PITCH`] apart, in the plane z = 0 of the link `hand`; the first one at its
/// origin.
pub fn flat() -> Vec<u8> {
    let layout = Layout::build(&Garment::block(), 64, 4095).unwrap();
    let place = |taxel: usize| {
        let [x, y] = [taxel % 16, taxel / 16].map(|at| PITCH * at as i16);
        TaxelRecord { link: 0, at: [x, y, 0], normal: [0, 0, ONE], arm: [y, -x, 0] }
    };
    let mut bytes = vec![0; table_bytes(64)];
    write_table(&["hand"], &(0..64).map(place).collect::<Vec<_>>(), &layout, &mut bytes).unwrap();
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
}

#[test]
fn a_table_in_pieces_is_put_in_force_and_presses_are_told() {
    let mut bench = streaming();
    let none = Some("no surface is in force".to_string());
    assert_eq!(bench.answer(&Request::SetPressing(9)), none);
    assert_eq!(bench.answer(&Request::SetPoses(&[0])), none);
    let table = flat();
    assert_eq!(bench.send_table(TableKind::Surface, &table), vec![None; table.len().div_ceil(TABLE_PIECE)]);
    assert_eq!(bench.board.surface().unwrap().link(0), Some("hand"));
    assert_eq!(bench.answer(&Request::SetPressing(u16::MAX)), None);
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
    let poses = postcard::to_allocvec(&[(name("hand"), pose)][..]).unwrap();
    assert_eq!(
        bench.answer(&Request::SetPoses(&poses[..9])).unwrap(),
        "poses: these 9 bytes are none that this board can hold"
    );
    assert_eq!(bench.answer(&Request::SetPoses(&poses)), None);
    let told = bench.now;
    let reports = bench.pressing(2);
    let last = reports.last().unwrap();
    let base = last.contacts[0].base.unwrap();
    assert_eq!((base.at, base.normal), ([-15_015, 15_015, 1_000_000], [0, 0, ONE]));
    assert_eq!((base.force, last.posed), (last.contacts[0].force, Some(Micros(told))));

    bench.press(&FINGER, 0);
    let reports = bench.pressing(20);
    assert!(reports.last().unwrap().contacts.is_empty(), "the end is told");
    assert_eq!(bench.pressing(20), [], "once");
}

#[test]
fn a_table_is_in_force_while_its_garment_is_worn() {
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
