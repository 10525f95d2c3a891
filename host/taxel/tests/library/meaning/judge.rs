//! Runs every touch through the pipeline with the shipped scene, and tabulates the announcements by family.

use crate::meaning::family::{Act, Announced, Expected, Family};
use crate::meaning::{scripted, strangers};
use taxel_core::capacity::TAXELS;
use taxel_core::format::{Code, Micros};
use taxel_core::garment::Layout;
use taxel_core::intent::Leading;
use taxel_core::pipeline::{Percept, Pipeline, PipelineState};
use taxel_core::scene::Scene;

/// Time of the tare at the start, us.
const TARE_US: u64 = 200_000;
/// Time after the end of its force in which announcements still belong to a touch, us.
const AFTER_US: u64 = 1_500_000;
/// Jitter of the frames, as a share of the period.
const JITTER: f64 = 0.05;

/// Result of one touch.
pub struct Verdict {
    pub announced: Announced,
    /// True if a person would agree.
    pub agreed: bool,
    /// Number of pins driven because of an attack.
    pub flinches: usize,
    pub note: String,
}

/// Plays one touch frame by frame, with a tare before it; calls `see` with the time and the percept.
pub fn play(act: &mut Act, mut see: impl FnMut(u64, &Percept<'_>)) {
    let layout = Layout::build(&act.garment, TAXELS, 4095).expect("the garment is good");
    let pipeline = Pipeline::build(&Scene::shipped(), &layout).expect("the shipped scene fits");
    let mut state = Box::new(PipelineState::<TAXELS, { TAXELS / 2 }>::default());
    state.reset(&layout, false, 4095);
    state.condition.tare((TARE_US / act.period_us) as u16);
    let mut raw = vec![0u16; layout.taxels()];
    let mut rng = fastrand::Rng::with_seed(act.span.1);
    let mut now = 0;
    while now < act.span.1 + AFTER_US {
        (act.codes)(now, &mut raw);
        let codes: Vec<Code> = raw.iter().map(|code| Code(*code)).collect();
        see(now, &pipeline.process(&mut *state, &layout, &codes, false, Micros(now), &mut ()));
        now += (act.period_us as f64 * (1.0 + JITTER * (rng.f64() - 0.5))) as u64;
    }
}

/// Result of one touch.
pub fn hear(mut act: Act) -> Verdict {
    let (mut announced, mut flinches, begin) = (Announced::new(), 0, act.span.0);
    play(&mut act, |now, percept| {
        if let Some(meaning) = percept.meaning.filter(|meaning| meaning.changed) {
            announced.push((meaning.leading, (now as i64 - begin as i64) / 1000));
        }
        let pin = |name: &str, active: bool| active && name == "flinch";
        flinches += percept.reactions.changes().iter().filter(|it| pin(&it.name, it.active)).count();
    });
    let lasts_ms = ((act.span.1 - act.span.0) / 1000) as i64;
    Verdict { agreed: act.family.expected.agrees(&announced, lasts_ms), announced, flinches, note: act.note }
}

/// A row of the table.
pub struct Row {
    pub family: Family,
    pub count: usize,
    pub agreed: usize,
    pub kind: usize,
    pub threat: usize,
    pub attack: usize,
    pub flinches: usize,
    /// Delays of the first announcement, ms, ascending.
    pub delays: Vec<i64>,
    pub wrong: Vec<String>,
}

impl Row {
    pub fn of(family: Family, verdicts: &[Verdict]) -> Row {
        let any = |of: Leading| {
            verdicts.iter().filter(|v| v.announced.iter().any(|(leading, _)| *leading == of)).count()
        };
        let first =
            |v: &Verdict| v.announced.iter().find(|(leading, _)| *leading != Leading::None).map(|it| it.1);
        let mut delays: Vec<i64> = verdicts.iter().filter_map(first).collect();
        delays.sort_unstable();
        let wrong = verdicts.iter().filter(|v| !v.agreed);
        Row {
            family,
            count: verdicts.len(),
            agreed: verdicts.iter().filter(|v| v.agreed).count(),
            kind: any(Leading::Kindness),
            threat: any(Leading::Threat),
            attack: any(Leading::Attack),
            flinches: verdicts.iter().map(|v| v.flinches).sum(),
            delays,
            wrong: wrong.map(|v| format!("  {}: {:?}: {}", family.name, v.announced, v.note)).collect(),
        }
    }

    /// Pins driven although a person would not have called it an attack.
    pub fn false_reflexes(&self) -> usize {
        let harmless = !matches!(self.family.expected, Expected::Harmful | Expected::Attack);
        if harmless { self.flinches } else { 0 }
    }

    pub fn print(&self) {
        let median = self.delays.get(self.delays.len() / 2).map_or("-".into(), |ms| ms.to_string());
        println!(
            "{:18} {:9} {:5} {:6} {:8} {:6} {:6} {:9} {:8}",
            self.family.name,
            format!("{:?}", self.family.expected).to_lowercase(),
            self.count,
            self.agreed,
            self.kind,
            self.threat,
            self.attack,
            median,
            self.false_reflexes()
        );
    }
}

/// Share of right touches among the selected rows.
fn share(rows: &[Row], of: impl Fn(&Row) -> bool, right: impl Fn(&Row) -> usize) -> f64 {
    let chosen = || rows.iter().filter(|row| of(row));
    let count: usize = chosen().map(|row| row.count).sum();
    chosen().map(right).sum::<usize>() as f64 / count as f64
}

/// Checks a table against the required figures.
pub fn judge(rows: &[Row]) {
    let friendly = |row: &Row| matches!(row.family.expected, Expected::Kind | Expected::Friendly);
    let harmful = |row: &Row| matches!(row.family.expected, Expected::Harmful | Expected::Attack);
    let shares = [
        ("friendly families without an attack", 0.98, share(rows, friendly, |row| row.count - row.attack)),
        ("friendly families: kindness or nothing", 0.95, share(rows, friendly, |row| row.agreed)),
        ("kindness reported", 0.90, share(rows, |row| row.family.expected == Expected::Kind, |row| row.kind)),
        (
            "attacks reported",
            0.95,
            share(rows, |row| row.family.expected == Expected::Attack, |row| row.attack),
        ),
        ("harmful families: threat or attack", 0.99, share(rows, harmful, |row| row.agreed)),
        ("harmful families never called kind", 0.95, share(rows, harmful, |row| row.count - row.kind)),
        (
            "nothing from nothing",
            1.0,
            share(rows, |row| row.family.expected == Expected::Nothing, |row| row.agreed),
        ),
        (
            "at most once from what falls and lies",
            0.95,
            share(rows, |row| row.family.expected == Expected::Once, |row| row.agreed),
        ),
    ];
    for (what, bar, have) in shares {
        println!("{what}: {:.1} %, the bar is {:.0} %", 100.0 * have, 100.0 * bar);
    }
    shares.iter().for_each(|(what, bar, have)| assert!(have >= bar, "{what}: {have}"));
}

/// Rows of both authors, with `each` touches of each family.
pub fn table(each: u64) -> Vec<Row> {
    println!("family             expected  count agreed kindness threat attack first, ms false reflexes");
    let mut rows = Vec::new();
    for (families, act) in
        [(scripted::FAMILIES, scripted::act as fn(usize, u64) -> Act), (strangers::FAMILIES, strangers::act)]
    {
        for (index, family) in families.into_iter().enumerate() {
            let verdicts: Vec<Verdict> = (0..each).map(|number| hear(act(index, number))).collect();
            let row = Row::of(family, &verdicts);
            row.print();
            rows.push(row);
        }
    }
    rows.iter().flat_map(|row| &row.wrong).for_each(|wrong| println!("{wrong}"));
    rows
}
