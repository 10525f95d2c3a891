//! Contacts that are hard to get right: nothing, everything, spirals, seams, more than fit.

use taxel_core::condition::{Image, Rows};
use taxel_core::contact::{Contact, ContactConfig, ContactState, Contacts, Moments, Phase, Touches};
use taxel_core::format::{Fixed16, Micros};
use taxel_core::garment::{Edge, Garment, Layout, Place, Rect, Seam, Side};

type State = ContactState<16, 1024>;

/// A garment, its image and the stage, at 195 frames/s.
struct Rig {
    layout: Layout,
    values: Vec<u16>,
    stage: Contacts,
    state: Box<State>,
    now: u64,
}

/// What one frame gave.
struct Frame {
    present: Vec<Contact>,
    moments: Vec<Moments>,
    released: Vec<Contact>,
    dropped: u16,
    overflow: u16,
}

impl Rig {
    fn new(garment: &Garment) -> Rig {
        let layout = Layout::build(garment, 2048, u16::MAX).unwrap();
        Rig {
            values: vec![0; layout.taxels()],
            stage: ContactConfig::default().build().unwrap(),
            state: Box::default(),
            now: 1_000_000,
            layout,
        }
    }

    fn mat() -> Rig {
        Rig::new(&Garment::mat())
    }

    fn clear(&mut self) -> &mut Rig {
        self.values.fill(0);
        self
    }

    fn set(&mut self, panel: u8, row: u16, column: u16, value: u16) -> &mut Rig {
        let taxel = self.layout.taxel(Place { panel, row, column }).expect("on the panel");
        self.values[taxel] = value;
        self
    }

    /// Fills a rectangle of panel 0: rows and columns, last included.
    fn fill(&mut self, [top, bottom]: [u16; 2], [left, right]: [u16; 2], value: u16) -> &mut Rig {
        for (row, column) in (top..=bottom).flat_map(|row| (left..=right).map(move |c| (row, c))) {
            self.set(0, row, column, value);
        }
        self
    }

    /// Fills a piece of a row.
    fn bar(&mut self, panel: u8, row: u16, columns: std::ops::Range<u16>, value: u16) {
        for column in columns {
            self.set(panel, row, column, value);
        }
    }

    /// Sets what `inside(x, y)` says on panel 0.
    fn draw(&mut self, inside: impl Fn(i32, i32) -> bool, value: u16) -> &mut Rig {
        let (rows, columns) = (self.layout.areas()[0].rows, self.layout.areas()[0].columns);
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |c| (row, c))) {
            if inside(column.into(), row.into()) {
                self.set(0, row, column, value);
            }
        }
        self
    }

    fn frame(&mut self) -> Frame {
        self.now += 5128;
        let rows = Rows::of(&self.layout, &self.values);
        let image = Image { values: &self.values, rows: &rows };
        let touches = self.stage.process(&mut self.state, &self.layout, &image, Micros(self.now));
        let Touches { present, moments, released, dropped, overflow } = touches;
        assert_eq!(present.len(), moments.len());
        for (contact, moments) in present.iter().zip(moments) {
            assert_eq!(u64::from(contact.total), moments.m);
        }
        Frame {
            present: present.to_vec(),
            moments: moments.to_vec(),
            released: released.to_vec(),
            dropped,
            overflow,
        }
    }

    fn only(&mut self) -> Contact {
        let frame = self.frame();
        assert_eq!((frame.present.len(), frame.dropped, frame.overflow), (1, 0, 0));
        frame.present[0].clone()
    }
}

fn taxels(value: f64) -> Fixed16 {
    Fixed16((value * 65536.0).round() as i32)
}

#[test]
fn no_taxel() {
    let mut rig = Rig::mat();
    let frame = rig.frame();
    assert!(frame.present.is_empty() && frame.released.is_empty());
    // Below the high threshold nothing begins.
    rig.fill([3, 5], [3, 5], 119);
    assert!(rig.frame().present.is_empty());
}

