//! Frames of a scene without pins, for benchmarks, campaigns and the emulator of the real board.

use super::decode::Decoder;
use super::error::ScriptError;
use super::script::Script;
use super::signal::World;
use super::wiring::Line;
use serde_json::{Value, json};
use taxel_core::acquire::Rounds;
use taxel_core::garment::{Circuit, Garment, Layout};

/// Frame period of the reference board, us: 195 frames per second, see [`Rounds`].
pub const FRAME_PERIOD_US: u64 = 5_128;

/// Most select lines of a garment in the emulator, whose table has an entry for every word.
const MOST_LINES: usize = 16;

/// Plays a script frame by frame: the codes of full scans by the simulated board.
#[derive(Debug, Clone)]
pub struct Player {
    world: World,
    samples: Vec<Sample>,
    lines: Vec<Line>,
}

/// One sample of a scan.
#[derive(Debug, Clone)]
struct Sample {
    taxel: u16,
    input: u8,
    /// Time from the start of the scan to the change of address, and to the sample, ns.
    changed_ns: u64,
    sampled_ns: u64,
}

impl Player {
    /// A script on a garment, read as by the reference board.
    pub fn new(script: &Script, garment: &Garment) -> Result<Player, ScriptError> {
        if garment.blocks.is_empty() {
            let name = &garment.name;
            return Err(ScriptError::Unfit(format!(
                "garment {name}: it has no blocks, so it cannot be scanned"
            )));
        }
        let decoder = Decoder::build(garment);
        let rounds = Rounds::of(decoder.inputs().len(), garment.wiring.settle_ns);
        let mut samples = Vec::new();
        let mut changed_ns = 0;
        for address in decoder.addresses() {
            for input in 0..decoder.inputs().len() {
                if let Some(taxel) = decoder.taxel(address, input) {
                    let sampled_ns = changed_ns + rounds.settling_ns() + input as u64 * rounds.period_ns();
                    samples.push(Sample { taxel: taxel as u16, input: input as u8, changed_ns, sampled_ns });
                }
            }
            changed_ns += rounds.address_ns();
        }
        let lines = vec![Line::default(); decoder.inputs().len()];
        Ok(Player { world: World::build(script, garment)?, samples, lines })
    }

    /// Number of taxels: the length of a frame.
    pub fn taxels(&self) -> usize {
        self.world.taxels()
    }

    /// The simulated world.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Reads the frame whose scan starts at this time (us since the board's start), by taxel. Taxels without
    /// a block, or beyond the end of `codes`, are not changed.
    pub fn frame(&mut self, start_us: u64, codes: &mut [u16]) {
        let start = start_us.saturating_mul(1000);
        for sample in &self.samples {
            let (taxel, now) = (usize::from(sample.taxel), start + sample.sampled_ns);
            let code = match self.lines.get_mut(usize::from(sample.input)) {
                Some(line) if self.world.settles() => {
                    self.world.sample(line, Some(taxel), start + sample.changed_ns, now)
                }
                _ => self.world.code(taxel, now),
            };
            if let Some(slot) = codes.get_mut(taxel) {
                *slot = code;
            }
        }
    }
}

/// `count` frames, one after the other, each with all taxels in order: those of the simulated board if a scan
/// starts every `frame_period_us`, with each taxel at the time of its own sample.
pub fn frame_codes(
    script: &Script,
    garment: &Garment,
    frame_period_us: u64,
    count: usize,
) -> Result<Vec<u16>, ScriptError> {
    let mut player = Player::new(script, garment)?;
    let mut codes = vec![0; player.taxels() * count];
    for (frame, chunk) in codes.chunks_mut(player.taxels()).enumerate() {
        player.frame(frame as u64 * frame_period_us, chunk);
    }
    Ok(codes)
}

