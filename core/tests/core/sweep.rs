//! The tables of a converter that never waits, and the places of its frames.

use proptest::prelude::*;
use std::collections::BTreeMap;
use taxel_core::acquire::{Lent, PLACES, Plan, Ring, SWEEP_INPUTS, Sweep, SweepStretch, Unfit};
use taxel_core::format::Micros;
use taxel_core::garment::{Circuit, Garment, Layout, Orientation, Pins};

type Full = Sweep<512, 64>;
/// Taxels read at one address, by the position of their input.
type ReadTaxels = [Option<u16>; SWEEP_INPUTS];

fn circuit(garment: &Garment) -> Circuit {
    let layout = Layout::build(garment, 2048, 4095).unwrap();
    Circuit::build(garment, &layout, Pins::ANY).unwrap()
}

/// A circuit's word, with bit `n` for GPIO `n`.
fn levels(circuit: &Circuit, word: u32) -> u32 {
    let high = circuit.lines().iter().enumerate().filter(|(bit, _)| word >> bit & 1 == 1);
    high.map(|(_, pin)| 1 << pin).sum()
}

/// By address and input, the taxel that a chain which follows the stretches stores there.
fn stored(sweep: &Full) -> Vec<ReadTaxels> {
    let mut reads = Vec::new();
    let mut here = [None; SWEEP_INPUTS];
    for address in 0..sweep.levels().len() {
        match sweep.stretches().iter().find(|s| usize::from(s.first) == address) {
            Some(stretch) => here = stretch.taxels,
            None => here = here.map(|taxel| taxel.map(|taxel| taxel + 1)),
        }
        reads.push(here);
    }
    reads
}

/// Every taxel of the plan is stored once, from its own address and input, and no other is.
fn check(garment: &Garment, plan: &Plan) -> Full {
    let circuit = circuit(garment);
    let mut sweep = Full::new();
    sweep.fill(&circuit, plan).unwrap();
    let mut found = BTreeMap::new();
    for (levels, reads) in sweep.levels().iter().zip(stored(&sweep)) {
        for (position, taxel) in reads.iter().enumerate() {
            let Some(taxel) = taxel else { continue };
            let before = found.insert(usize::from(*taxel), (*levels, sweep.inputs()[position]));
            assert_eq!(before, None, "taxel {taxel} twice");
        }
    }
    for site in circuit.sites().iter().filter(|s| plan.reads(s.panel, s.block)) {
        for row in 0..site.rows {
            for column in 0..site.columns {
                let word = circuit.word(site.select, row, column);
                let from = found.remove(&site.taxel(row, column));
                assert_eq!(from, Some((levels(&circuit, word), site.input)));
            }
        }
    }
    assert!(found.is_empty(), "{found:?}");
    sweep
}

#[test]
fn the_reference_garment_is_one_stretch_in_two_halves() {
    let sweep = check(&Garment::reference(), &Plan::default());
    assert_eq!((sweep.inputs(), sweep.levels().len()), (&[26, 27, 28, 29][..], 512));
    let first = SweepStretch { first: 0, taxels: [Some(0), Some(512), Some(1024), Some(1536)] };
    let second = SweepStretch { first: 256, taxels: first.taxels.map(|t| t.map(|taxel| taxel + 256)) };
    assert_eq!(sweep.stretches(), [first, second]);
    // Select 7, row 3, column 15: all nine lines high.
    assert_eq!(sweep.levels().last(), Some(&0b1_1111_1100_1100));
}

#[test]
fn a_plan_narrows_the_sweep_in_proportion() {
    let reference = Garment::reference();
    let back = check(&reference, &Plan { panels: 0b0010, ..Plan::default() });
    assert_eq!((back.inputs(), back.levels().len()), (&[27][..], 512));
    // Blocks 1 and 4 of the chest, block 4 of the right arm.
    let blocks = Plan { blocks: 0b10010 | 1 << 28, ..Plan::default() };
    let some = check(&reference, &blocks);
    assert_eq!((some.inputs(), some.levels().len()), (&[26, 29][..], 2 * 64));
    assert_eq!(some.stretches().len(), 4 + 1, "each row of block 1, which one input reads, then block 4");
    assert_eq!(Full::new().fill(&circuit(&reference), &Plan { panels: 0, ..blocks }), Err(Unfit::Small));
}

