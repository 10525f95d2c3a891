//! A moment of a recording is the same after any jump.

use super::stage::{Moment, PROGRAM, View, file, moments, recorded};
use serde_json::{Value, json};
use taxel::client::{Client, Event, Stamps};
use taxel::record::{Plan, PlannedBoard, Recorder};
use taxel::recording::{WIRE, chunk_indexes, repair, scan};
use taxel::session::Observer;

/// The frame shown at a time.
fn at(all: &[Moment], seconds: f64) -> &Moment {
    all.iter().rfind(|moment| moment.at as f64 <= (seconds * 1e6).round()).unwrap_or(&all[0])
}

/// Touch data of a frame; counters of the line restart at a jump, so they are left out.
fn touch(line: &Value) -> [Value; 4] {
    ["frame", "time_us", "contacts", "intent"].map(|part| line[part].clone())
}

#[test]
fn any_moment_is_that_of_a_recording_played_from_its_beginning() {
    let path = recorded("moments.mcap", "sim:pat", 12, &[]);
    let (all, view) = (moments(&path), View::start(&[path.to_str().unwrap()]));
    let mut page = view.page();
    let mut seeks = page.stand();
    // Far ahead at once, before the survey of the file, and again after it.
    for round in 0..2 {
        for seconds in [11.9, 0.3, 6.0, 0.55, 0.62, 0.931, 1.2, 0.0, 0.64, 3.217, 5000.0] {
            let (line, image, health) = page.seek(seconds, &mut seeks);
            let wanted = at(&all, seconds);
            assert_eq!(touch(&line), touch(&wanted.line), "{seconds} s, round {round}");
            assert_eq!(image, wanted.image, "{seconds} s");
            assert_eq!(health, wanted.health, "{seconds} s");
            assert_eq!(line["at_us"], wanted.at);
        }
        page.overview();
    }
    assert!(at(&all, 0.64).line["contacts"].as_array().is_some_and(|contacts| !contacts.is_empty()));
}

#[test]
fn nothing_is_felt_once_the_board_of_a_recording_is_lost() {
    let path = file("lost.mcap");
    let plan = Plan { force: true, ..Plan::of(&path, PlannedBoard::default()) };
    let (recorder, mut session) = (Recorder::create(plan).unwrap(), taxel::open("sim:press").unwrap());
    let (mut board, mut stamps) = (recorder.board(0), Stamps::start());
    let mut record = |client: &Client, event: &Event| {
        let stamp = stamps.of(client, event);
        board.event(client, event, stamp).unwrap();
    };
    loop {
        let event = session.wait().unwrap().expect("it presses");
        record(session.client(), &event);
        if matches!(event, Event::Frame { .. }) && !session.client().contacts().is_empty() {
            break;
        }
    }
    session.parts().0.lost("it is gone".into(), 5);
    while let Some(event) = session.note() {
        record(session.client(), &event);
    }
    recorder.finish().unwrap();
    let view = View::start(&[path.to_str().unwrap()]);
    let mut page = view.page();
    page.stand();
    page.ask(json!({ "seek": 5000.0 }));
    let touches = |line: &Value| line["contacts"].as_array().is_some_and(|all| !all.is_empty());
    let all = moments(&path);
    let pressed = all.last().unwrap();
    assert!(touches(&pressed.line) && pressed.image.iter().any(|value| *value > 0));
    let (lost, image) = page.image(|line| line["at_us"].as_u64() >= Some(pressed.at) && !touches(line));
    assert!(image.iter().all(|value| *value == 0));
    assert_eq!((&lost["intent"]["leading"], &lost["frame"]), (&json!("none"), &pressed.line["frame"]));
}

#[test]
fn the_moments_of_a_board_are_found_in_the_recording_of_a_robot() {
    let (robot, path) = (file("robot.toml"), file("robot.mcap"));
    let boards = ["torso\"\nsource = \"sim:five", "hand\"\nsource = \"sim:press\"\ngarment = \"block-4x16"];
    let boards = boards.map(|board| format!("[[boards]]\nname = \"{board}\"\n")).concat();
    std::fs::write(&robot, format!("name = \"two\"\n{boards}")).unwrap();
    let mut record = std::process::Command::new(PROGRAM);
    record.args(["record", "--for", "4s", "--force", "-o"]).args([&path, &robot]);
    assert!(record.stderr(std::process::Stdio::null()).status().unwrap().success());
    for board in ["torso", "hand"] {
        let part = format!("{}#{board}", path.display());
        let (all, view) = (moments(part.as_ref()), View::start(&[&part]));
        assert!(all.len() > 700, "{}", all.len());
        let mut page = view.page();
        let mut seeks = page.stand();
        for round in 0..2 {
            for seconds in [3.9, 0.3, 1.2, 2.0, 0.0, 3.217] {
                let (line, image, health) = page.seek(seconds, &mut seeks);
                let wanted = at(&all, seconds);
                assert_eq!(touch(&line), touch(&wanted.line), "{board}, {seconds} s, round {round}");
                assert_eq!(
                    (image, health),
                    (wanted.image.clone(), wanted.health.clone()),
                    "{board}, {seconds} s"
                );
            }
            page.overview();
        }
    }
}

