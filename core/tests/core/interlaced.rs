//! The order of an interlaced scan, on garments of any form.

use proptest::prelude::*;
use std::collections::BTreeMap;
use taxel_core::acquire::{Depth, Fields, Plan, Reflex, Ring, Sweep, TURN_PLACES, Unfit};
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Block, Circuit, Garment, Layout, Orientation, Pins, Place};

const PLAN: Plan = Plan { panels: u8::MAX, blocks: u64::MAX, depth: Depth::Interlaced };

fn built(garment: &Garment) -> (Layout, Circuit) {
    let layout = Layout::build(garment, 2048, 4095).unwrap();
    let circuit = Circuit::build(garment, &layout, Pins::ANY).unwrap();
    (layout, circuit)
}

/// The sub-field in which each taxel is read.
fn fields_of(circuit: &Circuit, fields: &Fields) -> BTreeMap<usize, usize> {
    let mut found = BTreeMap::new();
    let mut addresses = [0; 8];
    fields.each(circuit, &PLAN, |field, _, taxels| {
        addresses[field] += 1;
        for taxel in taxels.into_iter().flatten() {
            assert_eq!(found.insert(usize::from(taxel), field), None, "taxel {taxel} twice");
        }
    });
    assert!((0..8).all(|field| addresses[field] == fields.addresses(field)));
    found
}

/// Whether every footprint of so many rows and columns is met in every sub-field.
fn meets(layout: &Layout, found: &BTreeMap<usize, usize>, count: usize, (rows, columns): (u16, u16)) -> bool {
    (0..).zip(layout.areas()).all(|(panel, area)| {
        (0..=area.rows - rows).all(|top| {
            (0..=area.columns - columns).all(|left| {
                let at = |row, column| layout.taxel(Place { panel, row, column }).unwrap();
                let taxels = (top..top + rows).flat_map(|r| (left..left + columns).map(move |c| at(r, c)));
                taxels.fold(0u32, |seen, taxel| seen | 1 << found[&taxel]).count_ones() as usize == count
            })
        })
    })
}

#[test]
fn every_footprint_is_met_in_every_sub_field() {
    for (garment, count, addresses, footprint) in [
        (Garment::reference(), 8, 64, (3, 3)),
        (Garment::mat(), 8, 64, (3, 3)),
        (Garment::block(), 4, 16, (2, 2)),
    ] {
        let (layout, circuit) = built(&garment);
        let fields = Fields::of(&circuit, &PLAN).unwrap();
        assert_eq!((fields.count(), fields.addresses(count - 1)), (count, addresses));
        assert_eq!((fields.before(1), fields.before(8)), (addresses, count * addresses));
        let found = fields_of(&circuit, &fields);
        assert_eq!(found.len(), layout.taxels());
        assert!(meets(&layout, &found, count, footprint), "{}", garment.name);
        // One row less is not enough.
        assert!(!meets(&layout, &found, count, (footprint.0 - 1, footprint.1)), "{}", garment.name);
    }
}

#[test]
fn what_cannot_be_interlaced_is_refused() {
    let of = |garment: &Garment, plan: &Plan| Fields::of(&built(garment).1, plan).unwrap_err();
    let mut quick = Garment::block();
    quick.wiring.settle_ns = 0;
    // 64 addresses of 4 us: two halves of 128 us.
    assert_eq!(Fields::of(&built(&quick).1, &PLAN).unwrap().count(), 2);
    quick.blocks[0].rows = 3;
    quick.panels[0].rows = 3;
    assert_eq!(of(&quick, &PLAN), Unfit::Short);
    assert_eq!(Unfit::Short.to_string(), "a frame of less than 200 us is not interlaced");
    let mut many = Garment::reference();
    many.blocks[0].input = 25;
    assert_eq!(of(&many, &PLAN), Unfit::Inputs);
    assert_eq!(of(&Garment::reference(), &Plan { panels: 0, ..PLAN }), Unfit::Short);
}

