//! Tables of the surface in flash: the one in force holds until the next is complete, whenever the power fails.

#[allow(dead_code)] // a part of it is for the other tests
#[path = "../../../host/sim/src/flash.rs"]
mod flash;

use fastrand::Rng;
use flash::{Cut, SimFlash};
use taxel_core::board::{SURFACE_BYTES, SurfacePiece};
use taxel_store::{StoreError, TABLES_BYTES, Tables};

/// Offset of the region.
const START: u32 = 8192;

fn blank() -> SimFlash {
    SimFlash::new(START + TABLES_BYTES)
}

/// A table of random bytes: what is stored is not looked at here.
fn table(random: &mut Rng, length: usize) -> Vec<u8> {
    (0..length).map(|_| random.u8(..)).collect()
}

/// Stores a table as a board does, and puts it in force.
fn put(flash: &mut SimFlash, table: &[u8]) -> Result<(), StoreError> {
    let mut tables = Tables::new(&mut *flash, START)?;
    let length = table.len() as u32;
    for (index, bytes) in table.chunks(256).enumerate() {
        let offset = 256 * index as u32;
        let whole = tables.store(&SurfacePiece { length, offset, bytes, saves: 0 })?;
        assert_eq!(whole.len(), table.len());
    }
    tables.keep(length)
}

/// The table in force.
fn in_force(flash: &mut SimFlash) -> Option<Vec<u8>> {
    let range = Tables::new(&mut *flash, START).unwrap().in_force().unwrap()?;
    Some(flash.bytes()[range.start as usize..range.end as usize].to_vec())
}

#[test]
fn the_last_table_kept_is_in_force_until_none_is() {
    let (mut flash, mut random) = (blank(), Rng::with_seed(1));
    assert_eq!(in_force(&mut flash), None);
    for length in [SURFACE_BYTES, 144, 300, SURFACE_BYTES, SURFACE_BYTES - 1, 256, 4096, 8192 + 12] {
        let next = table(&mut random, length);
        put(&mut flash, &next).unwrap();
        assert!(in_force(&mut flash) == Some(next), "{length}");
    }
    Tables::new(&mut flash, START).unwrap().keep(0).unwrap();
    assert_eq!(in_force(&mut flash), None);
    let next = table(&mut random, 999);
    put(&mut flash, &next).unwrap();
    assert!(in_force(&mut flash) == Some(next));
}

#[test]
fn power_may_fail_at_any_step_of_a_change() {
    let mut random = Rng::with_seed(2);
    for length in [700, SURFACE_BYTES] {
        let mut flash = blank();
        let (mut old, mut steps) = (None, 0);
        // Twice, so that a half that was used before is used again.
        for _ in 0..3 {
            let next = table(&mut random, length);
            put(&mut flash, &next).unwrap();
            old = Some(next);
        }
        let before = flash.clone();
        let next = table(&mut random, length);
        put(&mut flash, &next).unwrap();
        let all = flash.steps() - before.steps();
        for step in 0..all {
            for cut in [Cut::Before, Cut::Within, Cut::After] {
                let mut flash = before.clone();
                flash.cut_at(before.steps() + step, cut);
                assert!(put(&mut flash, &next).is_err(), "step {step} of {all}");
                flash.restore_power();
                let found = in_force(&mut flash);
                let is_last = step + 1 == all;
                assert!(
                    found == old || (is_last && found.as_ref() == Some(&next)),
                    "{cut:?} step {step} of {all}"
                );
                // And the next change is as good as any.
                put(&mut flash, &next).unwrap();
                assert!(in_force(&mut flash).as_ref() == Some(&next), "{cut:?} step {step} of {all}");
                steps += 1;
            }
        }
        println!("{length} bytes: {steps} power cuts");
    }
}

#[test]
fn what_does_not_fit_is_refused_and_leaves_the_table_in_force() {
    let (mut flash, mut random) = (blank(), Rng::with_seed(3));
    let old = table(&mut random, 512);
    put(&mut flash, &old).unwrap();
    let piece = |length: usize, offset: usize, bytes| SurfacePiece {
        length: length as u32,
        offset: offset as u32,
        bytes,
        saves: 0,
    };
    let mut tables = Tables::new(&mut flash, START).unwrap();
    for bad in [
        piece(SURFACE_BYTES + 1, 0, &old[..256]),
        piece(300, 256, &old[..256]),
        piece(9, usize::MAX, &[0; 9]),
    ] {
        assert_eq!(tables.store(&bad), Err(StoreError::Range));
    }
    assert!(in_force(&mut flash) == Some(old));
    assert_eq!(Tables::new(blank(), START + 1).err(), Some(StoreError::Range));
    assert_eq!(Tables::new(blank(), START + 4096).err(), Some(StoreError::Range));
}
