//! The surface on the board: a table comes in pieces, is put in force or refused as a whole, and what presses
//! on the robot is told.

use super::{BoardAndHost, FINGER};
use taxel_core::board::{Input, Job, SURFACE_BYTES};
use taxel_core::format::{Micros, name};
use taxel_core::garment::{Garment, Layout};
use taxel_core::scene::Scene;
use taxel_core::surface::{ONE, Pose, TaxelRecord, table_bytes, write_table};
use taxel_core::wire::{PressingReport, Report, Request, SURFACE_PIECE, TablePiece};

/// Units of a table in a pitch: 10.01 mm.
const PITCH: i16 = 164;

/// A block of 4 x 16 taxels, [`PITCH`] apart, in the plane z = 0 of the link `hand`; the first one at its
/// origin.
fn flat() -> Vec<u8> {
    let layout = Layout::build(&Garment::block(), 64, 4095).unwrap();
    let place = |taxel: usize| {
        let [x, y] = [taxel % 16, taxel / 16].map(|at| PITCH * at as i16);
        TaxelRecord { link: 0, at: [x, y, 0], normal: [0, 0, ONE], arm: [y, -x, 0] }
    };
    let mut bytes = vec![0; table_bytes(64)];
    write_table(&["hand"], &(0..64).map(place).collect::<Vec<_>>(), &layout, &mut bytes).unwrap();
    bytes
}

fn pieces(table: &[u8]) -> Vec<Vec<u8>> {
    let piece = |(index, bytes)| {
        let (length, offset) = (table.len() as u32, (SURFACE_PIECE * index) as u32);
        postcard::to_allocvec(&TablePiece { length, offset, bytes }).unwrap()
    };
    table.chunks(SURFACE_PIECE).enumerate().map(piece).collect()
}

impl BoardAndHost {
    /// Answers so far to pieces of a table.
    fn surface_answers(&mut self) -> Vec<Option<String>> {
        let mut answers = Vec::new();
        self.drain(usize::MAX, |report| match report {
            Report::Answer(answer) if answer.request == 22 => {
                answers.push(answer.refusal.map(str::to_string))
            }
            _ => {}
        });
        answers
    }

    /// Runs until the board wants something stored.
    fn until_stored(&mut self) -> Job {
        for _ in 0..40 {
            match self.tick() {
                Some(job @ (Job::StoreSurface | Job::KeepSurface)) => return job,
                Some(Job::Scan(_)) | None => self.scan(),
                Some(_) => {}
            }
        }
        panic!("nothing is stored");
    }