#[test]
fn steps_go_from_image_to_image_both_ways() {
    let path = recorded("steps.mcap", "sim:lash", 4, &[]);
    let (all, view) = (moments(&path), View::start(&[path.to_str().unwrap()]));
    let mut page = view.page();
    let mut seeks = page.stand();
    page.seek(2.0, &mut seeks);
    let mut index = all.iter().rposition(|moment| moment.at <= 2_000_000).unwrap();
    for steps in [1i64, 1, -1, -1, -1, 300, -700, 5] {
        page.ask(json!({ "step": steps }));
        seeks += 1;
        let (line, image) = page.image(|line| line["seeks"] == seeks);
        index = (index as i64 + steps).clamp(0, all.len() as i64 - 1) as usize;
        assert_eq!((touch(&line), &image), (touch(&all[index].line), &all[index].image), "{steps}");
    }
}

#[test]
fn what_is_played_is_the_recording_in_its_own_time_and_the_loop_begins_again() {
    let path = recorded("played.mcap", "sim:lash", 3, &[]);
    let (all, view) = (moments(&path), View::start(&[path.to_str().unwrap()]));
    let mut page = view.page();
    page.stand();
    page.ask(json!({ "range": [0.3, 0.6] }));
    page.ask(json!({ "loop": true }));
    page.ask(json!({ "speed": 0.5 }));
    page.ask(json!({ "seek": 0.3 }));
    page.ask(json!({ "play": true }));
    page.line("player", |line| line["playing"] == true && line["speed"] == 0.5);
    let (begun, mut rounds, mut last, mut first) = (std::time::Instant::now(), 0, 0, None);
    while rounds < 3 {
        let (line, image) = page.image(|_| true);
        let at = line["at_us"].as_u64().unwrap();
        let wanted = all.iter().find(|moment| moment.at == at).unwrap();
        assert_eq!((touch(&line), &image), (touch(&wanted.line), &wanted.image));
        assert!(at <= 600_000, "{at}");
        first.get_or_insert(at);
        if at < last {
            rounds += 1;
            assert!((294_000..=330_000).contains(&at), "the range begins with {at}");
        }
        last = at;
    }
    // Three rounds of 0.3 s at half the speed.
    let seconds = begun.elapsed().as_secs_f64();
    assert!((1.2..6.0).contains(&seconds), "{seconds} s");
}

#[test]
fn a_recording_without_its_first_chunk_is_shown() {
    let path = recorded("first.mcap", "sim:pat", 6, &[]);
    let first = &chunk_indexes(&path).unwrap()[0];
    let mut bytes = std::fs::read(&path).unwrap();
    bytes[(first.chunk_start_offset + first.chunk_length) as usize - 40] ^= 1;
    std::fs::write(&path, bytes).unwrap();
    let mut bytes = Vec::new();
    repair(&path, &scan(&path).unwrap(), &mut bytes).unwrap();
    let repaired = file("first.repaired.mcap");
    std::fs::write(&repaired, bytes).unwrap();
    let (all, view) = (moments(&repaired), View::start(&[repaired.to_str().unwrap()]));
    assert!(all.len() > 300, "{} images", all.len());
    let mut page = view.page();
    let mut seeks = page.stand();
    for seconds in [3.0, 0.5, 4.2] {
        let (line, image, _) = page.seek(seconds, &mut seeks);
        let wanted = at(&all, seconds);
        assert_eq!((touch(&line), image), (touch(&wanted.line), wanted.image.clone()), "{seconds} s");
    }
}

#[test]
fn messages_outside_of_chunks_are_refused_by_name() {
    let path = file("loose.mcap");
    let mut out = std::io::BufWriter::new(std::fs::File::create(&path).unwrap());
    let options = mcap::WriteOptions::new().use_chunks(false).compression(None);
    let mut writer = options.create(&mut out).unwrap();
    let channel = writer.add_channel(0, WIRE, "taxel-wire", &Default::default()).unwrap();
    let header =
        mcap::records::MessageHeader { channel_id: channel, sequence: 0, log_time: 1, publish_time: 1 };
    writer.write_to_known_channel(&header, &[0]).unwrap();
    writer.finish().unwrap();
    drop(writer);
    drop(out);
    let mut view = std::process::Command::new(PROGRAM);
    let done = view.args(["view", "--port", "0"]).arg(&path).output().unwrap();
    let said = String::from_utf8_lossy(&done.stderr);
    assert_eq!(done.status.code(), Some(1), "{said}");
    assert!(said.contains("loose.mcap cannot be read: it has messages outside of chunks"), "{said}");
}

