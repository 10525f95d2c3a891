//! From newtons to codes: the converter's code of a taxel at a time.

use super::act::Act;
use super::decode::Decoder;
use super::error::ScriptError;
use super::noise::{UNIT_NOISE_RMS, unit_noise};
use super::pressure::Pressure;
use super::script::Script;
use super::sneak::Sneak;
use super::wiring::{Line, mates, uneven};
use fastrand::Rng;
use libm::hypot;
use taxel_core::garment::{Garment, Layout};

/// Signal of one newton on one taxel, counts; linear up to full scale. The force limits of the intention map
/// use the same scale: 30 N in total are 30,000 counts in total.
pub const COUNTS_PER_NEWTON: f32 = 1000.0;

/// Highest code of the 12-bit converter.
pub const FULL_SCALE: u16 = 4095;

/// Time for which the noise of the pressed fabric stays constant, ns.
const CLOTH_NS: u64 = 20_000_000;

/// A garment and everything that happens to it: the codes of a scene.
///
/// With ideal wiring [`World::code`] is a pure function of taxel and time, noise included: a taxel's noise is
/// a hash of the seed, its number and the time.
#[derive(Debug, Clone)]
pub struct World {
    taxels: Vec<Taxel>,
    pressure: Pressure,
    /// Counts per unit of [`unit_noise`].
    noise: f32,
    falling: bool,
    broken_ns: u64,
    settling_ns: f64,
    crosstalk: f32,
    mates: Vec<Vec<u16>>,
    /// Sneak paths, for passive matrices.
    sneak: Option<Sneak>,
    dnl: bool,
    /// Noise proportional to the signal, share per unit of [`unit_noise`].
    live: f32,
    /// Reciprocal of the force with half the linear signal, 1/N.
    bend: f32,
}

#[derive(Debug, Clone)]
struct Taxel {
    base: f32,
    gain: f32,
    drift_per_ns: f32,
    key: u64,
    x: i16,
    y: i16,
    panel: u8,
    fault: Fault,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Fault {
    None,
    Dead,
    Open,
    Shorted,
    Stuck(u16),
    /// Counts per unit of [`unit_noise`].
    Noisy(f32),
}

impl World {
    /// World of a valid script on a garment. Errors name the script and the key.
    pub fn build(script: &Script, garment: &Garment) -> Result<World, ScriptError> {
        let layout = Layout::build(garment, usize::from(u16::MAX), FULL_SCALE)
            .map_err(|why| ScriptError::Garment { garment: garment.name.to_string(), why })?;
        let place = || format!("in script {}", script.name);
        script.check().map_err(|error| error.inside(place()))?;
        let crosstalk = script.wiring.crosstalk as f32;
        let rms = hypot(script.idle.noise_counts, script.converter.noise_counts);
        let mut world = World {
            taxels: taxels(script, &layout),
            pressure: Pressure::build(script, &layout)?,
            noise: rms as f32 / UNIT_NOISE_RMS,
            falling: garment.wiring.falling,
            broken_ns: (script.faults.from_s * 1e9) as u64,
            settling_ns: script.wiring.settling_ns(),
            crosstalk,
            mates: Vec::new(),
            sneak: None,
            dnl: script.converter.dnl,
            live: script.sensor.noise as f32 / UNIT_NOISE_RMS,
            bend: if script.sensor.half_n > 0.0 { (1.0 / script.sensor.half_n) as f32 } else { 0.0 },
        };
        if crosstalk > 0.0 {
            world.mates = mates(garment, &Decoder::build(garment), layout.taxels());
        }
        if script.wiring.passive {
            world.sneak = Some(Sneak::build(garment, &Decoder::build(garment), layout.taxels()));
        }
        world.break_taxels(script)?;
        Ok(world)
    }