#[test]
fn one_taxel() {
    let mut rig = Rig::mat();
    let contact = rig.set(0, 20, 7, 1000).only();
    assert_eq!((contact.id, contact.phase, contact.panel), (1, Phase::Onset, 0));
    assert_eq!((contact.total, contact.peak, contact.area, contact.perimeter), (1000, 1000, 1, 1));
    assert_eq!(contact.peak_at, Place { panel: 0, row: 20, column: 7 });
    assert_eq!(contact.bounds, Rect { panel: 0, top: 20, bottom: 20, left: 7, right: 7 });
    assert_eq!((contact.x, contact.y), (taxels(7.0), taxels(20.0)));
    assert_eq!((contact.azimuth, contact.anisotropy.0, contact.breadth), (None, 0, 100));
    assert_eq!(contact.edge, 0, "symmetric");
    // Weaker than high, it is still the same contact; below low it is gone, and told once.
    let contact = rig.set(0, 20, 7, 60).only();
    assert_eq!((contact.id, contact.phase, contact.peak_total), (1, Phase::Held, 1000));
    let frame = rig.set(0, 20, 7, 59).frame();
    assert_eq!((frame.present.len(), frame.released.len()), (0, 1));
    let gone = &frame.released[0];
    assert_eq!((gone.id, gone.phase, gone.total, gone.peak_total), (1, Phase::Released, 0, 1000));
    assert_eq!(gone.duration_ms, 10);
    assert!(rig.frame().released.is_empty());
    assert_eq!(rig.set(0, 20, 7, 1000).only().id, 2);
}

#[test]
fn two_taxels() {
    let mut rig = Rig::mat();
    let contact = rig.set(0, 20, 7, 1000).set(0, 21, 8, 500).only();
    assert_eq!((contact.area, contact.x, contact.y), (2, taxels(7.0 + 1.0 / 3.0), taxels(20.0 + 1.0 / 3.0)));
    let azimuth = contact.azimuth.unwrap().to_radians().to_degrees();
    assert!((azimuth - 45.0).abs() < 1e-3);
    // Apart by one: two contacts.
    rig.clear().set(0, 20, 7, 1000).set(0, 22, 7, 500);
    assert_eq!(rig.frame().present.len(), 2);
}

#[test]
fn corners() {
    let mut rig = Rig::mat();
    for (row, column) in [(0, 0), (0, 31), (63, 0), (63, 31)] {
        rig.set(0, row, column, 4095);
    }
    let frame = rig.frame();
    let at: Vec<_> = frame.present.iter().map(|c| (c.y.to_f64(), c.x.to_f64())).collect();
    assert_eq!(at, [(0.0, 0.0), (0.0, 31.0), (63.0, 0.0), (63.0, 31.0)]);
}

#[test]
fn all_saturated() {
    for value in [4095, u16::MAX] {
        let mut rig = Rig::mat();
        let contact = rig.draw(|_, _| true, value).only();
        assert_eq!(contact.total, 2048 * u32::from(value));
        assert_eq!((contact.area, contact.perimeter), (2048, 2 * 64 + 2 * 30));
        assert_eq!((contact.x, contact.y), (taxels(15.5), taxels(31.5)));
        assert_eq!(contact.azimuth.map(|a| a.0), Some((1 << 30) - 1), "along y, to the last step");
        // 32 taxels of 10 mm, exactly: the pixel is part of the strip.
        assert_eq!(contact.breadth, 3200);
        let moments = rig.frame().moments[0];
        assert_eq!(moments, Moments::of_image(&rig.values, 32));
        let f = u128::from(value);
        assert_eq!(u128::from(moments.jm()), f * f * 2048 * 2048 * (64 * 64 + 32 * 32 - 2) / 12);
    }
}

#[test]
fn checkerboard_of_dots() {
    let mut rig = Rig::mat();
    rig.draw(|x, y| x % 2 == 0 && y % 2 == 0, 1000).set(0, 62, 30, 2000);
    let frame = rig.frame();
    assert_eq!((frame.present.len(), frame.dropped, frame.overflow), (16, 496, 0));
    // The greatest is kept, and among equals the first.
    assert!(frame.present.iter().any(|c| c.total == 2000));
    assert_eq!((frame.present[0].x, frame.present[0].y), (taxels(0.0), taxels(0.0)));
    // Which ones are kept does not flicker.
    let ids: Vec<u32> = frame.present.iter().map(|c| c.id).collect();
    let again = rig.frame();
    assert_eq!(again.present.iter().map(|c| c.id).collect::<Vec<_>>(), ids);
    assert!(again.present.iter().all(|c| c.phase == Phase::Held));
    // A full checkerboard is one contact through its corners: as many runs as there can be.
    rig.clear().draw(|x, y| (x + y) % 2 == 0, 1000);
    let contact = rig.only();
    assert_eq!((contact.area, contact.total), (1024, 1_024_000));
}

