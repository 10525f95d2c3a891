//! Words of a simulated board while a script is played to it.

use anyhow::{Context, Result};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use taxel::client::Event;
use taxel::session::Session;
use taxel::sim::Script;
use taxel::source::{SourceOptions, simulated};
use taxel_core::format::Q15;
use taxel_core::intent::Leading;

/// Words of the board.
#[derive(Debug, Default, Clone)]
pub struct Heard {
    /// Announcements: the board's time, us, and the word.
    pub said: Vec<(u64, Leading)>,
    /// Activations of all concepts after each inference, with the board's time, us.
    pub activations: Vec<(u64, Vec<Q15>)>,
    /// True if there was a contact.
    pub felt: bool,
}

/// Plays a script, with another map than the shipped one if there is one.
pub fn hear(script: &Script, map: Option<&Path>) -> Result<Heard> {
    let mut script = script.clone();
    if let Some(map) = map {
        let path = std::path::absolute(map)?.display().to_string();
        let intent = script.scene.entry("intent").or_insert_with(|| toml::Table::new().into());
        let intent = intent.as_table_mut().context("scene.intent must be a table")?;
        intent.insert("map".into(), path.into());
    }
    let mut heard = Heard::default();
    let mut session = Session::over(simulated(script, &SourceOptions::default())?)?;
    let mut leading = Leading::None;
    while let Some(event) = session.wait()? {
        match event {
            Event::Contacts { .. } => heard.felt |= !session.client().contacts().is_empty(),
            Event::Intent(report) => {
                if report.leading != leading {
                    leading = report.leading;
                    heard.said.push((report.time.0, leading));
                }
                heard.activations.push((report.time.0, report.concepts.to_vec()));
            }
            _ => {}
        }
    }
    Ok(heard)
}

/// Plays all scripts, as many at a time as there are processors, in their order.
pub fn hear_all(scripts: &[Script], map: Option<&Path>) -> Result<Vec<Heard>> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut own = Vec::new();
        while let Some((at, script)) =
            Some(next.fetch_add(1, Ordering::Relaxed)).and_then(|at| Some((at, scripts.get(at)?)))
        {
            own.push((at, hear(script, map).with_context(|| script.name.clone())));
        }
        own
    };
    let workers = thread::available_parallelism().map_or(1, usize::from);
    let mut all: Vec<(usize, Result<Heard>)> = thread::scope(|scope| {
        let hands: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        hands.into_iter().flat_map(|hand| hand.join().unwrap_or_default()).collect()
    });
    all.sort_by_key(|(at, _)| *at);
    all.into_iter().map(|(_, heard)| heard).collect()
}