    fn break_taxels(&mut self, script: &Script) -> Result<(), ScriptError> {
        let faults = &script.faults;
        let mut set = |key: &'static str, taxel: u16, fault: Fault| {
            let count = self.taxels.len();
            let Some(slot) = self.taxels.get_mut(usize::from(taxel)) else {
                let name = &script.name;
                let text =
                    format!("in script {name}: `faults.{key}` names taxel {taxel}, the garment has {count}");
                return Err(ScriptError::value(key, text));
            };
            slot.fault = fault;
            Ok(())
        };
        faults.dead.iter().try_for_each(|t| set("dead", *t, Fault::Dead))?;
        faults.open.iter().try_for_each(|t| set("open", *t, Fault::Open))?;
        faults.shorted.iter().try_for_each(|t| set("shorted", *t, Fault::Shorted))?;
        faults.stuck.iter().try_for_each(|s| set("stuck", s.taxel, Fault::Stuck(s.code.min(FULL_SCALE))))?;
        let noise = |counts: f32| Fault::Noisy(counts.max(0.0) / UNIT_NOISE_RMS);
        faults.noisy.iter().try_for_each(|n| set("noisy", n.taxel, noise(n.counts)))?;
        let mut whole: Vec<usize> = (0..self.taxels.len())
            .filter(|i| self.taxels.get(*i).is_some_and(|t| t.fault == Fault::None))
            .collect();
        Rng::with_seed(script.seed ^ 0xdead).shuffle(&mut whole);
        for index in whole.into_iter().take(usize::from(faults.dead_count)) {
            if let Some(taxel) = self.taxels.get_mut(index) {
                taxel.fault = Fault::Dead;
            }
        }
        Ok(())
    }

    /// Takes what a hand does from a time on.
    pub(super) fn act(&mut self, act: Act, t_ns: u64) {
        self.pressure.forget(t_ns);
        // What has no place on the garment presses nothing: whoever plays it has checked it.
        let _ = match act {
            Act::Touch(number, touch) => self.pressure.touch(number, &touch),
            Act::Trace { number, trace, lasts } => self.pressure.trace(number, &trace, lasts),
            Act::Draw { number, path, lasts } => {
                self.pressure.draw(number, path, lasts);
                Ok(())
            }
        };
    }

    /// Number of taxels.
    pub fn taxels(&self) -> usize {
        self.taxels.len()
    }

    /// Force on a taxel at a time, N; 0 for a number past the last.
    pub fn newtons(&self, taxel: usize, t_ns: u64) -> f32 {
        let Some(t) = self.taxels.get(taxel) else { return 0.0 };
        self.pressure.newtons(usize::from(t.panel), i32::from(t.x), i32::from(t.y), t_ns)
    }

    /// Code of a taxel at a time on a settled line; 0 for a number past the last.
    #[inline]
    pub fn code(&self, taxel: usize, t_ns: u64) -> u16 {
        let Some(t) = self.taxels.get(taxel) else { return 0 };
        self.convert(t, self.signal(taxel, t, t_ns), t_ns)
    }

    /// True if the code of a taxel depends on earlier samples.
    pub fn settles(&self) -> bool {
        self.settling_ns > 0.0
    }

    /// Code of a taxel, or of an open input, on a line that has been settling since `changed_ns`.
    pub(super) fn sample(&self, line: &mut Line, taxel: Option<usize>, changed_ns: u64, t_ns: u64) -> u16 {
        let found = taxel.and_then(|index| Some((index, self.taxels.get(index)?)));
        let target = match found {
            Some((index, t)) => self.signal(index, t, t_ns),
            None => self.level(0.0),
        };
        let signal =
            if self.settles() { line.settle(target, changed_ns, t_ns, self.settling_ns) } else { target };
        match found {
            Some((_, t)) => self.convert(t, signal, t_ns),
            None => round(signal),
        }
    }