#[test]
fn too_many_runs_are_counted() {
    let layout = Layout::build(&Garment::mat(), 2048, u16::MAX).unwrap();
    let values: Vec<u16> = (0..2048).map(|i| if i % 2 == 0 && i / 32 % 2 == 0 { 500 } else { 0 }).collect();
    let mut state: ContactState<4, 100> = ContactState::new();
    let stage = ContactConfig::default().build().unwrap();
    let image = Image { values: &values, rows: &Rows::ALL };
    let touches = stage.process(&mut state, &layout, &image, Micros(0));
    assert_eq!((touches.present.len(), touches.dropped, touches.overflow), (4, 96, 412));
}

#[test]
fn comb_spiral_diagonal_ring() {
    // Teeth that meet only in the last row.
    let contact = Rig::mat().draw(|x, y| x % 2 == 0 || y == 63, 300).only();
    assert_eq!(contact.area, 16 * 64 + 16);
    // Teeth upwards and downwards, not touching.
    let mut rig = Rig::mat();
    rig.draw(|x, y| (x % 4 == 0 && y < 62) || y == 0, 300).draw(|x, y| (x % 4 == 2 && y > 1) || y == 63, 301);
    assert_eq!(rig.frame().present.len(), 2);
    // A square spiral, one taxel wide.
    let mut rig = Rig::mat();
    let area = draw_spiral(&mut rig);
    let contact = rig.only();
    assert_eq!(contact.area, area);
    assert_eq!(contact.perimeter, area);
    // Diagonals, which hang together by corners only.
    let down = Rig::mat().draw(|x, y| x == y, 300).only();
    let up = Rig::mat().draw(|x, y| x + y == 31, 300).only();
    let degrees = |c: &Contact| c.azimuth.unwrap().to_radians().to_degrees();
    assert!((degrees(&down) - 45.0).abs() < 1e-3 && (degrees(&up) + 45.0).abs() < 1e-3);
    assert_eq!((down.area, down.anisotropy.0, up.area), (32, 32768, 32));
    // A ring: the centroid lies where nothing touches, and there is no direction.
    let mut rig = Rig::mat();
    rig.draw(|x, y| (8..12).contains(&((x - 15).pow(2) + (y - 30).pow(2)).isqrt()), 300);
    let ring = rig.only();
    assert_eq!((ring.x, ring.y, ring.azimuth), (taxels(15.0), taxels(30.0), None));
    // Inside it a dot of its own.
    assert_eq!(rig.set(0, 30, 15, 900).frame().present.len(), 2);
}

/// Draws a spiral with one free taxel between its turns; its number of taxels.
fn draw_spiral(rig: &mut Rig) -> u16 {
    let (mut x, mut y, mut dx, mut dy) = (0i32, 0i32, 1i32, 0i32);
    let mut cells = vec![[false; 32]; 64];
    let free = |cells: &Vec<[bool; 32]>, x: i32, y: i32| {
        !(0..32).contains(&x) || !(0..64).contains(&y) || !cells[y as usize][x as usize]
    };
    let mut area = 0;
    let mut turned = 0;
    while turned < 2 {
        if !cells[y as usize][x as usize] {
            cells[y as usize][x as usize] = true;
            rig.set(0, y as u16, x as u16, 300);
            area += 1;
        }
        let (nx, ny) = (x + dx, y + dy);
        let on = (0..32).contains(&nx) && (0..64).contains(&ny) && free(&cells, nx, ny);
        if on && free(&cells, nx + dx, ny + dy) {
            (x, y, turned) = (nx, ny, 0);
        } else {
            (dx, dy) = (-dy, dx);
            turned += 1;
        }
    }
    area
}

