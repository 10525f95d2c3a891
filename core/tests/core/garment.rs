//! What a garment is refused for, in the words of its author; and how coordinates cross a seam.

use taxel_core::garment::{
    Absent, Block, Circuit, Coding, Garment, Layout, Line, Orientation, Pins, Place, Seam, SeamEdge, Side,
};

/// Why the garment is refused after `edit`.
fn refused(mut garment: Garment, edit: impl Fn(&mut Garment)) -> String {
    edit(&mut garment);
    let layout = match Layout::build(&garment, 2048, 4095) {
        Ok(layout) => layout,
        Err(error) => return error.to_string(),
    };
    Circuit::build(&garment, &layout, Pins::FEATHER).expect_err("it is refused").to_string()
}

#[test]
fn what_cannot_be_is_named() {
    let block = |edit: fn(&mut Garment)| refused(Garment::block(), edit);
    let whole = |edit: fn(&mut Garment)| refused(Garment::reference(), edit);
    let cases = [
        (block(|g| g.panels.clear()), "panels: the garment has none"),
        (block(|g| g.panels[0].rows = 0), "panel mat: rows and columns must be at least 1"),
        (whole(|g| g.panels[1].name = g.panels[0].name.clone()), "panel chest: the name is used twice"),
        (whole(|g| g.panels[3].rows = 33), "panels: 2064 taxels, but only 2048 fit"),
        (block(|g| g.blocks[0].panel = 1), "block 0: there is no panel 1"),
        (whole(|g| g.seams[0].b.panel = 9), "seam 0: there is no panel 9"),
        (whole(|g| g.seams[1].length = 33), "seam 1: it is empty or leaves the Left side of panel chest"),
        (block(|g| g.blocks[0].column = 1), "block 0: it is empty or leaves panel mat"),
        (block(|g| g.blocks[0].rows = 0), "block 0: it is empty or leaves panel mat"),
        (whole(|g| g.blocks[1].row = 3), "blocks 0 and 1: they cover the same taxel"),
        (whole(|g| _ = g.blocks.remove(9)), "panel back: row 4, column 0 lies in no block and is not absent"),
        (whole(|g| g.blocks[1].select = 0), "blocks 0 and 1: same select code on the same input"),
        (
            whole(|g| g.blocks[7].select = 8),
            "block 7: block code 8 does not fit the 8 codes of the block lines",
        ),
        (
            block(|g| _ = g.wiring.row.lines.pop()),
            "block 0: row code 3 does not fit the 3 codes of the row lines",
        ),
        (
            block(|g| _ = g.wiring.column.lines.pop()),
            "block 0: column code 15 does not fit the 8 codes of the column lines",
        ),
        (block(|g| g.wiring.row.lines[1].pin = 12), "wiring: pin 12 is used twice"),
        (
            block(|g| g.wiring.row.lines[1].pin = 13),
            "wiring: pin 13 is no free output of this board: the heartbeat LED is there",
        ),
        (
            block(|g| g.wiring.row.lines[1].pin = 40),
            "wiring: pin 40 is no free output of this board: the chip ends at GP29",
        ),
        (
            block(|g| g.blocks[0].input = 25),
            "block 0: input 25 is no converter input of this board, which has GP26 to GP29",
        ),
        (block(|g| g.name.clear()), "name: the garment has none"),
        (whole(|g| g.panels[2].region.clear()), "panel 2: its region is empty"),
        (
            block(|g| g.panels[0].pitch_um = [10, 10]),
            "panel mat: pitch_um is 10, outside 500 to 200000: did you mean 10000?",
        ),
        (
            block(|g| g.panels[0].pitch_um = [10_000, 400_000_000]),
            "panel mat: pitch_um is 400000000, outside 500 to 200000",
        ),
        (
            block(|g| g.panels[0].pitch_um = [0, 10_000]),
            "panel mat: pitch_um is 0 along one axis: it is known along both or none",
        ),
        (whole(|g| g.seams[0].b = g.seams[0].a), "seam 0: it sews taxels of a panel to themselves"),
    ];
    for (said, expected) in cases {
        assert_eq!(said, expected);
    }
    let gap = Absent { panel: 0, row: 3, column: 15, rows: 2, columns: 1 };
    let said = refused(Garment::block(), |g| _ = g.absent.push(gap));
    assert_eq!(said, "absent 0: it is empty or leaves panel mat");
}

#[test]
fn the_largest_exact_panel_is_taken_and_the_next_refused() {
    // (4095 N)^2 (w^2 + h^2 - 2) / 12 < 2^64.
    let exact = |rows: u16, columns: u16| {
        let taxels = u128::from(rows) * u128::from(columns);
        let (w, h) = (u128::from(columns), u128::from(rows));
        (4095 * taxels).pow(2) * (w * w + h * h - 2) / 12 < 1 << 64
    };
    let built = |rows, columns| Layout::build(&Garment::recorded(rows, columns), 65_535, 4095).is_ok();
    let mut taken = 0;
    for (rows, columns) in [(64, 32), (56, 40), (1, 2048), (2, 1024), (128, 64), (100, 100), (255, 257)] {
        assert_eq!(built(rows, columns), exact(rows, columns), "{rows} x {columns}");
        taken += usize::from(built(rows, columns));
    }
    assert!((3..7).contains(&taken), "both happen");
    let last = (64..200).take_while(|n| built(*n, *n)).last().expect("64 x 64 is exact");
    assert!(exact(last, last) && !exact(last + 1, last + 1));
}

