//! A moment is the same from wherever it is gone to.

use super::stage::{Moment, View, moments, recorded};
use serde_json::{Value, json};

/// The frame that is shown at a time.
fn at(all: &[Moment], seconds: f64) -> &Moment {
    all.iter().rfind(|moment| moment.at as f64 <= (seconds * 1e6).round()).unwrap_or(&all[0])
}

/// What a frame says of the touch; counters of the line begin where it was gone to.
fn touch(line: &Value) -> [Value; 4] {
    ["frame", "time_us", "contacts", "intent"].map(|part| line[part].clone())
}

#[test]
fn any_moment_is_that_of_a_recording_played_from_its_beginning() {
    let path = recorded("moments.mcap", "sim:pat", 12, &[]);
    let (all, view) = (moments(&path), View::start(&[path.to_str().unwrap()]));
    let mut page = view.page();
    let mut seeks = page.stand();
    // Far ahead at once, when the file has not been gone through, and again when it has.
    for round in 0..2 {
        for seconds in [11.9, 0.3, 6.0, 0.55, 0.62, 0.931, 1.2, 0.0, 0.64, 3.217, 5000.0] {
            let (line, image, health) = page.seek(seconds, &mut seeks);
            let wanted = at(&all, seconds);
            assert_eq!(touch(&line), touch(&wanted.line), "{seconds} s, round {round}");
            assert_eq!(image, wanted.image, "{seconds} s");
            assert_eq!(health, wanted.health, "{seconds} s");
            assert_eq!(line["at_us"], wanted.at);
        }
        page.overview();
    }
    assert!(at(&all, 0.64).line["contacts"].as_array().is_some_and(|contacts| !contacts.is_empty()));
}

#[test]
fn steps_go_from_image_to_image_both_ways() {
    let path = recorded("steps.mcap", "sim:lash", 4, &[]);
    let (all, view) = (moments(&path), View::start(&[path.to_str().unwrap()]));
    let mut page = view.page();
    let mut seeks = page.stand();
    page.seek(2.0, &mut seeks);
    let mut index = all.iter().rposition(|moment| moment.at <= 2_000_000).unwrap();
    for steps in [1i64, 1, -1, -1, -1, 300, -700, 5] {
        page.ask(json!({ "step": steps }));
        seeks += 1;
        let (line, image) = page.image(|line| line["seeks"] == seeks);
        index = (index as i64 + steps).clamp(0, all.len() as i64 - 1) as usize;
        assert_eq!((touch(&line), &image), (touch(&all[index].line), &all[index].image), "{steps}");
    }
}

#[test]
fn what_is_played_is_the_recording_in_its_own_time_and_the_loop_begins_again() {
    let path = recorded("played.mcap", "sim:lash", 3, &[]);
    let (all, view) = (moments(&path), View::start(&[path.to_str().unwrap()]));
    let mut page = view.page();
    page.stand();
    page.ask(json!({ "range": [0.3, 0.6] }));
    page.ask(json!({ "loop": true }));
    page.ask(json!({ "speed": 0.5 }));
    page.ask(json!({ "seek": 0.3 }));
    page.ask(json!({ "play": true }));
    page.line("player", |line| line["playing"] == true && line["speed"] == 0.5);
    let (begun, mut rounds, mut last, mut first) = (std::time::Instant::now(), 0, 0, None);
    while rounds < 3 {
        let (line, image) = page.image(|_| true);
        let at = line["at_us"].as_u64().unwrap();
        let wanted = all.iter().find(|moment| moment.at == at).unwrap();
        assert_eq!((touch(&line), &image), (touch(&wanted.line), &wanted.image));
        assert!(at <= 600_000, "{at}");
        first.get_or_insert(at);
        if at < last {
            rounds += 1;
            assert!((294_000..=330_000).contains(&at), "the range begins with {at}");
        }
        last = at;
    }
    // Three rounds of 0.3 s at half the speed.
    let seconds = begun.elapsed().as_secs_f64();
    assert!((1.2..6.0).contains(&seconds), "{seconds} s");
}
