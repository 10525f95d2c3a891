//! The first thing that one reads: what is felt now, in one sentence, and on what its newtons rest.

use serde::Serialize;
use taxel::client::{BoardDescription, Client};
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
    /// The present contacts, with forces in newtons if the counts per newton are known.
    pub fn of(client: &Client, counts_per_newton: Option<f32>) -> Felt {
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
        let reported = |total| format!("{noun} on the {place}, {}{others}", round(total, counts_per_newton));
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
fn round(total: u32, counts_per_newton: Option<f32>) -> String {
    match counts_per_newton.map(|counts| total as f32 / counts) {
        Some(newtons) if newtons < 2.95 => format!("{newtons:.1} N"),
        Some(newtons) => format!("{newtons:.0} N"),
        None => format!("{total} counts"),
    }
}

/// Basis on which forces rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Basis {
    /// A simulated board: newtons of its script.
    Simulated,
    /// A calibration in force.
    Calibrated,
    /// The nominal gain of the garment.
    Nominal,
    /// Nothing: forces are in counts.
    Counts,
}

impl Basis {
    /// The basis of a board's forces.
    pub fn of(client: &Client, counts_per_newton: Option<f32>) -> Basis {
        let description = client.description();
        match counts_per_newton {
            _ if description.is_some_and(BoardDescription::is_simulated) => Basis::Simulated,
            _ if description.is_some_and(|description| !description.calibration.is_empty()) => {
                Basis::Calibrated
            }
            Some(_) => Basis::Nominal,
            None => Basis::Counts,
        }
    }

    /// The word beside a force.
    pub fn as_str(self) -> &'static str {
        match self {
            Basis::Simulated => "simulated",
            Basis::Calibrated => "calibrated",
            Basis::Nominal => "nominal",
            Basis::Counts => "not calibrated",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::watch::{WatchOptions, watch};
    use taxel::client::Event;
    use taxel::client::Stamp;
    use taxel::session::Observer;
    use taxel::source::{SourceOptions, SourceSpec, open};

    /// The sentences of a script, each once.
    struct Ear(Option<f32>, Vec<String>);

    impl Observer for Ear {
        fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
            let Event::Frame { .. } = event else { return Ok(()) };
            let text = Felt::of(client, self.0).text();
            if !self.1.contains(&text) {
                self.1.push(text);
            }
            assert_eq!(Basis::of(client, self.0), Basis::Simulated);
            Ok(())
        }
    }

    fn reported(script: &str, newtons: bool) -> Vec<String> {
        let spec: SourceSpec = script.parse().unwrap();
        let source = open(&spec, &SourceOptions::default()).unwrap();
        let mut ear = Ear(source.counts_per_newton.filter(|_| newtons), Vec::new());
        watch(&WatchOptions::of(spec), source, &mut ear).unwrap();
        ear.1
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