#[test]
fn translation_is_exact() {
    let shape = [[300u16, 900, 0], [4095, 4095, 700], [0, 61, 60]];
    let mut rig = Rig::mat();
    let mut first: Option<Contact> = None;
    for (top, left) in [(0, 0), (7, 3), (61, 29), (30, 29), (61, 0)] {
        rig.clear();
        for (row, values) in (top..).zip(shape) {
            for (column, value) in (left..).zip(values) {
                rig.set(0, row, column, value);
            }
        }
        *rig.state = ContactState::default();
        let contact = rig.only();
        let Some(first) = &first else {
            first = Some(contact);
            continue;
        };
        let moved = (contact.x.0 - first.x.0, contact.y.0 - first.y.0);
        assert_eq!(moved, (i32::from(left) << 16, i32::from(top) << 16));
        assert_eq!((contact.azimuth, contact.anisotropy), (first.azimuth, first.anisotropy));
        assert_eq!((contact.breadth, contact.total, contact.area), (first.breadth, first.total, first.area));
    }
}

#[test]
fn across_the_seam_it_is_one() {
    // The chest's right side is sewn to the back's left side. A bar of 8 x 2 slides over, half a column at a time.
    let mut rig = Rig::new(&Garment::reference());
    let mut way = Vec::new();
    for step in 0..=24 {
        rig.clear();
        for column in step..step + 8 {
            for row in 10..12 {
                if column < 16 {
                    rig.set(0, row, column, 1000)
                } else {
                    rig.set(1, row, column - 16, 1000)
                };
            }
        }
        let contact = rig.only();
        assert_eq!((contact.id, contact.total, contact.area), (1, 16_000, 16), "step {step}");
        let across = 16 * i32::from(contact.panel == 1);
        assert_eq!(contact.x.0 + (across << 16), i32::from(step * 2 + 7) << 15, "step {step}");
        assert_eq!((contact.y, contact.breadth), (taxels(10.5), 200));
        assert_eq!(contact.dx.0, i32::from(step) << 16);
        way.push(contact.panel);
    }
    assert_eq!(way.iter().filter(|p| **p == 0).count(), 13, "home is where most of it is");
    // 1 column in 5.128 ms is 195 columns per second, and the smoothing knows it by now.
    let contact = rig.frame().present[0].clone();
    assert!(contact.vx.to_f64() > 150.0 && contact.slip);
}

#[test]
fn both_sides_of_the_seam_are_fed_back() {
    let mut rig = Rig::new(&Garment::reference());
    rig.set(0, 5, 15, 800).set(1, 6, 0, 700).only();
    let feedback = rig.state.feedback();
    assert!(feedback.holds(0, 4, 14) && feedback.holds(1, 7, 1));
    assert!(!feedback.holds(1, 5, 14) && !feedback.holds(2, 5, 15));
    // Not neighbours across the seam: two rows apart.
    rig.clear().set(0, 5, 15, 800).set(1, 7, 0, 700);
    assert_eq!(rig.frame().present.len(), 2);
}

#[test]
fn a_hug_and_a_belt() {
    // From the chest around both flanks: three parts, each carried over its own seam.
    let mut rig = Rig::new(&Garment::reference());
    for row in 3..5 {
        rig.bar(0, row, 0..16, 500);
        rig.set(1, row, 0, 500).set(1, row, 1, 500).set(1, row, 14, 500).set(1, row, 15, 500);
    }
    let contact = rig.only();
    assert_eq!((contact.panel, contact.total, contact.area), (0, 20_000, 40));
    assert_eq!((contact.x, contact.y), (taxels(7.5), taxels(3.5)), "-2 to 17");
    // Closed around the body: one contact, cut where the second seam would close it.
    for row in 3..5 {
        rig.bar(1, row, 0..16, 500);
    }
    let contact = rig.only();
    assert_eq!((contact.panel, contact.total, contact.id), (0, 32_000, 1));
    assert_eq!((contact.x, contact.y), (taxels(15.5), taxels(3.5)), "0 to 31");
}

#[test]
fn a_sleeve_closes_on_itself() {
    let mut garment = Garment::recorded(20, 12);
    let edge = |side| Edge { panel: 0, side, start: 0 };
    let seam = Seam { a: edge(Side::Right), b: edge(Side::Left), length: 20, reversed: false };
    garment.seams.push(seam).unwrap();
    let mut rig = Rig::new(&garment);
    for step in 0..24u16 {
        rig.clear();
        for i in 0..4 {
            rig.set(0, 9, (step + i) % 12, 700);
        }
        let contact = rig.only();
        assert_eq!((contact.id, contact.total, contact.anisotropy.0), (1, 2800, 32768), "step {step}");
        assert_eq!(contact.dx.0, i32::from(step) << 16, "step {step}");
    }
}