/// Panels of stacked blocks, each at an input of its own, of any size, and turned any way.
fn garments() -> impl Strategy<Value = Garment> {
    let panel = (1..=8u16, 1..=4u8, 1..=16u8, any::<[bool; 3]>());
    (proptest::collection::vec(panel, 1..=4), 0..40_000u32).prop_map(|(panels, settle_ns)| {
        let mut garment = Garment::reference();
        garment.wiring.settle_ns = settle_ns;
        garment.blocks.clear();
        garment.seams.clear();
        garment.panels.truncate(panels.len());
        for (index, (count, rows, columns, [transposed, mirror_x, mirror_y])) in
            panels.into_iter().enumerate()
        {
            let orientation = Orientation { transposed, mirror_x, mirror_y };
            let [height, width] = if transposed { [columns, rows] } else { [rows, columns] }.map(u16::from);
            (garment.panels[index].rows, garment.panels[index].columns) = (count * height, width);
            for select in 0..count {
                let (row, input) = (select * height, 26 + index as u8);
                let panel = index as u8;
                let block = Block { panel, row, column: 0, rows, columns, input, select, orientation };
                garment.blocks.push(block).unwrap();
            }
        }
        garment
    })
}

/// What the converter gives at these levels on an input: another code for each taxel.
fn garment_code(circuit: &Circuit, levels: u32, input: u8) -> Code {
    let mut found = Code(0);
    for site in circuit.sites().iter().filter(|site| site.input == input) {
        for (row, column) in (0..site.rows).flat_map(|r| (0..site.columns).map(move |c| (r, c))) {
            let word = circuit.word(site.select, row, column);
            let high = circuit.lines().iter().enumerate().filter(|(bit, _)| word >> bit & 1 == 1);
            if high.map(|(_, pin)| 1u32 << pin).sum::<u32>() == levels {
                found = Code(1 + site.taxel(row, column) as u16);
            }
        }
    }
    found
}

/// A frame of an interlaced scan, put back into its order by the check.
fn interlaced(circuit: &Circuit, fields: &Fields) -> Vec<Code> {
    let mut reflex = Box::new(Reflex::<2048>::new());
    reflex.begin(fields.clone(), circuit.falling());
    let mut codes: Vec<Vec<Vec<Code>>> = vec![vec![Vec::new(); fields.inputs().len()]; fields.count()];
    fields.each(circuit, &PLAN, |field, levels, taxels| {
        reflex.order(field, codes[field][0].len(), taxels);
        for (input, codes) in fields.inputs().iter().zip(&mut codes[field]) {
            codes.push(garment_code(circuit, levels, *input));
        }
    });
    let mut frame = Box::new([Code(0); 2048]);
    for (field, codes) in codes.iter().enumerate() {
        assert_eq!(reflex.check(field, &codes.concat(), frame.as_mut_slice(), Micros(0)), 0);
    }
    frame.to_vec()
}

/// A frame of a progressive scan.
fn progressive(circuit: &Circuit) -> Option<Vec<Code>> {
    let mut sweep = Sweep::<512, 64>::new();
    sweep.fill(circuit, &PLAN).ok()?;
    let (mut frame, mut here) = (vec![Code(0); 2048], [None; 4]);
    for (address, levels) in sweep.levels().iter().enumerate() {
        match sweep.stretches().iter().find(|stretch| usize::from(stretch.first) == address) {
            Some(stretch) => here = stretch.taxels,
            None => here = here.map(|taxel| taxel.map(|taxel| taxel + 1)),
        }
        for (input, taxel) in sweep.inputs().iter().zip(here) {
            let Some(taxel) = taxel else { continue };
            frame[usize::from(taxel)] = garment_code(circuit, *levels, *input);
        }
    }
    Some(frame)
}

/// Rows and columns of a panel of the reference garment, and the time of an address there, us.
const PANEL: (usize, usize) = (32, 16);
const ADDRESS_US: f64 = 10.0;

/// Where a round touch seems to be, and how broad, that moves along the columns by `speed` taxels a frame; it
/// is at `at` in the middle of the frame. `time`: when a taxel of the first panel is read, us from the start
/// of the frame.
fn seen(time: &[f64], at: (f64, f64), speed: f64) -> (f64, f64) {
    let (mut mass, mut first, mut second) = (0.0, 0.0, 0.0);
    for (taxel, time) in time.iter().enumerate() {
        let (row, column) = ((taxel / PANEL.1) as f64, (taxel % PANEL.1) as f64);
        let x = at.1 + speed * (time / (512.0 * ADDRESS_US) - 0.5);
        let pressure = (-((row - at.0).powi(2) + (column - x).powi(2)) / 2.0).exp();
        (mass, first, second) =
            (mass + pressure, first + pressure * column, second + pressure * column * column);
    }
    (first / mass, second / mass - (first / mass).powi(2))
}

