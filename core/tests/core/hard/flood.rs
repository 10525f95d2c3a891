//! Components against a flood fill.

use crate::hard::rig::ContactRig;
use taxel_core::garment::{Garment, Place};

/// Sums of a component: area, total, peak, contour; and where the peak is first.
type ComponentSums = (u16, u32, u16, u16, (u8, u16, u16));

/// Components by flood fill over places, seams included.
fn flood(rig: &ContactRig, low: u16) -> Vec<ComponentSums> {
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
        let (mut stack, mut sums) = (vec![layout.place(start).unwrap()], (0, 0, 0, 0, (0, 0, 0)));
        while let Some(place) = stack.pop() {
            let taxel = layout.taxel(place).unwrap();
            if value(place) < low || std::mem::replace(&mut seen[taxel], true) {
                continue;
            }
            let four = [(0, 1), (1, 0), (0, -1), (-1, 0)];
            let inside = |(dy, dx)| step(place, dy, dx).is_some_and(|p| value(p) >= low);
            sums.0 += 1;
            sums.1 += u32::from(value(place));
            let at = (place.panel, place.row, place.column);
            if value(place) > sums.2 || (value(place) == sums.2 && at < sums.4) {
                (sums.2, sums.4) = (value(place), at);
            }
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

/// Random images of a garment of few rows at a time, and so few contacts: how many were compared, and how
/// many of them had a contact across a seam.
fn compare(garment: &Garment, rounds: usize) -> (u32, u32) {
    let mut rig = ContactRig::new(garment);
    let mut state = 9u32;
    let mut next = |n: u32| {
        state = state.wrapping_mul(1664525).wrapping_add(1013904223);
        (state >> 8) % n
    };
    let (mut compared, mut over_the_seam) = (0, 0);
    for round in 0..rounds {
        rig.clear();
        rig.state.reset();
        let share = [1, 5, 20, 45, 80][round % 5];
        // Coarse values, so that the peak is found more than once.
        for value in &mut rig.values {
            *value = if next(100) < share { 121 + 250 * next(12) as u16 } else { next(60) as u16 };
        }
        // Few enough contacts for the state: only some rows.
        let rows = 1 + next(12) as u16;
        let first = next(20) as u16;
        for taxel in 0..rig.values.len() {
            if !(first..first + rows).contains(&rig.layout.place(taxel).unwrap().row) {
                rig.values[taxel] = 0;
            }
        }
        let mut want = flood(&rig, 60);
        let frame = rig.frame();
        if want.len() > 16 || frame.overflow > 0 {
            assert!(frame.overflow > 0 || frame.present.len() + usize::from(frame.dropped) == want.len());
            continue;
        }
        let at = |place: Place| (place.panel, place.row, place.column);
        let mut have: Vec<ComponentSums> =
            frame.present.iter().map(|c| (c.area, c.total, c.peak, c.perimeter, at(c.peak_at))).collect();
        want.sort_unstable();
        have.sort_unstable();
        assert_eq!(have, want, "round {round}");
        compared += 1;
        over_the_seam += u32::from(!rig.state.feedback().beyond.is_empty());
    }
    (compared, over_the_seam)
}

#[test]
fn components_are_those_of_a_flood_fill() {
    let (compared, over_the_seam) = compare(&Garment::reference(), 3000);
    println!("{compared} images compared, {over_the_seam} with contacts across the seam");
    assert!(compared > 700 && over_the_seam > 300, "{compared} {over_the_seam}");
}

/// Rows of more columns than a word of the scan has.
#[test]
fn components_of_wide_panels_are_those_of_a_flood_fill() {
    for (rows, columns) in [(32, 31), (32, 32), (32, 33), (32, 64), (31, 65), (20, 100)] {
        let (compared, _) = compare(&Garment::recorded(rows, columns), 800);
        println!("{columns} columns: {compared} images compared");
        assert!(compared > 100, "{columns}: {compared}");
    }
}
