//! Intentions of people's touches in newtons, through the whole board, with the shipped map and all defaults.
//!
//! The map was tuned only on the sessions of `scripted.rs`; it is judged by those of `hands.rs`, which have
//! other time courses, footprints, paths, noise and garments, and share no code with them. The gravest
//! intention announced during a touch counts. `TAXEL_CAMPAIGN=1`: 25 touches of each kind by each person
//! instead of one.

mod course;
pub mod hands;
pub mod kind;
mod played;
mod print;
pub mod scripted;
mod skin;
mod tally;

use tally::Tally;

const PEOPLE: u64 = 20;

fn is_campaign() -> bool {
    std::env::var_os("TAXEL_CAMPAIGN").is_some()
}

#[test]
fn people_are_understood_who_tuned_the_map() {
    let mut tally = Tally::default();
    let of_each = if is_campaign() { 25 } else { 1 };
    (0..PEOPLE).for_each(|person| tally.add(played::play(&mut scripted::Person::new(person, of_each))));
    println!("the family that the map was tuned on:");
    tally.print();
    tally.judge();
}

#[test]
fn people_are_understood_who_did_not() {
    let mut tally = Tally::default();
    let of_each = if is_campaign() { 25 } else { 1 };
    (0..PEOPLE).for_each(|person| tally.add(played::play(&mut hands::Person::new(person, of_each))));
    println!("the second family:");
    tally.print();
    tally.judge();
}
