//! `cargo xtask`: tasks beyond cargo's. It has no dependencies, so that it builds in a second.

mod aarch64;
mod boards;
mod browser;
mod campaign;
mod cargo;
mod checks;
mod counts;
mod cross;
mod docs;
mod elf;
mod end;
mod excerpt;
mod features;
mod firmware;
mod fuzz;
mod given;
mod guests;
mod install;
mod interpreter;
#[cfg(test)]
mod layers;
mod lines;
mod locks;
mod mutants;
mod names;
mod no_panic;
mod pack;
mod package;
mod paths;
mod physics;
mod process;
mod python;
mod recordings;
mod release;
mod report;
mod ros2;
mod site;
mod sizes;
mod supply;
mod targets;
mod uf2;
mod ways;
mod wheels;
mod workflows;
mod zenoh;

use std::process::ExitCode;

const USAGE: &str = "\
usage: cargo xtask COMMAND

  firmware [--write]    build the firmware: an ELF for debug probes, a UF2 to drop on the board's drive;
                        --write: also write its sizes, and those of images that leave features out, to docs/evidence/bench/sizes.txt
  core-thumb            compile the core for the microcontroller
  emulator [ARGS]       build the firmware and run it in the emulator; ARGS go to tests/emulator/emulator.mjs
  cycles [--json|--write]
                        cost and error of the chain on the emulated board; --write updates docs/evidence/bench
  bench [TABLE]         cost and error on this machine: stages, acquisition, amplifier, nmi, record, mind or boards; `bench --help` has more
  recorded [--all]      run the recorded frames of pmatdata and smart_garment, or of every folder, through the pipeline
  peers [--json|--write]
                        compare the core with imageproc, and with OpenCV if Python has it: microseconds per panel
  campaign [--only NAME] [--write]
                        long runs on the emulated and the simulated board; --write: also write their output to docs/evidence/bench/campaign.txt
  fuzz [--minutes N] [TARGET...]
                        run each fuzz target, or these, for 10 minutes or N, with AddressSanitizer; needs a nightly compiler
  mutants [--count N] [--seed S] [--write]
                        mutation tests: change the core and the store at N places (200), chosen by a seed, one at a time
                        --write: also write the result to docs/evidence/bench/mutants.txt
  mutants --missed [--write]
                        test again only what docs/evidence/bench/mutants.txt lists as missed and does not explain as equivalent
  python [--release]    build the Python package as a wheel and test it in an environment of its own;
                        --release: as it is given away
  ros2                  test the ROS 2 node against ROS, with each distribution whose Python is there
  release [--target TARGET...] [--out FOLDER]
                        make what is given away, in dist/: the program for Linux on x86-64, or these systems, Python packages,
                        firmware, message definitions, lists of dependencies with their licences, checksums
  release --compare FOLDER FOLDER
                        compare what was made in two folders, byte for byte
  soak [--minutes N]    record, watch and reconfigure failing boards for 20 minutes, or N: checks memory and losses
  supply [--may-miss advisories]
                        check dependencies: sources, licences, advisories; write lists of them to target/sbom
  site                  make the page that needs no program, in target/site: a folder for any static server
  size                  lines of the product by crate and language: not blank, no comment, no test
  package               pack the published crates, and build each from its package alone, and all with the oldest
                        dependencies allowed; compare their interfaces with the last tag. Needs a nightly compiler
  docs                  build the pages of docs/ as a book, target/docs/index.html
  test [--recorded] [--only NAME] [--may-miss NAME]
                        every check, three at a time; one that cannot run fails the run, unless it is named by --may-miss;
                        --recorded, or TAXEL_DATA set to folders of recordings: also those that need recordings

TAXEL_CROSS chooses the compiler for the board: rust-src, debian or target
";

/// Builds the firmware, prints its size, and writes the table of sizes if requested.
fn build_firmware(args: &[String]) -> Result<(), String> {
    let write = match args {
        [] => false,
        [write] if write == "--write" => true,
        _ => return Err(USAGE.into()),
    };
    let built = firmware::build()?;
    print!("{built}");
    if write { sizes::write(&built, &features::table(&paths::log("features")?)?) } else { Ok(()) }
}

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let rest = args.get(1..).unwrap_or(&[]);
    let done = match args.first().map(String::as_str) {
        Some("bench") => targets::bench(rest).map(|()| true),
        Some(_) if args.iter().any(|arg| arg == "--help") => {
            print!("{USAGE}");
            Ok(true)
        }
        Some("firmware") => build_firmware(rest).map(|()| true),
        Some("core-thumb") => firmware::check_core().map(|()| true),
        Some("emulator") => firmware::emulate(rest).map(|()| true),
        Some("cycles") => targets::show_cycles(rest).map(|()| true),
        Some("recorded") => targets::feed_recordings(rest).map(|()| true),
        Some("peers") => targets::peers(rest).map(|()| true),
        Some("site") if rest.is_empty() => site::run().map(|()| true),
        Some("size") if rest.is_empty() => lines::run().map(|()| true),
        Some("package") if rest.is_empty() => package::run().map(|()| true),
        Some("docs") if rest.is_empty() => docs::run().map(|()| true),
        Some("campaign") => campaign::run(rest).map(|()| true),
        Some("fuzz") => fuzz::run(rest),
        Some("mutants") => mutants::run(rest).map(|()| true),
        Some("python") => python::run(rest).map(|()| true),
        Some("ros2") => ros2::run(rest).map(|()| true),
        Some("release") => release::run(rest).map(|()| true),
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
