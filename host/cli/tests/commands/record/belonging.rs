//! Messages that bring no event of their own, because they belong to the next one.

use super::replayed::replayed;
use super::stage::{file, plan, record};
use std::fs::File;
use taxel::client::Client;
use taxel::recording::{Format, WIRE, Writer};
use taxel_core::format::Micros;
use taxel_core::wire::{Level, Log, RegionNames, Report, encode};

#[test]
fn they_are_recorded_with_the_event_that_they_belong_to() {
    let idle = record("sim:idle", plan("belonging-idle.mcap", "sim", None, false));
    let mut client = Client::new();
    let before = idle.wire.iter().take_while(|byte| {
        client.push(**byte);
        client.description().is_none()
    });
    let hello = &idle.wire[..=before.count()];
    let first = taxel::recording::sequence(client.line()).unwrap();
    let names = Report::RegionNames(RegionNames { names: Default::default() });
    let log = Report::Log(Log { time: Micros(1), level: Level::Info, text: "on the chest" });
    let more: Vec<u8> = (first + 1..)
        .zip([&names, &names, &log])
        .flat_map(|(seq, report)| encode(&(seq, report), &mut [0; 128]).unwrap().to_vec())
        .collect();
    let said = file("belonging-said.mcap");
    let mut writer = Writer::create(File::create(&said).unwrap(), "").unwrap();
    let format = Format { encoding: "taxel-wire", schema: "", schema_encoding: "", text: b"" };
    let channel = writer.channel(WIRE, &format).unwrap();
    writer.message(channel, 0, 0, &[hello, &more].concat()).unwrap();
    writer.finish().unwrap();
    let source = format!("replay:{}", said.display());
    assert!(record(&source, plan("belonging.mcap", "replay", None, false)).wire.ends_with(&more));
    assert!(replayed(&file("belonging.mcap")).wire.ends_with(&more));
}