#[test]
fn what_was_felt_just_before_a_moment_glows_in_it() {
    let path = recorded("glow.mcap", "sim:lash", 4, &[]);
    let (all, view) = (moments(&path), View::start(&[path.to_str().unwrap()]));
    let total = |moment: &&Moment| moment.image.iter().map(|value| u64::from(*value)).sum::<u64>();
    let lash = all.iter().max_by_key(total).unwrap().at;
    let mut page = view.page();
    let stood = page.stand();
    // During the lash, 200 ms after it, and after the glow has faded.
    for (seeks, (later, glows)) in (stood + 1..).zip([(0, true), (200_000, true), (1_900_000, false)]) {
        let shown = all.iter().rfind(|moment| moment.at <= lash + later).unwrap();
        page.ask(json!({ "seek": (lash + later) as f64 / 1e6 }));
        let line = page.line("glow", |line| line["seeks"] == seeks);
        assert_eq!(line["time_us"], shown.line["time_us"]);
        let mut wanted = vec![0; shown.image.len()];
        for moment in all.iter().filter(|m| m.at <= shown.at && m.at + 800_000 >= shown.at) {
            let left = 800_000 - (shown.at - moment.at);
            for (glow, value) in wanted.iter_mut().zip(&moment.image) {
                *glow = u64::max(*glow, u64::from(*value) * left / 800_000);
            }
        }
        let wanted: Vec<_> = wanted.iter().enumerate().filter(|(_, counts)| **counts > 0).collect();
        assert_eq!(line["taxels"], json!(wanted), "{later} us after the lash");
        assert_eq!(!wanted.is_empty(), glows, "{later} us after the lash");
    }
}

#[test]
fn headline_and_bars_are_of_one_moment() {
    let path = recorded("headline.mcap", "sim:pat", 4, &[]);
    let led = |line: &Value| {
        let leading = line["intent"]["leading"].as_str().unwrap();
        (leading != "none").then(|| line["intent"]["concepts"][leading].as_f64().unwrap())
    };
    let all = moments(&path);
    let bars: Vec<f64> = all.iter().filter_map(|moment| led(&moment.line)).collect();
    assert!(bars.len() > 100 && bars.iter().all(|bar| *bar > 0.1), "a headline stands over an empty bar");
}

#[test]
fn a_recording_is_shown_on_a_robot() {
    let path = recorded("robot.mcap", "sim:five", 2, &[]);
    let view = View::start(&[path.to_str().unwrap(), "--body", "reference", "--robot", "reference"]);
    let mut page = view.page();
    page.line("body", |body| body["name"] == "reference");
    page.line("poses", |_| true);
    let (image, _) = page.image(|frame| frame["contacts"].as_array().unwrap().len() == 5);
    assert_eq!(image["pressing"]["frame"], image["frame"]);
    assert_eq!(image["pressing"]["contacts"].as_array().unwrap().len(), 5);
    // The garment of the recording has no such panel; nor does a recorded robot move now.
    let failed = |arguments: &[&str]| {
        let mut program = std::process::Command::new(PROGRAM);
        let output = program.args(["view", path.to_str().unwrap()]).args(arguments).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let body = file("mat.toml");
    std::fs::write(
        &body,
        "[[patches]]\npanel = \"mat\"\non.plane = { at = [0, 0, 0], normal = [1, 0, 0], down = [0, 0, -1] }",
    )
    .unwrap();
    let (status, why) = failed(&["--body", body.to_str().unwrap()]);
    assert_eq!(status, Some(1));
    assert!(
        why.contains("mat.toml, line 2") && why.contains("must be a panel of the garment: chest"),
        "{why}"
    );
    let (status, why) = failed(&["--body", "reference", "--robot", "reference", "--joint-states", "-"]);
    assert!(status == Some(2) && why.contains("is a recording, whose robot does not move now"), "{why}");
    let (status, why) = failed(&["--body", "reference", "--robot", "reference", "--joints", "waits=3deg"]);
    assert!(status == Some(2) && why.contains("there is no joint \"waits\""), "{why}");
    let (status, why) = failed(&["--robot", "reference"]);
    assert!(status == Some(2) && why.contains("--body"), "{why}");
}
