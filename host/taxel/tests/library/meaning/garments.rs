//! Touches on random garments and at random frame rates: the same contacts, words and intentions as on the
//! reference garment at 195 frames/s. `TAXEL_CAMPAIGN=1`: 1,000 of them instead of 50.

use crate::meaning::family::Act;
use crate::meaning::judge::play;
use crate::meaning::strangers::{self, FAMILIES, Landing, Make};
use fastrand::Rng;
use std::collections::BTreeSet;
use std::fmt;
use taxel_core::contact::Phase;
use taxel_core::garment::{Garment, Panel, cell_mm2};
use taxel_core::symbol::{Symbol, SymbolConfig};

/// Frame period of the reference, us.
const PERIOD_US: u64 = 5_128;
/// Pressure at which a taxel is nearly saturated.
const FULL: u16 = 3_800;
/// Least peak of a contact on a panel, counts: the pressure of 32 on a taxel of 120 mm2, and 8 of noise.
fn least_peak(panel: &Panel) -> f64 {
    (32.0 * (f64::from(cell_mm2(panel.pitch_um)) / 120.0).min(2.0) + 8.0).max(24.0)
}
/// Signal of a taxel from which on touches are compared, as a multiple of the least peak of a contact.
const CLEAR: f64 = 2.0;
/// Taxels from which on a touch covers 3 x 3.
const LARGE: u16 = 9;

/// Perception of one touch.
#[derive(Default)]
struct Heard {
    /// Time of the first contact, time until the last one, and time until four fifths of the force, ms.
    onset_ms: f64,
    duration_ms: f64,
    rise_ms: f64,
    /// Greatest total pressure, counts.
    force: f64,
    /// Greatest pressure of a taxel, and as a multiple of the least peak of a contact.
    peak: u16,
    clear: f64,
    /// Most taxels of a contact, and its greatest area.
    taxels: u16,
    area_cm2: f64,
    /// Symbol of the strongest contact at its release.
    symbol: Option<Symbol>,
    /// Announced intentions.
    led: BTreeSet<&'static str>,
}

impl Heard {
    fn of(mut act: Act) -> Heard {
        let (mut heard, begin) = (Heard::default(), act.span.0);
        let panels = act.garment.panels.clone();
        let mut course: Vec<(f64, f64)> = Vec::new();
        play(&mut act, |now, percept| {
            let force: u64 = percept.present.iter().map(|placed| u64::from(placed.contact.total)).sum();
            if force > 0 {
                course.push(((now as f64 - begin as f64) / 1e3, force as f64));
            }
            for contact in percept.present.iter().map(|placed| &placed.contact) {
                let panel = &panels[usize::from(contact.panel)];
                let [x, y] = panel.pitch_um.map(|um| f64::from(um) / 1e4);
                heard.peak = heard.peak.max(contact.peak);
                heard.clear = heard.clear.max(f64::from(contact.peak) / least_peak(panel));
                heard.taxels = heard.taxels.max(contact.area);
                heard.area_cm2 = heard.area_cm2.max(f64::from(contact.area) * x * y);
            }
            let most = |symbol: &Symbol| heard.symbol.is_none_or(|most| symbol.peak_total > most.peak_total);
            let over = |symbol: &Symbol| symbol.phase == Phase::Released && most(symbol);
            heard.symbol = percept.events().filter(over).last().or(heard.symbol);
            let led = percept.meaning.filter(|meaning| meaning.changed).map(|it| it.leading.as_str());
            heard.led.extend(led.filter(|word| *word != "none"));
        });
        let (Some((onset, _)), Some((last, _))) = (course.first(), course.last()) else { return heard };
        heard.force = course.iter().map(|(_, force)| *force).fold(0.0, f64::max);
        let risen = course.iter().find(|(_, force)| *force >= 0.8 * heard.force);
        heard.rise_ms = risen.map_or(0.0, |(t, _)| t - onset);
        (heard.onset_ms, heard.duration_ms) = (*onset, last - onset);
        heard
    }

