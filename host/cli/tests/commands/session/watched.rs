//! A watch of limited time, over restarts of the board.

use super::rig::{Rig, source};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use taxel::json::MessagePrinter;
use taxel_cli::watch::{WatchOptions, watch};

#[test]
fn a_limited_watch_goes_on_over_a_restart_and_prints_the_gap() {
    let rig = Arc::new(Mutex::new(Rig::new()));
    let args = WatchOptions { seconds: Some(3.0), ..WatchOptions::of("tcp:rig:1".parse().unwrap()) };
    let mut out = Vec::new();
    let power = rig.clone();
    let restarts = std::thread::spawn(move || {
        for _ in 0..2 {
            std::thread::sleep(Duration::from_millis(1100));
            let mut rig = power.lock().unwrap();
            rig.restart();
            rig.cut();
        }
    });
    let begun = Instant::now();
    watch(&args, source(&rig), &mut MessagePrinter::new(false, &mut out)).unwrap();
    restarts.join().unwrap();
    // Three seconds of board time, although its clock restarted twice.
    assert!((3.0..6.0).contains(&begun.elapsed().as_secs_f64()), "{:?}", begun.elapsed());
    let text = String::from_utf8(out).unwrap();
    let gaps = |words: &str| text.lines().filter(|line| line.contains(words)).count();
    assert_eq!((gaps("rig is gone: broken pipe; waiting for it"), gaps("rig is back after")), (2, 2));
}
