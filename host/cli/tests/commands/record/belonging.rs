//! Messages that bring no event of their own, because they belong to the next one.

use super::replayed::replayed;
use super::stage::{file, plan, record};
use taxel::client::Client;
use taxel_core::format::Micros;
use taxel_core::wire::{Level, Log, RegionNames, Report, encode};

#[test]
fn they_are_recorded_with_the_event_that_they_belong_to() {
    let idle = record("sim:idle", plan("belonging-idle.mcap", "sim", None, false));
    let mut client = Client::new();
    let before = idle.wire.iter().take_while(|byte| {
        client.push(**byte);
        client.worn().is_none()
    });
    let hello = &idle.wire[..=before.count()];
    let first = taxel::recording::sequence(client.line()).unwrap();
    let names = Report::RegionNames(RegionNames { names: Default::default() });
    let log = Report::Log(Log { time: Micros(1), level: Level::Info, text: "on the chest" });
    let more: Vec<u8> = (first + 1..)
        .zip([&names, &names, &log])
        .flat_map(|(seq, report)| encode(&(seq, report), &mut [0; 128]).unwrap().to_vec())
        .collect();
    std::fs::write(file("belonging.bin"), [hello, &more].concat()).unwrap();
    let source = format!("file:{}", file("belonging.bin").display());
    assert!(record(&source, plan("belonging.mcap", "file", None, false)).wire.ends_with(&more));
    assert!(replayed(&file("belonging.mcap")).wire.ends_with(&more));
}