    /// What most of them say: the median of each measure, the commonest words and intentions.
    fn typical(all: &[Heard]) -> Heard {
        let median = |measure: fn(&Heard) -> f64| {
            let mut sorted: Vec<f64> = all.iter().map(measure).collect();
            sorted.sort_by(f64::total_cmp);
            sorted[sorted.len() / 2]
        };
        let commonest = |same: &dyn Fn(&Heard, &Heard) -> bool| {
            all.iter().max_by_key(|one| all.iter().filter(|other| same(one, other)).count())
        };
        let words = |heard: &Heard| {
            heard.symbol.map(|symbol| (symbol.words.strength, symbol.words.extent, symbol.words.span))
        };
        Heard {
            onset_ms: median(|heard| heard.onset_ms),
            duration_ms: median(|heard| heard.duration_ms),
            rise_ms: median(|heard| heard.rise_ms),
            force: median(|heard| heard.force),
            peak: median(|heard| heard.peak.into()) as u16,
            clear: median(|heard| heard.clear),
            taxels: median(|heard| heard.taxels.into()) as u16,
            area_cm2: median(|heard| heard.area_cm2),
            symbol: commonest(&|one, other| words(one) == words(other)).and_then(|heard| heard.symbol),
            led: commonest(&|one, other| one.led == other.led)
                .map_or_else(BTreeSet::new, |it| it.led.clone()),
        }
    }

    /// True if the word for a measure may also be the neighbouring one: the measure is within 15 % of where
    /// the word changes, which is the limit at an onset and an eighth above it while the measure grows.
    fn near(measure: f64, limits: &[f64]) -> bool {
        limits.iter().any(|limit| (0.85..1.125 * 1.15).contains(&(measure / limit)))
    }

    /// True if both have the same words, as far as the measures are not near a limit.
    fn is_called_as(&self, other: &Heard) -> bool {
        let (Some(a), Some(b)) = (self.symbol, other.symbol) else { return false };
        let SymbolConfig { strength, extent, span_ms } = SymbolConfig::default();
        let near = |measure: f64, limits: &[f64]| Heard::near(measure, limits);
        (a.words.strength == b.words.strength || near(b.peak_total.into(), &strength.map(f64::from)))
            && (a.words.extent == b.words.extent || near(other.area_cm2, &extent.map(f64::from)))
            && (a.words.span == b.words.span || near(b.duration_ms.into(), &span_ms.map(f64::from)))
    }
}

impl fmt::Display for Heard {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let words = self.symbol.map(|symbol| symbol.words);
        let words = words.map(|words| format!("{:?} {:?} {:?}", words.strength, words.extent, words.span));
        let Heard { force, onset_ms, duration_ms, led, .. } = self;
        write!(f, "{force} counts from {onset_ms:.0} ms for {duration_ms:.0} ms, {words:?}, {led:?}")
    }
}

/// A garment of one to four panels, each large enough for a hand.
fn garment(random: &mut Rng) -> Garment {
    loop {
        let mut garment = Garment::reference();
        garment.seams.clear();
        garment.blocks.clear();
        garment.panels.truncate(random.usize(1..5));
        for panel in &mut garment.panels {
            (panel.rows, panel.columns) = (random.u16(8..48), random.u16(8..40));
            panel.pitch_um = [0; 2].map(|_| random.u32(6_000..14_000));
        }
        let panels = || garment.panels.iter();
        let taxels: u32 = panels().map(|panel| u32::from(panel.rows) * u32::from(panel.columns)).sum();
        let side = |taxels: u16, pitch_um: u32| u32::from(taxels) * pitch_um;
        let large = panels().all(|panel| {
            side(panel.columns, panel.pitch_um[0]) >= 160_000
                && side(panel.rows, panel.pitch_um[1]) >= 200_000
        });
        if taxels <= 2048 && large {
            return garment;
        }
    }
}

/// Number of touches compared, of those that agreed as they are, and of those that agreed typically.
#[derive(Default, Clone, Copy)]
struct Tally {
    compared: usize,
    agreed: usize,
    typical: usize,
}

/// Families that are not a touch, or whose place depends on the garment: arms, and fingers as far apart as
/// its panels are wide.
const ELSEWHERE: [&str; 5] = ["drift", "breath", "drops", "hug", "stroke by fingers"];

/// Compared properties, with the least percentages of agreement: as they are, and typically.
const COMPARED: [(&str, [usize; 2]); 5] = [
    ("onset", [96, 97]),
    ("duration", [96, 99]),
    ("force", [99, 99]),
    ("words", [99, 99]),
    ("intention", [98, 98]),
];

/// Number of landings of a touch on each garment that decide if the touch as it is does not agree.
const LANDINGS: usize = 9;

/// A touch on the reference garment and on another, with both perceptions.
struct Pair {
    family: usize,
    number: u64,
    garment: Garment,
    period_us: u64,
    want: Heard,
    have: Heard,
}

