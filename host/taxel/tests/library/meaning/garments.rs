//! Touches on random garments and at random frame rates: the same contacts, words and intentions as on the
//! reference garment at 195 frames/s. `TAXEL_CAMPAIGN=1`: 1,000 of them instead of 100.

use crate::meaning::family::Act;
use crate::meaning::judge::play;
use crate::meaning::strangers::{self, FAMILIES, Make};
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
/// Least peak of a contact on a panel, counts: 40 on a taxel of 120 mm2, and the same pressure on others.
fn least_peak(panel: &Panel) -> f64 {
    40.0 * (f64::from(cell_mm2(panel.pitch_um)) / 120.0).clamp(0.6, 2.0)
}
/// Signal of a taxel from which on touches are compared, as a multiple of the least peak of a contact.
const CLEAR: f64 = 2.0;
/// Taxels from which on a touch covers 3 x 3.
const LARGE: u16 = 9;

/// Perception of one touch.
#[derive(Default)]
struct Heard {
    /// Time (ms) and total pressure (counts) while there is a contact.
    course: Vec<(f64, u64)>,
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
        play(&mut act, |now, percept| {
            let force: u64 = percept.present.iter().map(|placed| u64::from(placed.contact.total)).sum();
            if force > 0 {
                heard.course.push(((now as f64 - begin as f64) / 1e3, force));
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
        heard
    }

    fn force(&self) -> u64 {
        self.course.iter().map(|(_, force)| *force).max().unwrap_or(0)
    }

    fn onset(&self) -> f64 {
        self.course.first().map_or(f64::INFINITY, |(t, _)| *t)
    }

    fn duration(&self) -> f64 {
        self.course.last().map_or(0.0, |(t, _)| t - self.onset())
    }

    /// Time until four fifths of the force are reached, ms.
    fn rise(&self) -> f64 {
        let most = self.force();
        let risen = self.course.iter().find(|(_, force)| force * 5 >= most * 4);
        risen.map_or(0.0, |(t, _)| t - self.onset())
    }

    /// True if the word for a measure may also be the neighbouring one: the measure is within 15 % of the
    /// limit between them.
    fn near(measure: f64, limits: &[f64]) -> bool {
        limits.iter().any(|limit| (measure / limit - 1.0).abs() < 0.15)
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
        let (onset, duration) = (self.onset(), self.duration());
        write!(
            f,
            "{} counts from {onset:.0} ms for {duration:.0} ms, {words:?}, {:?}",
            self.force(),
            self.led
        )
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

/// Number of touches compared, and of those that agreed.
#[derive(Default, Clone, Copy)]
struct Tally {
    compared: usize,
    agreed: usize,
}

/// Families that are not a touch, or whose place depends on the garment: arms, and fingers as far apart as
/// its panels are wide.
const ELSEWHERE: [&str; 5] = ["drift", "breath", "drops", "hug", "stroke by fingers"];

/// Compared properties, with the least percentage of agreement.
const COMPARED: [(&str, usize); 5] =
    [("onset", 94), ("duration", 92), ("force", 99), ("words", 95), ("intention", 97)];

/// A touch on the reference garment and on another, with both perceptions.
struct Pair {
    title: String,
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
        let touch = |garment: Garment, period_us: u64| {
            Heard::of(strangers::worn(family, number, (garment, Make::Even), Some(period_us)))
        };
        let want = touch(Garment::reference(), PERIOD_US);
        let rise_us = want.rise() * 1e3;
        if want.clear < CLEAR || rise_us < 2.0 * PERIOD_US as f64 {
            return None;
        }
        let slowest = (rise_us / 2.0).min(40_000.0);
        let period_us = (640.0 * (slowest / 640.0).powf(random.f64())) as u64;
        let have = touch(garment, period_us);
        let title = format!("seed {seed}, {} at {period_us} us", FAMILIES[family].name);
        (have.clear >= CLEAR).then_some(Pair { title, period_us, want, have })
    }

    /// Agreement in each of [`COMPARED`]; none where a comparison makes no sense.
    fn agrees(&self) -> [Option<bool>; 5] {
        let Pair { want, have, .. } = self;
        let frames = 2.0 * self.period_us.max(PERIOD_US) as f64 / 1e3;
        let full = want.peak.max(have.peak) >= FULL;
        let spread = if want.taxels.min(have.taxels) >= LARGE { 0.05 } else { 0.15 };
        [
            Some((have.onset() - want.onset()).abs() <= frames.max(20.0)),
            Some((have.duration() - want.duration()).abs() <= frames.max(0.05 * want.duration())),
            (!full).then_some((have.force() as f64 / want.force() as f64 - 1.0).abs() <= spread),
            Some(have.is_called_as(want)),
            Some(have.led == want.led),
        ]
    }

    fn count(&self, tallies: &mut [Tally; 5]) {
        for ((tally, agrees), (what, _)) in tallies.iter_mut().zip(self.agrees()).zip(COMPARED) {
            tally.compared += usize::from(agrees.is_some());
            tally.agreed += usize::from(agrees == Some(true));
            if agrees == Some(false) {
                println!("  {what}: {}: {}, wanted {}", self.title, self.have, self.want);
            }
        }
    }
}

#[test]
fn a_touch_is_the_same_on_random_garments_at_random_rates() {
    let count = if std::env::var_os("TAXEL_CAMPAIGN").is_some() { 1_000 } else { 100 };
    let mut tallies = [Tally::default(); 5];
    (0..).filter_map(Pair::of).take(count).for_each(|pair| pair.count(&mut tallies));
    println!("{count} touches, each on a garment of its own");
    println!("            compared   agreed");
    for ((what, _), Tally { compared, agreed }) in COMPARED.iter().zip(tallies) {
        println!("{what:<12} {compared:7} {:7.1} %", 100.0 * agreed as f64 / compared as f64);
    }
    for ((what, bar), Tally { compared, agreed }) in COMPARED.iter().zip(tallies) {
        assert!(agreed * 100 >= compared * bar, "{what}: {agreed} of {compared}");
    }
}