    /// Settled signal at the converter's input, counts.
    #[inline]
    fn signal(&self, index: usize, t: &Taxel, t_ns: u64) -> f32 {
        if t.fault != Fault::None && t_ns >= self.broken_ns {
            match t.fault {
                Fault::Open => return self.level(0.0),
                Fault::Shorted => return self.level(f32::from(FULL_SCALE)),
                Fault::Dead => return self.level(t.base),
                Fault::None | Fault::Stuck(_) | Fault::Noisy(_) => {}
            }
        }
        let mut newtons = self.pressure.newtons(usize::from(t.panel), i32::from(t.x), i32::from(t.y), t_ns);
        if let Some(mates) = self.mates.get(index) {
            newtons +=
                self.crosstalk * mates.iter().map(|m| self.newtons(usize::from(*m), t_ns)).sum::<f32>();
        }
        if let Some(sneak) = &self.sneak {
            newtons += sneak.newtons(index, |taxel| self.newtons(taxel, t_ns));
        }
        let felt = t.gain * newtons;
        let bent = felt / (1.0 + self.bend * felt);
        let noisy = if self.live > 0.0 {
            bent * (1.0 + self.live * unit_noise(!t.key, t_ns / CLOTH_NS))
        } else {
            bent
        };
        self.level(t.base + t.drift_per_ns * t_ns as f32 + COUNTS_PER_NEWTON * noisy)
    }

    /// Level at the input for this conductance; pressure may lower it.
    fn level(&self, rising: f32) -> f32 {
        let rising = rising.clamp(0.0, f32::from(FULL_SCALE));
        if self.falling { f32::from(FULL_SCALE) - rising } else { rising }
    }

    #[inline]
    fn convert(&self, t: &Taxel, signal: f32, t_ns: u64) -> u16 {
        if let Fault::Stuck(code) = t.fault
            && t_ns >= self.broken_ns
        {
            return code;
        }
        let noise = match t.fault {
            Fault::Noisy(noise) if t_ns >= self.broken_ns => noise,
            _ => self.noise,
        };
        let noisy = if noise > 0.0 { signal + noise * unit_noise(t.key, t_ns) } else { signal };
        round(if self.dnl { uneven(noisy) } else { noisy })
    }
}

/// Nearest code; an `as` conversion saturates.
#[inline]
fn round(signal: f32) -> u16 {
    ((signal + 0.5) as u16).min(FULL_SCALE)
}

/// Normal distribution, mean 0, standard deviation 1, at most 6.
fn normal(rng: &mut Rng) -> f64 {
    (0..12).map(|_| rng.f64()).sum::<f64>() - 6.0
}