#[test]
fn other_wirings() {
    assert_eq!(check(&Garment::block(), &Plan::default()).stretches().len(), 2);
    // Rows of two blocks beside each other: 32 rows, three of which go on where the one before ended.
    assert_eq!(check(&Garment::mat(), &Plan::default()).stretches().len(), 29);
    for (transposed, mirror_x, mirror_y) in (0..8).map(|bits| (bits & 1 != 0, bits & 2 != 0, bits & 4 != 0)) {
        let mut garment = Garment::block();
        let block = &mut garment.blocks[0];
        block.orientation = Orientation { transposed, mirror_x, mirror_y };
        if transposed {
            (garment.panels[0].rows, garment.panels[0].columns) = (16, 4);
        }
        check(&garment, &Plan::default());
    }
}

#[test]
fn inverted_lines_and_blocks_of_different_size() {
    let mut garment = Garment::reference();
    garment.wiring.row.lines[0].inverted = true;
    garment.blocks.retain(|b| b.input != 29);
    garment.panels.truncate(3);
    garment.panels[2].rows = 30;
    garment.blocks.last_mut().unwrap().rows = 2;
    let sweep = check(&garment, &Plan::default());
    assert_eq!(sweep.levels()[0], 1 << 7);
    assert_eq!(sweep.levels().len(), 512);
}

#[test]
fn what_does_not_fit_is_refused() {
    let reference = circuit(&Garment::reference());
    let plan = Plan::default();
    assert_eq!(Sweep::<511, 64>::new().fill(&reference, &plan), Err(Unfit::Addresses(511)));
    assert_eq!(Sweep::<512, 1>::new().fill(&reference, &plan), Err(Unfit::Stretches(1)));
    let mut mirrored = Garment::reference();
    mirrored.blocks.iter_mut().filter(|b| b.panel == 3).for_each(|b| b.orientation.mirror_x = true);
    assert_eq!(Full::new().fill(&circuit(&mirrored), &plan), Err(Unfit::Stretches(64)));
    let mut far = Garment::reference();
    far.wiring.row.lines[0].pin = 40;
    assert_eq!(Full::new().fill(&circuit(&far), &plan), Err(Unfit::Line(40)));
    assert_eq!(Unfit::Stretches(64).to_string(), "the taxels jump more than 64 times");
    let mut many = Garment::reference();
    many.blocks[0].input = 25;
    assert_eq!(Full::new().fill(&circuit(&many), &plan), Err(Unfit::Inputs));
}

#[test]
fn a_reader_in_time_gets_every_frame() {
    let mut ring = Ring::new(Micros(100));
    assert_eq!(ring.lend(), None);
    let mut place = 0;
    for frame in 0..10u64 {
        let next = ring.next();
        ring.complete(Micros(200 + 50 * frame));
        let lent = ring.lend().unwrap();
        let (start, duration_us) = if frame == 0 { (100, 100) } else { (150 + 50 * frame, 50) };
        assert_eq!(lent, Lent { place, start: Micros(start), duration_us, missed: 0 });
        assert_eq!(ring.lend(), None);
        place = next;
    }
}

proptest! {
    /// A frame is lent as it was filled, newest first, whatever the reader does; every frame is lent or
    /// counted.
    #[test]
    fn nothing_is_overwritten_while_it_is_read(reads in proptest::collection::vec(any::<bool>(), 1..200)) {
        let mut ring = Ring::new(Micros(0));
        let mut places = [0u64; PLACES];
        let (mut frame, mut filling, mut next) = (1u64, 0u8, ring.next());
        let mut reading: Option<(u8, u64)> = None;
        let mut accounted = 0;
        for read in reads {
            // The converter has filled this place and, before anyone can react, begins the next.
            places[usize::from(filling)] = frame;
            filling = next;
            places[usize::from(filling)] = u64::MAX;
            ring.complete(Micros(frame));
            next = ring.next();
            if let Some((place, held)) = reading {
                prop_assert_eq!(places[usize::from(place)], held);
            }
            if read {
                let lent = ring.lend().unwrap();
                prop_assert_eq!(places[usize::from(lent.place)], frame);
                accounted += 1 + u64::from(lent.missed);
                prop_assert_eq!(accounted, frame);
                reading = Some((lent.place, frame));
            }
            frame += 1;
        }
    }
}