/// The skew between neighbours, as docs/concepts/reflex.md has it:
/// `cargo test -p taxel-core --test core -- skew --nocapture`.
#[test]
fn skew_of_a_moving_touch() {
    let (_, circuit) = built(&Garment::reference());
    let (mut interlaced, mut address) = (vec![0.0; 512], 0.0);
    Fields::of(&circuit, &PLAN).unwrap().each(&circuit, &PLAN, |_, _, taxels| {
        interlaced[usize::from(taxels[0].unwrap())] = address * ADDRESS_US;
        address += 1.0;
    });
    let progressive: Vec<f64> = (0..512).map(|taxel| taxel as f64 * ADDRESS_US).collect();
    let mut largest = Vec::new();
    for speed in [0.25, 0.5, 1.0] {
        let worst = |time: &[f64]| {
            let still: Vec<f64> = vec![2_560.0; 512];
            let places =
                (16..112).flat_map(|y| (20..44).map(move |x| (f64::from(y) / 4.0, f64::from(x) / 4.0)));
            places.fold((0.0f64, 0.0f64), |(place, breadth), at| {
                let ((x, variance), (still_x, still_variance)) =
                    (seen(time, at, speed), seen(&still, at, speed));
                let off = (variance / still_variance).sqrt() - 1.0;
                (place.max((x - still_x).abs()), breadth.max(off.abs()))
            })
        };
        let (row_by_row, fields) = (worst(&progressive), worst(&interlaced));
        println!(
            "{speed} taxels a frame: off by {:.3} taxels row by row, {:.3} interlaced; breadth by {:.1} % and {:.1} %",
            row_by_row.0,
            fields.0,
            100.0 * row_by_row.1,
            100.0 * fields.1
        );
        largest.push((speed, row_by_row, fields));
    }
    for (speed, row_by_row, fields) in largest {
        // Row by row a touch at an edge is read half a frame early or late; interlaced all of it around the
        // middle.
        assert!(row_by_row.0 > 0.3 * speed);
        assert!(fields.0 < 0.16 * speed, "{speed}: {fields:?}");
        assert!(fields.1 < 0.15 * speed, "{speed}: {fields:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Whatever the garment: every taxel once, in a frame that is the progressive one where there is one; and
    /// every footprint within a block of the lowest input is met in every sub-field.
    #[test]
    fn a_still_scene_is_the_same_in_both_orders(garment in garments()) {
        let (layout, circuit) = built(&garment);
        let fields = match Fields::of(&circuit, &PLAN) {
            Ok(fields) => fields,
            Err(why) => {
                prop_assert_eq!(why, Unfit::Short);
                return Ok(());
            }
        };
        let found = fields_of(&circuit, &fields);
        let frame = interlaced(&circuit, &fields);
        prop_assert!(found.keys().copied().eq(0..layout.taxels()));
        prop_assert!(frame.iter().take(layout.taxels()).map(|code| code.0).eq(1..=layout.taxels() as u16));
        prop_assert!(frame[layout.taxels()..].iter().all(|code| *code == Code(0)));
        if let Some(progressive) = progressive(&circuit) {
            prop_assert_eq!(&progressive, &frame);
        }
        let (area, side) = (&layout.areas()[0], [0, 0, 1, 0, 2, 0, 0, 0, 3][fields.count()]);
        if side > 1 && area.rows >= side && area.columns >= side && garment.panels.len() == 1 {
            prop_assert!(meets(&layout, &found, fields.count(), (side, side)));
        }
    }

    /// A frame that is put together while another is read is never put where that one is, and every frame is
    /// lent or counted.
    #[test]
    fn three_places_are_enough_where_codes_are_copied(reads in proptest::collection::vec(any::<bool>(), 1..200)) {
        let mut ring = Ring::new(Micros(0));
        let (mut places, mut filling, mut accounted) = ([0u64; TURN_PLACES], 0u8, 0u64);
        let mut reading: Option<(u8, u64)> = None;
        for (frame, read) in (1..).zip(reads) {
            places[usize::from(filling)] = frame;
            filling = ring.turn(Micros(frame));
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
        }
    }
}
