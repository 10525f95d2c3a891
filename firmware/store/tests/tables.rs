//! Tables in flash: the one in force holds until the next is complete, whenever the power fails.

#[allow(dead_code)] // a part of it is for the other tests
#[path = "../../../host/sim/src/flash.rs"]
mod flash;

use fastrand::Rng;
use flash::{Cut, SimFlash};
use taxel_core::board::{PieceToStore, TableKind};
use taxel_store::{StoreError, Tables, tables_bytes};

/// Offset of the region.
const START: u32 = 8192;
/// The kinds of tables.
const KINDS: [TableKind; 2] = [TableKind::Surface, TableKind::Folds];

fn blank(kind: TableKind) -> SimFlash {
    SimFlash::new(START + tables_bytes(kind))
}

/// A table of random bytes: what is stored is not looked at here.
fn table(random: &mut Rng, length: usize) -> Vec<u8> {
    (0..length).map(|_| random.u8(..)).collect()
}

/// Stores a table as a board does, and puts it in force.
fn put(flash: &mut SimFlash, kind: TableKind, table: &[u8]) -> Result<(), StoreError> {
    let mut tables = Tables::new(&mut *flash, START, kind)?;
    let length = table.len() as u32;
    for (index, bytes) in table.chunks(256).enumerate() {
        let offset = 256 * index as u32;
        let whole = tables.store(&PieceToStore { kind, length, offset, bytes, saves: 0 })?;
        assert_eq!(whole.len(), table.len());
    }
    tables.keep(length)
}

/// The table in force.
fn in_force(flash: &mut SimFlash, kind: TableKind) -> Option<Vec<u8>> {
    let range = Tables::new(&mut *flash, START, kind).unwrap().in_force().unwrap()?;
    Some(flash.bytes()[range.start as usize..range.end as usize].to_vec())
}

#[test]
fn the_last_table_kept_is_in_force_until_none_is() {
    for kind in KINDS {
        let (mut flash, mut random) = (blank(kind), Rng::with_seed(1));
        let most = kind.bytes();
        assert_eq!(in_force(&mut flash, kind), None);
        for length in [most, 144, 300, most, most - 1, 256, 4096, 8192 + 12] {
            let next = table(&mut random, length);
            put(&mut flash, kind, &next).unwrap();
            assert!(in_force(&mut flash, kind) == Some(next), "{length}");
        }
        Tables::new(&mut flash, START, kind).unwrap().keep(0).unwrap();
        assert_eq!(in_force(&mut flash, kind), None);
        let next = table(&mut random, 999);
        put(&mut flash, kind, &next).unwrap();
        assert!(in_force(&mut flash, kind) == Some(next));
    }
}

#[test]
fn power_may_fail_at_any_step_of_a_change() {
    let mut random = Rng::with_seed(2);
    for (kind, length) in KINDS.into_iter().flat_map(|kind| [(kind, 700), (kind, kind.bytes())]) {
        let mut flash = blank(kind);
        let (mut old, mut steps) = (None, 0);
        // Twice, so that a half that was used before is used again.
        for _ in 0..3 {
            let next = table(&mut random, length);
            put(&mut flash, kind, &next).unwrap();
            old = Some(next);
        }
        let before = flash.clone();
        let next = table(&mut random, length);
        put(&mut flash, kind, &next).unwrap();
        let all = flash.steps() - before.steps();
        for step in 0..all {
            for cut in [Cut::Before, Cut::Within, Cut::After] {
                let mut flash = before.clone();
                flash.cut_at(before.steps() + step, cut);
                assert!(put(&mut flash, kind, &next).is_err(), "step {step} of {all}");
                flash.restore_power();
                let found = in_force(&mut flash, kind);
                let is_last = step + 1 == all;
                assert!(
                    found == old || (is_last && found.as_ref() == Some(&next)),
                    "{cut:?} step {step} of {all}"
                );
                // And the next change is as good as any.
                put(&mut flash, kind, &next).unwrap();
                assert!(in_force(&mut flash, kind).as_ref() == Some(&next), "{cut:?} step {step} of {all}");
                steps += 1;
            }
        }
        println!("{kind:?}, {length} bytes: {steps} power cuts");
    }
}

#[test]
fn what_does_not_fit_is_refused_and_leaves_the_table_in_force() {
    for kind in KINDS {
        let (mut flash, mut random) = (blank(kind), Rng::with_seed(3));
        let old = table(&mut random, 512);
        put(&mut flash, kind, &old).unwrap();
        let piece = |length: usize, offset: usize, bytes| PieceToStore {
            kind,
            length: length as u32,
            offset: offset as u32,
            bytes,
            saves: 0,
        };
        let mut tables = Tables::new(&mut flash, START, kind).unwrap();
        for bad in [
            piece(kind.bytes() + 1, 0, &old[..256]),
            piece(300, 256, &old[..256]),
            piece(9, usize::MAX, &[0; 9]),
        ] {
            assert_eq!(tables.store(&bad), Err(StoreError::Range));
        }
        assert!(in_force(&mut flash, kind) == Some(old));
        assert_eq!(Tables::new(blank(kind), START + 1, kind).err(), Some(StoreError::Range));
        assert_eq!(Tables::new(blank(kind), START + 4096, kind).err(), Some(StoreError::Range));
    }
}
