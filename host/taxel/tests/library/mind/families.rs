//! All families of touches, spread over two boards: the mind is at least as right as its best source.
//!
//! The scripts and simulators are those of the families of one board; the map of the robot was written with
//! them in sight. A source judges a touch if it announces something, or ought to: silence is no judgement of
//! a touch of which nothing need be said. The mind is compared with a source on the touches that this source
//! judges. `TAXEL_CAMPAIGN=1`: 40 touches of each family instead of 2, and others.

use super::spread::{SpreadFamily, families};
use super::touched::hear;
use crate::meaning::family::{Announced, Expected};
use taxel_core::intent::Leading;

/// True if the announcements are right: a person would agree, and who is kind is called so.
fn is_right(expected: Expected, announced: &Announced, lasts_ms: i64) -> bool {
    let is_kind = announced.iter().any(|(leading, _)| *leading == Leading::Kindness);
    expected.agrees(announced, lasts_ms) && (expected != Expected::Kind || is_kind)
}

struct Row {
    name: String,
    count: usize,
    /// Right touches of the mind.
    right: usize,
    /// By single source: touches that it judges, those of them in which it is right, and in which the mind
    /// is.
    judged: [[usize; 3]; 5],
    wrong: Vec<String>,
}

impl Row {
    fn of(family: &SpreadFamily, numbers: std::ops::Range<u64>) -> Row {
        let count = numbers.clone().count();
        let mut row =
            Row { name: family.name.clone(), count, right: 0, judged: [[0; 3]; 5], wrong: Vec::new() };
        for number in numbers {
            let touch = (family.make)(number);
            let (expected, note) = (touch.expected, touch.note.clone());
            let lasts_ms = ((touch.span.1 - touch.span.0) / 1000) as i64;
            let announced = hear(touch, number);
            let ought = expected == Expected::Kind || expected.is_harmful();
            let right = announced.each_ref().map(|announced| is_right(expected, announced, lasts_ms));
            for (at, judged) in row.judged.iter_mut().enumerate() {
                if ought || !announced[at].is_empty() {
                    let added = [1, usize::from(right[at]), usize::from(right[5])];
                    judged.iter_mut().zip(added).for_each(|(sum, one)| *sum += one);
                }
            }
            row.right += usize::from(right[5]);
            if !right[5] {
                row.wrong.push(format!("  {} {number}: {announced:?}: {note}", family.name));
            }
        }
        row
    }

    /// True if a single source is right more often where it judges.
    fn is_worse(&self) -> bool {
        self.judged.iter().any(|[_, source, mind]| mind < source)
    }

    fn print(&self) {
        let judged = self.judged.map(|[count, source, mind]| match count {
            0 => "-".to_string(),
            _ => format!("{source}/{count} ({mind})"),
        });
        let [one, two, contacts, vision, voice] = judged;
        let Row { name, count, right, .. } = self;
        println!("{name:24} {one:>13} {two:>13} {contacts:>13} {vision:>13} {voice:>13} {right:>5}/{count}");
    }
}

#[test]
fn the_mind_is_at_least_as_right_as_its_best_source_in_every_family() {
    let numbers = if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 100..140 } else { 0..2 };
    println!("right of those judged (the mind on the same touches)");
    println!(
        "{:24} {:>13} {:>13} {:>13} {:>13} {:>13} {:>7}",
        "family", "board one", "board two", "contacts", "vision", "voice", "mind"
    );
    let rows: Vec<Row> = families().iter().map(|family| Row::of(family, numbers.clone())).collect();
    rows.iter().for_each(Row::print);
    rows.iter().flat_map(|row| &row.wrong).for_each(|wrong| println!("{wrong}"));
    let sum = |of: &dyn Fn(&Row) -> usize| rows.iter().map(of).sum::<usize>();
    println!("right: {} of {}", sum(&|row| row.right), sum(&|row| row.count));
    let worse: Vec<&str> = rows.iter().filter(|row| row.is_worse()).map(|row| row.name.as_str()).collect();
    assert!(worse.is_empty(), "{worse:?}");
}
