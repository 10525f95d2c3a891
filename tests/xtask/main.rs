//! `cargo xtask`: what cargo alone does not do. Runs without dependencies, so that it is built in a second.

mod browser;
mod campaign;
mod checks;
mod counts;
mod cross;
mod elf;
mod excerpt;
mod firmware;
mod fuzz;
mod install;
mod locks;
mod mutants;
mod names;
mod no_panic;
mod paths;
mod process;
mod recordings;
mod report;
mod sizes;
mod supply;
mod targets;
mod uf2;
mod ways;

use std::process::ExitCode;

const USAGE: &str = "\
usage: cargo xtask COMMAND

  firmware [--write]    build the firmware: an ELF for debug probes, a UF2 to drop on the board's drive;
                        --write: and write down its sizes, docs/bench/sizes.txt
  core-thumb            build the core for the microcontroller
  emulator [ARGS]       build the firmware and run it in the emulator; ARGS go to tests/emulator/emulator.mjs
  cycles [--json|--write]
                        what the chain costs on the emulated board, beside its error; --write renews docs/bench
  recorded [--all]      feed every recorded frame of pmatdata and smart_garment, or of every folder, through the pipeline
  peers [--json|--write]
                        the core beside imageproc, and OpenCV where Python has it: microseconds per panel
  campaign [--only NAME] [--write]
                        long runs on the emulated and the simulated board; --write: and write down what they print, docs/bench/campaign.txt
  fuzz [--minutes N] [TARGET...]
                        each fuzz target, or these, for 10 minutes or N, with AddressSanitizer; needs a nightly compiler
  mutants [--count N] [--seed S] [--write]
                        change the core and the store in N places (200), chosen by a seed, one at a time: do the tests notice?
                        --write: and write it down, docs/bench/mutants.txt
  soak [--minutes N]    boards that break and come back, recorded, watched and set anew for 20 minutes, or N: what grows, what is lost?
  supply [--may-miss advisories]
                        what dependencies are: sources, licences, advisories; and lists of them, target/sbom
  test [--recorded] [--only NAME] [--may-miss NAME]
                        every check, two at a time; one that cannot run fails the run, unless it is named as one that may be missing;
                        --recorded, or TAXEL_DATA set to folders of recordings: and those that need recordings

TAXEL_CROSS chooses the compiler for the board: rust-src, debian or target
";

/// Builds the firmware, says how large it is, and writes that down if it is asked to.
fn build_firmware(args: &[String]) -> Result<(), String> {
    let write = match args {
        [] => false,
        [write] if write == "--write" => true,
        _ => return Err(USAGE.into()),
    };
    let built = firmware::build()?;
    print!("{built}");
    if write { sizes::write(&built) } else { Ok(()) }
}

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let rest = args.get(1..).unwrap_or(&[]);
    let done = match args.first().map(String::as_str) {
        Some("firmware") => build_firmware(rest).map(|()| true),
        Some("core-thumb") => firmware::build_core().map(|()| true),
        Some("emulator") => firmware::emulate(rest).map(|()| true),
        Some("cycles") => targets::show_cycles(rest).map(|()| true),
        Some("recorded") => targets::feed_recordings(rest).map(|()| true),
        Some("peers") => targets::peers(rest).map(|()| true),
        Some("campaign") => campaign::run(rest).map(|()| true),
        Some("fuzz") => fuzz::run(rest),
        Some("mutants") => mutants::run(rest).map(|()| true),
        Some("soak") => targets::soak(rest).map(|()| true),
        Some("supply") => supply::run(rest),
        Some("test") => checks::run(rest),
        _ => Err(USAGE.to_string()),
    };
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}
