//! Tables come in pieces, and are put in force or refused as a whole.

use super::surface::flat;
use super::{BoardAndHost, FINGER};
use taxel_core::board::{Input, Job, TableKind};
use taxel_core::format::Micros;
use taxel_core::scene::Scene;
use taxel_core::wire::{Report, Request, TABLE_PIECE, TablePiece};

fn pieces(kind: TableKind, table: &[u8]) -> Vec<Vec<u8>> {
    let piece = |(index, bytes)| {
        let (length, offset) = (table.len() as u32, (TABLE_PIECE * index) as u32);
        postcard::to_allocvec(&TablePiece { kind, length, offset, bytes }).unwrap()
    };
    table.chunks(TABLE_PIECE).enumerate().map(piece).collect()
}

impl BoardAndHost {
    /// Answers so far to pieces of a table.
    fn table_answers(&mut self) -> Vec<Option<String>> {
        let mut answers = Vec::new();
        self.drain(usize::MAX, |report| match report {
            Report::Answer(answer) if answer.request == Request::SetTable(&[]).number() => {
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
                Some(job @ (Job::StoreTable | Job::KeepTable(_))) => return job,
                Some(Job::Scan(_)) | None => self.scan(),
                Some(_) => {}
            }
        }
        panic!("nothing is stored");
    }

    /// Sends a table, stores it as a flash does, and returns the answers.
    pub fn send_table(&mut self, kind: TableKind, table: &[u8]) -> Vec<Option<String>> {
        let mut flash: Vec<u8> = Vec::new();
        let mut answers = Vec::new();
        for request in pieces(kind, table) {
            self.ask(&Request::SetTable(&request));
            let refused = self.table_answers();
            if !refused.is_empty() {
                return refused;
            }
            assert_eq!(self.until_stored(), Job::StoreTable);
            let piece = self.board.piece_to_store();
            assert_eq!((piece.length as usize, piece.offset as usize), (table.len(), flash.len()));
            assert_eq!(piece.kind, kind);
            flash.extend(piece.bytes);
            let whole = (flash.len() == table.len()).then(|| &*Box::leak(flash.clone().into_boxed_slice()));
            self.board.step(Micros(self.now), Input::TableStored(Ok(whole)), &mut ());
            answers.extend(self.table_answers());
        }
        if answers.last().is_some_and(Option::is_some) {
            return answers;
        }
        assert_eq!(self.until_stored(), Job::KeepTable(kind));
        self.board.step(Micros(self.now), Input::TableKept(kind, Ok(())), &mut ());
        answers.extend(self.table_answers());
        answers
    }
}

/// A board that streams, tared.
pub fn streaming() -> BoardAndHost {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.ask(&Request::Start);
    bench.ask(&Request::Tare { frames: 4 });
    (0..8).for_each(|_| bench.scan());
    bench.drain(usize::MAX, |_| {});
    bench
}

#[test]
fn pieces_out_of_order_are_refused_by_what_comes_next() {
    let mut bench = streaming();
    let table = flat();
    let length = table.len() as u32;
    let ask = |bench: &mut BoardAndHost, length, offset, bytes: &[u8]| {
        let piece =
            postcard::to_allocvec(&TablePiece { kind: TableKind::Surface, length, offset, bytes }).unwrap();
        bench.answer(&Request::SetTable(&piece)).expect("it is refused")
    };
    let next = |at: u32| format!("the next piece is the one from byte {at} on");
    assert_eq!(ask(&mut bench, length, 256, &table[256..512]), next(0));
    assert_eq!(ask(&mut bench, length, 0, &table[..255]), "a piece has 256 bytes, and the last one the rest");
    let most = TableKind::Surface.bytes() as u32 + 1;
    let room = format!("the table has {most} bytes, and there is room for {}", most - 1);
    assert_eq!(ask(&mut bench, most, 0, &table[..256]), room);
    bench.ask(&Request::SetTable(&pieces(TableKind::Surface, &table)[0]));
    assert_eq!(ask(&mut bench, length, 256, &table[256..512]), "the last piece is not stored yet");
    bench.until_stored();
    bench.board.step(Micros(bench.now), Input::TableStored(Ok(None)), &mut ());
    assert_eq!(bench.table_answers(), [None]);
    assert_eq!(ask(&mut bench, length, 512, &table[512..768]), next(256));
    assert_eq!(ask(&mut bench, length - 1, 256, &table[256..512]), next(256));
    // A piece that the flash did not take ends the table.
    bench.ask(&Request::SetTable(&pieces(TableKind::Surface, &table)[1]));
    bench.until_stored();
    bench.board.step(Micros(bench.now), Input::TableStored(Err("the flash is used up")), &mut ());
    assert_eq!(bench.table_answers(), [Some("the flash is used up".to_string())]);
    assert_eq!(ask(&mut bench, length, 256, &table[256..512]), next(0));
    assert!(bench.board.surface().is_none());
    assert!(
        bench.send_table(TableKind::Surface, &table).iter().all(Option::is_none),
        "and it can be sent again"
    );
}

#[test]
fn a_table_that_is_wrong_leaves_the_one_in_force() {
    let mut bench = streaming();
    let table = flat();
    bench.send_table(TableKind::Surface, &table);
    let mut damaged = table.clone();
    damaged[700] ^= 1;
    let refused = Some("surface must arrive undamaged".to_string());
    assert_eq!(bench.send_table(TableKind::Surface, &damaged).last(), Some(&refused));
    assert!(bench.board.surface().is_some());
    bench.press(&FINGER, 1000);
    (0..6).for_each(|_| bench.scan());
    let touched = Some("something touches the garment".to_string());
    assert_eq!(bench.send_table(TableKind::Surface, &table), [touched]);
    bench.press(&FINGER, 0);
    (0..400).for_each(|_| bench.scan());
    // None, from now on.
    bench.ask(&Request::SetTable(&[0, 0, 0, 0]));
    assert_eq!(bench.until_stored(), Job::KeepTable(TableKind::Surface));
    bench.board.step(Micros(bench.now), Input::TableKept(TableKind::Surface, Ok(())), &mut ());
    assert_eq!((bench.table_answers(), bench.board.surface().is_none()), (vec![None], true));
}