#[test]
fn absent_taxels_need_no_block() {
    let mut garment = Garment::reference();
    garment.blocks.remove(9);
    garment.absent.push(Absent { panel: 1, row: 4, column: 0, rows: 4, columns: 16 }).expect("there is room");
    let layout = Layout::build(&garment, 2048, 4095).expect("it is checked");
    Circuit::build(&garment, &layout, Pins::FEATHER).expect("the gap needs no block");
    assert!(layout.is_absent(1, 4, 0) && layout.is_absent(1, 7, 15) && !layout.is_absent(1, 8, 0));
    for taxel in 0..layout.taxels() {
        let place = layout.place(taxel).expect("every taxel has a place");
        assert_eq!(layout.taxel(place), Some(taxel));
    }
    assert_eq!(layout.place(2048), None);
    assert_eq!(layout.taxel(Place { panel: 0, row: 32, column: 0 }), None);
}

#[test]
fn a_turned_block_reads_every_taxel_once() {
    for turn in 0..8u8 {
        let orientation =
            Orientation { transposed: turn & 1 > 0, mirror_x: turn & 2 > 0, mirror_y: turn & 4 > 0 };
        let mut garment = Garment::block();
        (garment.panels[0].rows, garment.panels[0].columns) =
            if orientation.transposed { (16, 4) } else { (4, 16) };
        garment.blocks[0] = Block { orientation, ..garment.blocks[0].clone() };
        let layout = Layout::build(&garment, 64, 4095).expect("it is checked");
        let circuit = Circuit::build(&garment, &layout, Pins::FEATHER).expect("it is checked");
        let site = circuit.sites()[0];
        let mut read: Vec<usize> = (0..64).map(|k| site.taxel(k / 16, k % 16)).collect();
        read.sort_unstable();
        assert!(read.into_iter().eq(0..64), "{orientation:?}");
    }
}

#[test]
fn words_of_binary_and_one_hot_lines_with_their_polarity() {
    let mut garment = Garment::block();
    garment.wiring.row.coding = Coding::OneHot;
    garment.wiring.row.lines[0].inverted = true;
    garment.wiring.enable.push(Line { pin: 18, inverted: true }).expect("there is room");
    let layout = Layout::build(&garment, 64, 4095).expect("it is checked");
    let circuit = Circuit::build(&garment, &layout, Pins::FEATHER).expect("it is checked");
    assert_eq!(circuit.lines(), [2, 3, 6, 7, 9, 10, 11, 12, 18]);
    assert_eq!(circuit.idle_word(), 0b1_0000_0001);
    // The inverted enable is low while asserted; row 0 is low while chosen.
    assert_eq!(circuit.word(0, 0, 0b0101), 0b0_0101_0000);
    assert_eq!(circuit.word(0, 2, 0b1000), 0b0_1000_0101);
}

#[test]
fn thirty_two_lines_may_select_blocks_and_rows_alone() {
    let lines = |pins: std::ops::Range<u8>| pins.map(|pin| Line { pin, inverted: false }).collect();
    let mut garment = Garment::block();
    (garment.panels[0].columns, garment.blocks[0].columns) = (1, 1);
    garment.wiring.block.lines = lines(0..16);
    garment.wiring.row.lines = lines(32..48);
    garment.wiring.column.lines.clear();
    let layout = Layout::build(&garment, 4, 4095).expect("it is checked");
    let circuit = Circuit::build(&garment, &layout, Pins::ANY).expect("it is checked");
    assert_eq!(circuit.lines().len(), 32);
    assert_eq!((circuit.idle_word(), circuit.word(0x8001, 3, 0)), (0, 0x0008_8001));
    garment.wiring.enable.push(Line { pin: 50, inverted: false }).expect("there is room");
    assert!(Circuit::build(&garment, &layout, Pins::ANY).is_err());
}

#[test]
fn a_seam_maps_neighbours_onto_each_other() {
    let sides = [Side::Left, Side::Right, Side::Top, Side::Bottom];
    for (a, b) in sides.into_iter().flat_map(|a| sides.map(|b| (a, b))) {
        for reversed in [false, true] {
            let mut garment = Garment::reference();
            garment.seams.clear();
            let edge = |panel, side| SeamEdge { panel, side, start: 2 };
            let seam = Seam { a: edge(0, a), b: edge(1, b), length: 9, reversed };
            garment.seams.push(seam).expect("there is room");
            let layout = Layout::build(&garment, 2048, 4095).expect("it is checked");
            let joint = &layout.joints()[0];
            let pairs: Vec<_> = joint.neighbours().collect();
            assert_eq!(pairs.len(), 9 * 3 - 2);
            for ((ax, ay), (bx, by)) in pairs {
                let (x, y) = joint.b_to_a.apply(bx.into(), by.into(), 1);
                let (dx, dy) = ((x - i64::from(ax)).abs(), (y - i64::from(ay)).abs());
                assert_eq!(dx.max(dy), 1, "{a:?} {b:?}: neighbours across the seam touch, and none coincide");
                let inside = |x: i32, y: i32| (0..16).contains(&x) && (0..32).contains(&y);
                assert!(inside(ax, ay) && inside(bx, by));
                let back = joint.b_to_a.inverse().apply(x, y, 1);
                assert_eq!(back, (bx.into(), by.into()));
                assert_eq!(joint.b_to_a.after(&joint.b_to_a.inverse()).apply(x, y, 1), (x, y));
            }
        }
    }
}