fn taxels(script: &Script, layout: &Layout) -> Vec<Taxel> {
    let mut rng = Rng::with_seed(script.seed);
    let mut gains = Rng::with_seed(script.seed ^ 0x6761_696e);
    let idle = &script.idle;
    (0..layout.taxels())
        .filter_map(|number| layout.place(number))
        .map(|place| {
            let absent = layout.is_absent(place.panel, place.row, place.column);
            Taxel {
                base: (idle.base_code + idle.spread_counts * normal(&mut rng)).max(0.0) as f32,
                gain: (1.0 + script.sensor.gain_spread * normal(&mut gains)).max(0.0) as f32,
                drift_per_ns: (idle.drift_counts_per_s * (0.5 + rng.f64()) / 1e9) as f32,
                key: rng.u64(..) | 1,
                x: place.column as i16,
                y: place.row as i16,
                panel: place.panel,
                fault: if absent { Fault::Open } else { Fault::None },
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn world(text: &str) -> World {
        let script = format!("duration_s = 9\n{text}").parse::<Script>().unwrap();
        World::build(&script, &Garment::reference()).unwrap()
    }

    const STILL: &str = "[idle]\nbase_code = 100\nspread_counts = 0\nnoise_counts = 0\n";
    const BALL: &str =
        "[[touch]]\npanel = \"chest\"\nshape = \"ball\"\nat = [8, 16]\nstart_s = 0\nrise_s = 0\nhold_s = 5\n";

    #[test]
    fn noise_has_its_mean_and_size_in_time_and_over_taxels() {
        let noisy = world("[idle]\nbase_code = 2000\nspread_counts = 0\nnoise_counts = 3\n");
        let check = |codes: Vec<f64>| {
            let n = codes.len() as f64;
            let mean = codes.iter().sum::<f64>() / n;
            let variance = codes.iter().map(|c| (c - mean) * (c - mean)).sum::<f64>() / n;
            // Rounding adds 1/12.
            assert!(
                (mean - 2000.0).abs() < 0.15 && (variance / (9.0 + 1.0 / 12.0) - 1.0).abs() < 0.06,
                "{mean} {variance}"
            );
        };
        check((0..4000).map(|k| f64::from(noisy.code(77, k * 5_128_000 + 2_000))).collect());
        check((0..2048).map(|taxel| f64::from(noisy.code(taxel, 10_000))).collect());
        check(
            (0..2048)
                .map(|i| f64::from(noisy.code(i / 4 + 512 * (i % 4), (i as u64 / 4) * 10_000)))
                .collect(),
        );
    }

    #[test]
    fn codes_are_linear_then_full() {
        let total = |force: &str| {
            let w = world(&format!("{STILL}{BALL}force_n = {force}\n"));
            (0..2048).map(|t| u32::from(w.code(t, 1_000_000_000)) - 100).sum::<u32>()
        };
        assert!((f64::from(total("3")) / 3_000.0 - 1.0).abs() < 0.02, "{}", total("3"));
        assert!((f64::from(total("10")) / 10_000.0 - 1.0).abs() < 0.01);
        let hard = world(&format!("{STILL}{BALL}force_n = 5000\n"));
        assert_eq!(hard.code(16 * 16 + 8, 1_000_000_000), 4095);
        assert_eq!(hard.code(16 * 16 + 8, 6_000_000_000), 100);
    }

    #[test]
    fn faults_show_from_their_time_on() {
        let w = world(&format!(
            "{STILL}{BALL}force_n = 100\n[faults]\nfrom_s = 1\ndead = [264]\nopen = [265]\nshorted = [266]\nstuck = [{{ taxel = 267, code = 7 }}]\n"
        ));
        let at = |t_ns| [264, 265, 266, 267].map(|taxel| w.code(taxel, t_ns));
        assert!(at(900_000_000).iter().all(|c| *c > 100 && *c < 4095));
        assert_eq!(at(1_100_000_000), [100, 0, 4095, 7]);
        let some = world(&format!("{STILL}[faults]\ndead_count = 9\n"));
        assert_eq!(some.taxels.iter().filter(|t| t.fault == Fault::Dead).count(), 9);
        let script = "name = \"a\"\nduration_s = 1\n[faults]\nopen = [2048]".parse::<Script>().unwrap();
        let error = World::build(&script, &Garment::reference()).unwrap_err().to_string();
        assert_eq!(error, "in script a: `faults.open` names taxel 2048, the garment has 2048");
    }

    #[test]
    fn drift_and_falling_codes() {
        let w =
            world("[idle]\nbase_code = 100\nspread_counts = 0\nnoise_counts = 0\ndrift_counts_per_s = 10\n");
        let drifted: Vec<u16> = (0..2048).map(|t| w.code(t, 8_000_000_000) - 100).collect();
        assert!(drifted.iter().all(|d| (39..=121).contains(d)));
        let mut garment = Garment::reference();
        garment.wiring.falling = true;
        let script = format!("duration_s = 1\n{STILL}{BALL}force_n = 90\n").parse::<Script>().unwrap();
        let falling = World::build(&script, &garment).unwrap();
        assert_eq!(falling.code(0, 0), 3995);
        assert!(falling.code(16 * 16 + 8, 1_000_000_000) < 3800);
    }
}
