//! The first thing that one reads: what is felt now, in one sentence.

use serde::Serialize;
use taxel::client::Client;
use taxel_core::body::Placed;
use taxel_core::intent::Leading;

/// The touch that is felt, and its meaning.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Felt {
    /// The strongest touch, its place and force, and the number of others: `a touch on the back, 8 N, and 2 more`.
    pub what: String,
    /// Such a text with the greatest force of the strongest touch so far: reported once it has ended.
    pub peak: String,
    /// The announced intention, or why none is; empty while nothing touches.
    pub meaning: &'static str,
}

impl Felt {
    /// The present contacts, with forces in newtons if they are known.
    pub fn of(client: &Client) -> Felt {
        let contacts = client.contacts();
        let Some(strongest) = contacts.iter().max_by_key(|placed| placed.contact.total) else {
            let leading = Some(client.leading()).filter(|leading| *leading != Leading::None);
            let [what, peak] = [(); 2].map(|()| "nothing touches".into());
            return Felt { what, peak, meaning: leading.map_or("", Leading::as_str) };
        };
        let others = match contacts.len() - 1 {
            0 => String::new(),
            others => format!(", and {others} more"),
        };
        let (noun, place) = (noun(client, strongest), client.region_name(strongest.region));
        let reported = |total| format!("{noun} on the {place}, {}{others}", round(client, total));
        let total = strongest.contact.total;
        let peak = reported(client.greatest_force(strongest.contact.id).unwrap_or(total));
        Felt { what: reported(total), peak, meaning: meaning(client, strongest) }
    }

    /// The sentence.
    pub fn text(&self) -> String {
        let colon = if self.meaning.is_empty() { "" } else { ": " };
        format!("{}{colon}{}", self.what, self.meaning)
    }
}

/// The recognised gesture, else a touch.
fn noun(client: &Client, placed: &Placed) -> String {
    let name = match client.gesture(placed.contact.panel) {
        Some(gesture) => gesture.name.as_str(),
        None if placed.contact.slip => "sliding touch",
        None => "touch",
    };
    let article = if name.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("{article} {name}")
}

fn meaning(client: &Client, placed: &Placed) -> &'static str {
    match client.leading() {
        Leading::None if client.concepts().is_empty() => "",
        Leading::None if client.is_unsure(placed.contact.id) => "may be drift",
        Leading::None => "no meaning yet",
        leading => leading.as_str(),
    }
}

/// A force for a sentence, which changes seldom: whole newtons from 3 N on.
fn round(client: &Client, total: u32) -> String {
    match client.counts_per_newton().map(|counts| f64::from(total) / counts) {
        Some(newtons) if newtons < 2.95 => format!("{newtons:.1} N"),
        Some(newtons) => format!("{newtons:.0} N"),
        None => format!("{total} counts"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::watch::{WatchOptions, watch};
    use taxel::client::Event;
    use taxel::client::Stamp;
    use taxel::files::calibrate::ForceScale;
    use taxel::session::Observer;
    use taxel::source::{SourceOptions, SourceSpec, open};

    /// The sentences of a script, each once.
    struct Ear(Vec<String>);

    impl Observer for Ear {
        fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
            let Event::Frame { .. } = event else { return Ok(()) };
            let text = Felt::of(client).text();
            if !self.0.contains(&text) {
                self.0.push(text);
            }
            Ok(())
        }
    }

    fn reported(script: &str, newtons: bool) -> Vec<String> {
        let spec: SourceSpec = script.parse().unwrap();
        let mut source = open(&spec, &SourceOptions::default()).unwrap();
        if !newtons {
            source.scale = ForceScale::default();
        }
        let mut ear = Ear(Vec::new());
        watch(&WatchOptions::of(spec), source, &mut ear).unwrap();
        ear.0
    }

    #[test]
    fn a_pat_is_reported_with_place_force_and_meaning() {
        let reported = reported("sim:pat", true);
        assert_eq!(reported[0], "nothing touches");
        assert!(reported.contains(&"a touch on the back, 8 N: kindness".into()), "{reported:#?}");
        assert!(reported.iter().any(|text| text.ends_with(": no meaning yet")), "{reported:#?}");
    }

    #[test]
    fn the_strongest_of_several_comes_first_and_counts_have_their_name() {
        let reported = reported("sim:five", false);
        let several = reported.iter().find(|text| text.contains(", and 4 more")).unwrap();
        assert!(several.contains(" counts, and 4 more"), "{several}");
    }
}