#[test]
fn more_than_fit() {
    let mut rig = Rig::mat();
    for i in 0..20u16 {
        rig.set(0, 3 * i, 5, 1000 + 10 * i);
    }
    let frame = rig.frame();
    assert_eq!((frame.present.len(), frame.dropped), (16, 4));
    assert!(frame.present.iter().all(|c| c.total >= 1040));
}

#[test]
fn identity_survives_motion_merging_and_splitting() {
    let mut rig = Rig::mat();
    rig.fill([10, 12], [2, 4], 800).frame();
    rig.fill([10, 13], [20, 23], 900);
    let ids = |frame: &Frame| frame.present.iter().map(|c| c.id).collect::<Vec<_>>();
    assert_eq!(ids(&rig.frame()), [1, 2]);
    // The old small one walks into the young large one.
    for left in 3..=16 {
        rig.clear().fill([10, 13], [20, 23], 900).fill([10, 12], [left, left + 2], 800);
        assert_eq!(ids(&rig.frame()), [1, 2], "{left}");
    }
    let frame = rig.clear().fill([10, 13], [20, 23], 900).fill([10, 12], [17, 19], 800).frame();
    assert_eq!((ids(&frame), frame.released.len()), (vec![1], 1), "the older one survives");
    assert_eq!(frame.released[0].id, 2);
    // And apart again: one keeps the id, the other is new.
    let frame = rig.clear().fill([10, 13], [20, 23], 900).fill([10, 12], [16, 18], 800).frame();
    assert_eq!(ids(&frame), [1, 3]);
    assert_eq!(frame.present[0].x.to_f64(), 21.5, "the nearest part of what it was");
}

#[test]
fn speed_and_slip() {
    let mut rig = Rig::mat();
    // A still finger with noise of +-3 counts never slips.
    let mut state = 1u32;
    for _ in 0..2000 {
        for (row, column) in [(8, 8), (8, 9), (9, 8), (9, 9)] {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            rig.set(0, row, column, 1000 - 3 + (state >> 24) as u16 % 7);
        }
        let contact = rig.only();
        assert!(!contact.slip && contact.vx.to_f64().hypot(contact.vy.to_f64()) < 0.3);
    }
    // Ten taxels per second: 0.05128 of a column in each frame, by sharing the pressure of two columns.
    let mut slips = 0;
    for frame in 0..195 {
        let at = 8.0 + f64::from(frame) * 0.05128;
        let (column, part) = (at.floor() as u16, (at.fract() * 1000.0) as u16);
        rig.clear().fill([8, 9], [column, column], 1000 - part).fill([8, 9], [column + 1, column + 1], 1000);
        rig.fill([8, 9], [column + 2, column + 2], part);
        let contact = rig.only();
        slips += usize::from(contact.slip);
        if frame > 100 {
            assert!((contact.vx.to_f64() - 10.0).abs() < 1.5, "{}", contact.vx.to_f64());
            assert!(contact.slip);
        }
    }
    assert!(slips > 170, "{slips}");
    assert!((rig.only().dx.to_f64() - 9.95).abs() < 0.1);
}

#[test]
fn a_drop_out_of_any_size_does_not_panic() {
    // An image shorter than the layout, and none at all.
    let mut rig = Rig::mat();
    rig.fill([0, 63], [0, 31], 900).frame();
    let stage = ContactConfig::default().build().unwrap();
    for length in [0, 1, 31, 33, 2047] {
        let image = Image { values: &rig.values[..length], rows: &Rows::ALL };
        let touches = stage.process(&mut rig.state, &rig.layout, &image, Micros(0));
        let total: u32 = touches.present.iter().map(|c| c.total).sum();
        assert_eq!(total, 900 * length as u32);
    }
}

/// Sums of a component in its own panel coordinates: area, total, peak, contour.
type Sums = (u16, u32, u16, u16);