/// The wiring for the emulator's harness: `lines` with pin and polarity in the order of the circuit's bits,
/// `inputs` (GPIO numbers), `taxels` by word of asserted lines (bit 0 is the first line; the level word if no
/// line is inverted), one entry per input, -1 if unconnected, and `count`.
pub fn wiring_json(garment: &Garment, layout: &Layout, circuit: &Circuit) -> Result<Value, ScriptError> {
    let pins = circuit.lines();
    if pins.len() > MOST_LINES {
        return Err(ScriptError::Unfit(format!(
            "garment {}: the emulator takes at most {MOST_LINES} select lines, `wiring` has {}",
            garment.name,
            pins.len()
        )));
    }
    let decoder = Decoder::build(garment);
    let inverted = circuit.idle_word();
    let mut last = 0;
    let mut taxels: Vec<Vec<i64>> = (0..1u32 << pins.len())
        .map(|word| {
            let on = |bit: usize| u64::from((word ^ inverted) >> bit & 1);
            let levels = pins.iter().enumerate().fold(0, |levels, (bit, pin)| levels | on(bit) << pin);
            let address = decoder.address(levels);
            let at =
                |input| address.and_then(|address| decoder.taxel(address, input)).map_or(-1, |t| t as i64);
            let row: Vec<i64> = (0..decoder.inputs().len()).map(at).collect();
            if row.iter().any(|taxel| *taxel >= 0) {
                last = word as usize;
            }
            row
        })
        .collect();
    taxels.truncate(last + 1);
    let lines: Vec<Value> = pins
        .iter()
        .enumerate()
        .map(|(bit, pin)| json!({ "pin": pin, "inverted": inverted >> bit & 1 == 1 }))
        .collect();
    Ok(json!({ "lines": lines, "inputs": decoder.inputs(), "taxels": taxels, "count": layout.taxels() }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::garment::{Line as Pin, Pins};

    fn wiring(garment: &Garment) -> Value {
        let layout = Layout::build(garment, 2048, 4095).unwrap();
        let circuit = Circuit::build(garment, &layout, Pins::ANY).unwrap();
        wiring_json(garment, &layout, &circuit).unwrap()
    }

    #[test]
    fn the_emulator_gets_every_taxel_once() {
        let mut one_hot = Garment::block();
        one_hot.wiring.row.coding = taxel_core::garment::Coding::OneHot;
        one_hot.wiring.row.lines = (16..20).map(|pin| Pin { pin, inverted: pin == 17 }).collect();
        one_hot.wiring.enable.push(Pin { pin: 20, inverted: true }).unwrap();
        for garment in [Garment::reference(), Garment::mat(), one_hot] {
            let value = wiring(&garment);
            let mut taxels: Vec<i64> = value["taxels"]
                .as_array()
                .unwrap()
                .iter()
                .flat_map(|row| row.as_array().unwrap().iter().map(|t| t.as_i64().unwrap()))
                .filter(|t| *t >= 0)
                .collect();
            taxels.sort_unstable();
            assert!(taxels.iter().copied().eq(0..value["count"].as_i64().unwrap()));
        }
        let value = wiring(&Garment::reference());
        assert_eq!(value["lines"][0], json!({ "pin": 2, "inverted": false }));
        assert_eq!(value["inputs"], json!([26, 27, 28, 29]));
        // Block 1, row 2, column 5: bits 0, 4, 5 and 7.
        assert_eq!(value["taxels"][0b0_1011_0001], json!([101, 613, 1125, 1637]));
    }

    #[test]
    fn the_wiring_of_inverted_lines_counts_asserted_lines() {
        let mut garment = Garment::block();
        garment.wiring.row = Garment::reference().wiring.row;
        garment.wiring.row.lines[0].inverted = true;
        let value = wiring(&garment);
        assert_eq!(value["lines"][0]["inverted"], json!(true));
        assert_eq!(value["taxels"][0], json!([0]));
        assert_eq!(value["taxels"][1], json!([16]));
    }

    #[test]
    fn a_garment_without_blocks_is_refused() {
        let script = "duration_s = 1".parse::<Script>().unwrap();
        let error = Player::new(&script, &Garment::recorded(4, 4)).unwrap_err();
        assert_eq!(error.to_string(), "garment recorded: it has no blocks, so it cannot be scanned");
    }
}
