//! Statistics of the intentions announced for people's touches.

use crate::people::kind::Kind;
use crate::people::played::Heard;
use std::collections::BTreeMap;
use taxel_core::intent::Leading;

/// Counts of all acts.
#[derive(Default)]
pub struct Tally {
    /// For each kind: number of acts by announced intention, and the delays, frames.
    kinds: BTreeMap<Kind, ([usize; 4], Vec<u64>)>,
    last: usize,
    untouched: usize,
    wrong: Vec<String>,
}

impl Tally {
    /// Adds the results of a session, and the number of attacks announced without a touch.
    pub fn add(&mut self, (heard, untouched): (Vec<Heard>, usize)) {
        self.untouched += untouched;
        for heard in heard {
            let (kind, taken) = (heard.act.kind, heard.gravest());
            let (counts, delays) = self.kinds.entry(kind).or_default();
            counts[taken as usize] += 1;
            delays.extend(heard.delay());
            self.last += usize::from(heard.last() == kind.meaning());
            if taken != kind.meaning() {
                self.wrong.push(format!("{kind:?} {}: {:?}", heard.act.note, heard.announced));
            }
        }
    }

    fn share(&self, of: impl Fn(Kind) -> bool) -> f64 {
        let kinds = || self.kinds.iter().filter(|(kind, _)| of(**kind));
        let right: usize = kinds().map(|(kind, (counts, _))| counts[kind.meaning() as usize]).sum();
        let all: usize = kinds().flat_map(|(_, (counts, _))| counts).sum();
        right as f64 / all as f64
    }

    /// Share of the acts whose gravest announcement was the intended one.
    fn accuracy(&self) -> f64 {
        self.share(|_| true)
    }

    /// This share for attacks alone.
    fn recall(&self) -> f64 {
        self.share(|kind| kind.meaning() == Leading::Attack)
    }

    /// Checks the required figures.
    pub fn judge(&self) {
        assert!(self.accuracy() >= 0.98, "{} are right", self.accuracy());
        // A slap of 25 N that follows through is as mild as a clap of a friend (docs/concepts/meaning.md).
        assert!(self.recall() >= 0.98, "{} of the attacks are found", self.recall());
        assert_eq!(self.untouched, 0, "attacks called while nobody touched");
    }

    /// Prints the table.
    pub fn print(&self) {
        let acts: usize = self.kinds.values().flat_map(|(counts, _)| counts).sum();
        println!(
            "{acts} touches: {:.1} % right by the gravest announcement, {:.1} % by the last; attack recall {:.1} %; \
             attacks called while nobody touched: {}",
            100.0 * self.accuracy(),
            100.0 * self.last as f64 / acts as f64,
            100.0 * self.recall(),
            self.untouched
        );
        println!("was \\ taken for  none  kindness  threat  attack  delay in frames: median, p90");
        for (kind, (counts, delays)) in &self.kinds {
            let mut delays = delays.clone();
            delays.sort_unstable();
            let at = |share: usize| delays.get(delays.len() * share / 100).copied().unwrap_or(0);
            let [none, kindness, threat, attack] = counts;
            let name = format!("{kind:?}").to_lowercase();
            println!("{name:15} {none:5} {kindness:9} {threat:7} {attack:7}  {:6} {:4}", at(50), at(90));
        }
        self.wrong.iter().take(10).for_each(|wrong| println!("  {wrong}"));
    }
}