/// Components by flood fill over places, seams included.
fn flood(rig: &Rig, low: u16) -> Vec<Sums> {
    let layout = &rig.layout;
    let value = |place: Place| layout.taxel(place).map_or(0, |taxel| rig.values[taxel]);
    let step = |place: Place, dy: i32, dx: i32| {
        let row = u16::try_from(i32::from(place.row) + dy).ok()?;
        let column = u16::try_from(i32::from(place.column) + dx).ok()?;
        let there = Place { row, column, ..place };
        layout.taxel(there).map(|_| there)
    };
    let mut over: Vec<(Place, Place)> = Vec::new();
    for joint in layout.joints() {
        for (a, b) in joint.neighbours() {
            let a = Place { panel: joint.a, row: a.1 as u16, column: a.0 as u16 };
            let b = Place { panel: joint.b, row: b.1 as u16, column: b.0 as u16 };
            over.extend([(a, b), (b, a)]);
        }
    }
    let mut seen = vec![false; layout.taxels()];
    let mut found = Vec::new();
    for start in 0..layout.taxels() {
        let (mut stack, mut sums) = (vec![layout.place(start).unwrap()], (0, 0, 0, 0));
        while let Some(place) = stack.pop() {
            let taxel = layout.taxel(place).unwrap();
            if value(place) < low || std::mem::replace(&mut seen[taxel], true) {
                continue;
            }
            let four = [(0, 1), (1, 0), (0, -1), (-1, 0)];
            let inside = |(dy, dx)| step(place, dy, dx).is_some_and(|p| value(p) >= low);
            sums.0 += 1;
            sums.1 += u32::from(value(place));
            sums.2 = sums.2.max(value(place));
            sums.3 += u16::from(!four.into_iter().all(inside));
            stack.extend((-1..=1).flat_map(|dy| (-1..=1).filter_map(move |dx| step(place, dy, dx))));
            stack.extend(over.iter().filter(|(from, _)| *from == place).map(|(_, to)| *to));
        }
        if sums.0 > 0 {
            found.push(sums);
        }
    }
    found
}

#[test]
fn components_are_those_of_a_flood_fill() {
    let mut rig = Rig::new(&Garment::reference());
    let mut state = 9u32;
    let mut next = |n: u32| {
        state = state.wrapping_mul(1664525).wrapping_add(1013904223);
        (state >> 8) % n
    };
    let (mut compared, mut over_the_seam) = (0, 0);
    for round in 0..3000 {
        rig.clear();
        rig.state.reset();
        let share = [1, 5, 20, 45, 80][round % 5];
        for value in &mut rig.values {
            *value = if next(100) < share { 121 + next(3000) as u16 } else { next(60) as u16 };
        }
        // Few enough contacts for the state: only some rows.
        let rows = 1 + next(12) as usize;
        let first = next(20) as usize;
        let kept = |taxel: usize| (first..first + rows).contains(&(taxel / 16 % 32));
        rig.values.iter_mut().enumerate().filter(|(taxel, _)| !kept(*taxel)).for_each(|(_, v)| *v = 0);
        let mut want = flood(&rig, 60);
        let frame = rig.frame();
        if want.len() > 16 || frame.overflow > 0 {
            assert!(frame.overflow > 0 || frame.present.len() + usize::from(frame.dropped) == want.len());
            continue;
        }
        let mut have: Vec<Sums> =
            frame.present.iter().map(|c| (c.area, c.total, c.peak, c.perimeter)).collect();
        want.sort_unstable();
        have.sort_unstable();
        assert_eq!(have, want, "round {round}");
        compared += 1;
        over_the_seam += usize::from(!rig.state.feedback().beyond.is_empty());
    }
    println!("{compared} images compared, {over_the_seam} with contacts across the seam");
    assert!(compared > 700 && over_the_seam > 300, "{compared} {over_the_seam}");
}

/// What the table of the module says about memory (on a 64-bit host, where little is larger).
#[test]
fn memory_is_as_documented() {
    let size = size_of::<ContactState<16, 512>>();
    println!("ContactState<16, 512>: {size} bytes");
    assert!(size <= 16 * (4 * 16 + 540) + 20 * 512 + 4096, "{size}");
}

#[test]
fn a_contact_travels_whole_and_small() {
    let mut rig = Rig::new(&Garment::reference());
    rig.bar(0, 9, 12..16, 3000);
    rig.bar(1, 9, 0..3, 3000);
    let contact = rig.only();
    let bytes = postcard::to_allocvec(&contact).unwrap();
    assert_eq!(postcard::from_bytes::<Contact>(&bytes).unwrap(), contact);
    println!("a contact on the wire: {} bytes", bytes.len());
    assert!(bytes.len() <= 64, "{}", bytes.len());
}