    /// Sends a table, stores it as a flash does, and returns the answers.
    fn send_table(&mut self, table: &[u8]) -> Vec<Option<String>> {
        let mut flash: Vec<u8> = Vec::new();
        let mut answers = Vec::new();
        for request in pieces(table) {
            self.ask(&Request::SetSurface(&request));
            let refused = self.surface_answers();
            if !refused.is_empty() {
                return refused;
            }
            assert_eq!(self.until_stored(), Job::StoreSurface);
            let piece = self.board.surface_piece();
            assert_eq!((piece.length as usize, piece.offset as usize), (table.len(), flash.len()));
            flash.extend(piece.bytes);
            let whole = (flash.len() == table.len()).then(|| &*Box::leak(flash.clone().into_boxed_slice()));
            self.board.step(Micros(self.now), Input::SurfaceStored(Ok(whole)), &mut ());
            answers.extend(self.surface_answers());
        }
        if answers.last().is_some_and(Option::is_some) {
            return answers;
        }
        assert_eq!(self.until_stored(), Job::KeepSurface);
        self.board.step(Micros(self.now), Input::SurfaceKept(Ok(())), &mut ());
        answers.extend(self.surface_answers());
        answers
    }

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

/// A board that streams, tared.
fn streaming() -> BoardAndHost {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.ask(&Request::Start);
    bench.ask(&Request::Tare { frames: 4 });
    (0..8).for_each(|_| bench.scan());
    bench.drain(usize::MAX, |_| {});
    bench
}

#[test]
fn a_table_in_pieces_is_put_in_force_and_presses_are_told() {
    let mut bench = streaming();
    let none = Some("no surface is in force".to_string());
    assert_eq!(bench.answer(&Request::SetPressing(9)), none);
    assert_eq!(bench.answer(&Request::SetPoses(&[0])), none);
    let table = flat();
    assert_eq!(bench.send_table(&table), vec![None; table.len().div_ceil(SURFACE_PIECE)]);
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
fn pieces_out_of_order_are_refused_by_what_comes_next() {
    let mut bench = streaming();
    let table = flat();
    let length = table.len() as u32;
    let ask = |bench: &mut BoardAndHost, length, offset, bytes: &[u8]| {
        let piece = postcard::to_allocvec(&TablePiece { length, offset, bytes }).unwrap();
        bench.answer(&Request::SetSurface(&piece)).expect("it is refused")
    };
    let next = |at: u32| format!("the next piece is the one from byte {at} on");
    assert_eq!(ask(&mut bench, length, 256, &table[256..512]), next(0));
    assert_eq!(ask(&mut bench, length, 0, &table[..255]), "a piece has 256 bytes, and the last one the rest");
    let most = SURFACE_BYTES as u32 + 1;
    let room = format!("the table has {most} bytes, and there is room for {SURFACE_BYTES}");
    assert_eq!(ask(&mut bench, most, 0, &table[..256]), room);
    bench.ask(&Request::SetSurface(&pieces(&table)[0]));
    assert_eq!(ask(&mut bench, length, 256, &table[256..512]), "the last piece is not stored yet");
    bench.until_stored();
    bench.board.step(Micros(bench.now), Input::SurfaceStored(Ok(None)), &mut ());
    assert_eq!(bench.surface_answers(), [None]);
    assert_eq!(ask(&mut bench, length, 512, &table[512..768]), next(256));
    assert_eq!(ask(&mut bench, length - 1, 256, &table[256..512]), next(256));
    // A piece that the flash did not take ends the table.
    bench.ask(&Request::SetSurface(&pieces(&table)[1]));
    bench.until_stored();
    bench.board.step(Micros(bench.now), Input::SurfaceStored(Err("the flash is worn")), &mut ());
    assert_eq!(bench.surface_answers(), [Some("the flash is worn".to_string())]);
    assert_eq!(ask(&mut bench, length, 256, &table[256..512]), next(0));
    assert!(bench.board.surface().is_none());
    assert!(bench.send_table(&table).iter().all(Option::is_none), "and it can be sent again");
}

#[test]
fn a_table_that_is_wrong_leaves_the_one_in_force() {
    let mut bench = streaming();
    let table = flat();
    bench.send_table(&table);
    let mut damaged = table.clone();
    damaged[700] ^= 1;
    let refused = Some("surface must arrive undamaged".to_string());
    assert_eq!(bench.send_table(&damaged).last(), Some(&refused));
    assert!(bench.board.surface().is_some());
    bench.press(&FINGER, 1000);
    (0..6).for_each(|_| bench.scan());
    let touched = Some("something touches the garment".to_string());
    assert_eq!(bench.send_table(&table), [touched]);
    bench.press(&FINGER, 0);
    (0..400).for_each(|_| bench.scan());
    // None, from now on.
    bench.ask(&Request::SetSurface(&[0, 0, 0]));
    assert_eq!(bench.until_stored(), Job::KeepSurface);
    bench.board.step(Micros(bench.now), Input::SurfaceKept(Ok(())), &mut ());
    assert_eq!((bench.surface_answers(), bench.board.surface().is_none()), (vec![None], true));
}

#[test]
fn a_table_is_in_force_while_its_garment_is_worn() {
    let mut bench = streaming();
    bench.board.recall_surface(Some(Box::leak(flat().into_boxed_slice())));
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