impl Pair {
    /// None unless the touch is clear on both garments, and resolved at both rates.
    fn of(seed: u64) -> Option<Pair> {
        let mut random = Rng::with_seed(seed);
        let known: Vec<usize> =
            (0..FAMILIES.len()).filter(|family| !ELSEWHERE.contains(&FAMILIES[*family].name)).collect();
        let family = known[random.usize(..known.len())];
        let (number, garment) = (random.u64(..1000), garment(&mut random));
        let want = touch(family, number, Garment::reference(), PERIOD_US, 0);
        let rise_us = want.rise_ms * 1e3;
        if want.clear < CLEAR || rise_us < 2.0 * PERIOD_US as f64 {
            return None;
        }
        let slowest = (rise_us / 2.0).min(40_000.0);
        let period_us = (640.0 * (slowest / 640.0).powf(random.f64())) as u64;
        let have = touch(family, number, garment.clone(), period_us, 0);
        (have.clear >= CLEAR).then_some(Pair { family, number, garment, period_us, want, have })
    }

    /// Agreement of a perception on the reference garment and one on the other in each of [`COMPARED`]; none
    /// where a comparison makes no sense.
    fn agree(&self, want: &Heard, have: &Heard) -> [Option<bool>; 5] {
        let frames = 2.0 * self.period_us.max(PERIOD_US) as f64 / 1e3;
        let full = want.peak.max(have.peak) >= FULL;
        let spread = if want.taxels.min(have.taxels) >= LARGE { 0.05 } else { 0.15 };
        [
            Some((have.onset_ms - want.onset_ms).abs() <= frames.max(20.0)),
            Some((have.duration_ms - want.duration_ms).abs() <= frames.max(0.05 * want.duration_ms)),
            (!full).then_some((have.force / want.force - 1.0).abs() <= spread),
            Some(have.is_called_as(want)),
            Some(have.led == want.led),
        ]
    }

    /// Typical agreement: where a touch lands between the taxels, when between the frames and in which noise
    /// is no part of it, and two grids differ in it by themselves.
    fn agree_typically(&self) -> [Option<bool>; 5] {
        let typical = |garment: &Garment, period_us| {
            let landed = |landing| touch(self.family, self.number, garment.clone(), period_us, landing);
            Heard::typical(&(0..LANDINGS).map(landed).collect::<Vec<_>>())
        };
        let want = typical(&Garment::reference(), PERIOD_US);
        self.agree(&want, &typical(&self.garment, self.period_us))
    }

    fn count(&self, seed: u64, tallies: &mut [Tally; 5]) {
        let plain = self.agree(&self.want, &self.have);
        let typical = if plain.contains(&Some(false)) { self.agree_typically() } else { plain };
        for (index, (what, _)) in COMPARED.iter().enumerate() {
            let Some(agrees) = plain[index] else { continue };
            let typical = agrees || typical[index] != Some(false);
            tallies[index].compared += 1;
            tallies[index].agreed += usize::from(agrees);
            tallies[index].typical += usize::from(typical);
            if !agrees {
                let Pair { family, period_us, want, have, .. } = self;
                let (name, how) = (FAMILIES[*family].name, if typical { "once" } else { "typically" });
                println!("  {what} {how}: seed {seed}, {name} at {period_us} us: {have}, wanted {want}");
            }
        }
    }
}

/// Perception of touch `number` of a family.
fn touch(family: usize, number: u64, garment: Garment, period_us: u64, landing: usize) -> Heard {
    let (on, landing) = ((garment, Make::Even), Landing::nth(landing));
    Heard::of(strangers::landed(family, number, on, Some(period_us), landing))
}

#[test]
fn a_touch_is_the_same_on_random_garments_at_random_rates() {
    let campaign = std::env::var_os("TAXEL_CAMPAIGN").is_some();
    // The campaign's are others than those of the check, which were looked at one by one.
    let (first, count) = if campaign { (100_000, 1_000) } else { (0, 50) };
    let mut tallies = [Tally::default(); 5];
    let pairs = (first..).filter_map(|seed| Some((seed, Pair::of(seed)?)));
    pairs.take(count).for_each(|(seed, pair)| pair.count(seed, &mut tallies));
    println!("{count} touches, each on a garment of its own");
    println!("            compared   agreed   typically");
    for ((what, _), Tally { compared, agreed, typical }) in COMPARED.iter().zip(tallies) {
        let percent = |part: usize| 100.0 * part as f64 / compared as f64;
        println!("{what:<12} {compared:7} {:7.1} % {:9.1} %", percent(agreed), percent(typical));
    }
    for ((what, bars), Tally { compared, agreed, typical }) in COMPARED.iter().zip(tallies) {
        for (part, bar) in [agreed, typical].into_iter().zip(bars) {
            assert!(part * 100 >= compared * bar, "{what}: {part} of {compared}");
        }
    }
}
