//! `taxel live` through the library: a simulated board, the wire, the client, and all three outputs.

use crate::sink::Sink;
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Color;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use taxel::client::{Client, Event, ImageNews, Stamp};
use taxel::files::bases::Base;
use taxel::json::MessagePrinter;
use taxel::recording::{Format, WIRE, Writer};
use taxel::robot::GestureModel;
use taxel::session::Observer;
use taxel::session::setting::set_shapes;
use taxel::source::{self, Source, SourceOptions};
use taxel_cli::commands::views::live::LiveArgs;
use taxel_cli::palette;
use taxel_cli::terminal::{Lines, TaxelLines, View};
use taxel_cli::watch::{BoardArgs, watch};
use taxel_core::shape::{Patch, descriptor};

fn args(source: &str, frames: Option<u64>) -> LiveArgs {
    LiveArgs { board: BoardArgs::of(source.parse().unwrap()), frames, json: true, ..LiveArgs::default() }
}

fn open(args: &LiveArgs) -> Source {
    let options = SourceOptions { frames: args.frames, seconds: args.seconds, ..SourceOptions::default() };
    args.board.open(options).unwrap().0
}

/// Output of `taxel live --json`.
fn json(args: &LiveArgs) -> String {
    let sink = Sink::default();
    watch(&args.watched(), open(args), &mut MessagePrinter::new(args.pixels, sink.clone())).unwrap();
    sink.text()
}

fn parsed(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn of_type<'a>(lines: &'a [Value], kind: &'static str) -> impl Iterator<Item = &'a Value> {
    lines.iter().filter(move |line| line["type"] == kind)
}

/// Leading intentions of a run, each once.
fn leading(lines: &[Value]) -> Vec<String> {
    let mut all: Vec<String> =
        of_type(lines, "frame").map(|line| line["intent"]["leading"].as_str().unwrap().into()).collect();
    all.sort();
    all.dedup();
    all
}

fn scratch(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("taxel-live-{}-{name}", std::process::id()))
}

#[test]
fn a_pat_is_kindness_and_a_lash_an_attack() {
    for (scene, meant) in [("sim:pat", "kindness"), ("sim:lash", "attack")] {
        let lines = parsed(&json(&args(scene, Some(200))));
        assert_eq!(lines[0]["type"], "hello");
        assert_eq!(lines[0]["taxels"], 2048);
        assert_eq!(of_type(&lines, "frame").count(), 200, "{scene}");
        for (index, line) in of_type(&lines, "frame").enumerate() {
            assert_eq!(line["frame"], index + 1);
            assert_eq!((line["lost"].as_u64(), line["thinned"].as_u64()), (Some(0), Some(0)));
            assert_eq!(line["decoded"], true);
            assert_eq!(line["intent"]["concepts"].as_object().unwrap().len(), 22);
        }
        assert_eq!(leading(&lines), [meant, "none"], "{scene}");
        assert!(of_type(&lines, "refused").next().is_none());
        let touched = of_type(&lines, "frame").find(|line| line["contacts"] != Value::Array(vec![])).unwrap();
        assert_eq!(touched["contacts"][0]["region"], "back");
        assert!(of_type(&lines, "answer").any(|a| a["request"] == "tare" && a["refusal"].is_null()));
    }
}

#[test]
fn nothing_touches_an_idle_garment_and_the_scene_ends_by_itself() {
    let lines = parsed(&json(&args("sim:idle", None)));
    let frames = of_type(&lines, "frame").count();
    assert!((970..=980).contains(&frames), "5 s at 195 frames/s, not {frames}");
    assert_eq!(leading(&lines), ["none"]);
    assert!(of_type(&lines, "frame").all(|line| line["contacts"] == Value::Array(vec![])));
    assert_eq!(of_type(&lines, "health").count(), 4);
}

#[test]
fn a_run_is_repeated_to_the_byte_and_a_kept_one_reads_the_same() {
    let run = LiveArgs { pixels: true, ..args("sim:five", Some(60)) };
    let first = json(&run);
    assert_eq!(json(&run), first);
    let bytes = recorded("sim:five", 60);
    assert_eq!(recorded("sim:five", 60), bytes);
    let file = scratch("kept.mcap");
    keep(&file, &bytes);
    let again = LiveArgs { pixels: true, ..args(&format!("replay:{}", file.display()), None) };
    assert_eq!(json(&again), first);
    std::fs::remove_file(file).unwrap();
    let mut seeded = run.clone();
    seeded.board.seed = Some(7);
    assert_ne!(json(&seeded), first);
    let lines = parsed(&first);
    let last = of_type(&lines, "frame").last().unwrap();
    assert_eq!(last["panels"][3]["rows"][31].as_array().unwrap().len(), 16);
}

/// Keeps the bytes of a board.
#[derive(Default)]
struct Bytes(Vec<u8>);

impl Observer for Bytes {
    fn event(&mut self, client: &Client, _event: &Event, _: Stamp) -> taxel::Result<()> {
        client.lines().for_each(|line| self.0.extend_from_slice(line));
        Ok(())
    }
}

/// Bytes of a run.
fn recorded(scene: &str, frames: u64) -> Vec<u8> {
    let (args, mut bytes) = (args(scene, Some(frames)), Bytes::default());
    watch(&args.watched(), open(&args), &mut bytes).unwrap();
    bytes.0
}

/// Writes a recording whose board has sent these bytes.
fn keep(path: &Path, bytes: &[u8]) {
    let mut writer = Writer::create(File::create(path).unwrap(), "").unwrap();
    let format = Format { encoding: "taxel-wire", schema: "", schema_encoding: "", text: b"" };
    let channel = writer.channel(WIRE, &format).unwrap();
    writer.message(channel, 0, 0, bytes).unwrap();
    // Newtons as those of the simulation.
    let scale = BTreeMap::from([("counts_per_newton".to_string(), "1000".to_string())]);
    writer.metadata("taxel", scale).unwrap();
    writer.finish().unwrap();
}

fn events(client: &mut Client, bytes: &[u8]) -> Vec<Event> {
    bytes.iter().filter_map(|byte| client.push(*byte)).collect()
}

#[test]
fn garbage_between_frames_loses_no_good_frame() {
    let bytes = recorded("sim:pat", 120);
    let (mut clean, mut dirty) = (Client::new(), Client::new());
    let wanted = events(&mut clean, &bytes);
    let mut noise = 1u32;
    let mut soiled = Vec::new();
    for frame in bytes.split_inclusive(|byte| *byte == 0) {
        soiled.extend_from_slice(frame);
        for _ in 0..noise >> 27 {
            noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
            soiled.push((noise >> 24) as u8);
        }
        noise = noise.wrapping_mul(1664525).wrapping_add(1013904223);
        soiled.push(0);
    }
    let got = events(&mut dirty, &soiled);
    let refused = got.iter().filter(|event| matches!(event, Event::Refused(_))).count();
    assert!(refused > 50, "{refused}");
    assert_eq!(dirty.counts().refused(), refused as u64);
    assert!(got.iter().filter(|event| !matches!(event, Event::Refused(_))).eq(&wanted));
    assert_eq!((dirty.counts().lost, dirty.counts().thinned), (0, 0));
    assert_eq!(dirty.image(), clean.image());
}

#[test]
fn a_lost_frame_is_counted_and_a_key_frame_asked_for() {
    let bytes = recorded("sim:pat", 100);
    let frames: Vec<_> = bytes.split_inclusive(|byte| *byte == 0).collect();
    let mut client = Client::new();
    client.start(0).unwrap();
    client.take_requests();
    let mut missing = 0;
    let mut reader = Client::new();
    let is_fiftieth = |event: &Event| matches!(event, Event::Frame { frame: 50, .. });
    for frame in frames {
        let mut frame = frame.to_vec();
        if events(&mut reader, &frame).iter().any(is_fiftieth) {
            frame[3] ^= 0x40;
        }
        for event in events(&mut client, &frame) {
            missing += u32::from(matches!(event, Event::Frame { image: ImageNews::NoBase, .. }));
        }
    }
    let counts = client.counts();
    assert_eq!((counts.lost, counts.refused(), counts.thinned), (1, 1, 0));
    // There is no board to answer the request.
    assert_eq!(missing, 50);
    assert!(client.image().is_none());
    assert!(!client.take_requests().is_empty());
}

#[test]
fn one_taxel_is_printed_with_code_and_pressure() {
    let args = LiveArgs { taxel: Some("back,12,8".parse().unwrap()), ..args("sim:pat", Some(80)) };
    let sink = Sink::default();
    let place = args.taxel.clone().unwrap();
    watch(&args.watched(), open(&args), &mut TaxelLines::new(place, false, sink.clone())).unwrap();
    let text = sink.text();
    let numbers =
        |line: &str| -> Vec<f64> { line.split_whitespace().filter_map(|w| w.parse().ok()).collect() };
    let lines: Vec<Vec<f64>> = text.lines().map(numbers).collect();
    assert_eq!(lines.len(), 80, "{text}");
    assert!(lines.iter().all(|line| line.len() == 3), "{text}");
    assert!((lines[79][0] - lines[0][0] - 79.0 * 0.00512).abs() < 1e-9, "{text}");
    let highest = lines.iter().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
    assert!((0.25..0.35).contains(&highest[0]) && highest[1] - highest[2] > 60.0, "{highest:?}");
}

#[test]
fn plain_lines_hold_no_control_code() {
    let args = args("sim:lash", None);
    let (sink, source) = (Sink::default(), open(&args));
    let mut lines = Lines::new(sink.clone());
    watch(&args.watched(), source, &mut lines).unwrap();
    let text = sink.text();
    assert!(text.chars().all(|c| c == '\n' || !c.is_control()), "{text}");
    for part in [
        "hello: simulated board, taxel-sim",
        "tare: done",
        "on the back begins",
        "intention: attack",
        "reaction flinch",
        "195.3 frames/s",
        "end: 215 frames",
    ] {
        assert!(text.contains(part), "{part} in {text}");
    }
}

/// A view that is drawn at the end.
struct Drawn {
    view: View,
    sizes: Vec<(u16, u16)>,
    pictures: Vec<Buffer>,
}

impl Observer for Drawn {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        self.view.event(client, event);
        Ok(())
    }

    fn ended(&mut self, client: &Client, _: Stamp) -> taxel::Result<()> {
        for (width, height) in &self.sizes {
            let mut terminal = Terminal::new(TestBackend::new(*width, *height)).unwrap();
            terminal.draw(|frame| self.view.draw(client, frame.buffer_mut())).unwrap();
            self.pictures.push(terminal.backend().buffer().clone());
        }
        Ok(())
    }
}

fn drawn(scene: &str, frames: u64, sizes: &[(u16, u16)]) -> Vec<Buffer> {
    let args = args(scene, Some(frames));
    let source = open(&args);
    let mut show = Drawn { view: View::new(&source), sizes: sizes.to_vec(), pictures: Vec::new() };
    watch(&args.watched(), source, &mut show).unwrap();
    show.pictures
}

fn text(buffer: &Buffer) -> Vec<String> {
    let Rect { width, height, .. } = buffer.area;
    let row = |y: u16| (0..width).map(|x| buffer[(x, y)].symbol()).collect::<String>().trim_end().to_string();
    (0..height).map(row).collect()
}

#[test]
fn the_picture_shows_maps_contacts_and_intention() {
    let pictures = drawn("sim:pat", 110, &[(128, 40), (80, 40), (80, 24), (30, 8), (1, 1), (300, 100)]);
    let wide = text(&pictures[0]).join("\n");
    for part in [
        "taxel  sim:pat  SIMULATED  garment reference (2048 taxels)  scene shipped  taxel-sim",
        "195.3 frames/s  frame 110  0.56 s  lost 0  thinned 0  refused 0",
        "chest",
        "right arm",
        " id region     shape        force area  axis    mm/s",
        "  2 back ",
        "7.9 N ",
        "A touch on the back, 8 N:  kindness    now, simulated newtons",
        "what it means",
        "politeness",
        "force of the last 30 s, up to 7.9 N",
        "contact 1 on the back begins",
        "q quit",
        "0.20 N on a taxel",
    ] {
        assert!(wide.contains(part), "{part} in\n{wide}");
    }
    // The scale has the colours that the page is sent.
    let ramp = palette::for_page().ramp;
    for [r, g, b] in ramp.iter().step_by(17).copied() {
        assert!(pictures[0].content.iter().any(|cell| cell.bg == Color::Rgb(r, g, b)), "{r} {g} {b}");
    }
    // A small terminal has the sentence, the maps, the concepts and the curve, too.
    for picture in &pictures[1..3] {
        let text = text(picture).join("\n");
        for part in ["A touch on the back, 8 N:  kindness ", "chest", "attack", "force of the last 30 s", "█"]
        {
            assert!(text.contains(part), "{part} in\n{text}");
        }
    }
    let colours = |buffer: &Buffer| {
        let all: std::collections::BTreeSet<_> =
            buffer.content.iter().filter(|c| c.symbol() == "▀").map(|c| format!("{:?}", c.fg)).collect();
        all.len()
    };
    assert!(colours(&pictures[0]) > 10, "a touch has many shades");
    let idle = drawn("sim:idle", 60, &[(128, 40)]);
    assert_eq!(colours(&idle[0]), 1);
    assert!(text(&idle[0]).join("\n").contains("Nothing touches   now"));
}

#[test]
fn what_cannot_be_opened_is_said_in_one_sentence() {
    let error = |source: &str| match source::open(&source.parse().unwrap(), &SourceOptions::default()) {
        Ok(_) => panic!("{source} opened"),
        Err(error) => format!("{error:#}"),
    };
    for (source, start) in [
        ("serial:/dev/no-such-port", "serial port /dev/no-such-port at 921600 Bd cannot be opened: "),
        ("tcp:127.0.0.1:1", "tcp:127.0.0.1:1 cannot be reached: "),
        ("replay:/no/such/file", "/no/such/file cannot be read: "),
        ("sim:tickle", "there is no script of touches \"tickle\"; known are pat, "),
    ] {
        let sentence = error(source);
        assert!(sentence.starts_with(start) && !sentence.contains('\n'), "{sentence}");
    }
    let file = scratch("garbage.mcap");
    keep(&file, &[7; 1000]);
    let args = args(&format!("replay:{}", file.display()), None);
    let error =
        watch(&args.watched(), open(&args), &mut MessagePrinter::new(false, Sink::default())).unwrap_err();
    assert!(error.to_string().ends_with("no Hello of a taxel board in 1000 bytes"), "{error}");
    std::fs::remove_file(file).unwrap();
}

/// Why what a board is to be asked is refused before its source is opened.
fn refusal(args: &LiveArgs) -> String {
    format!("{:#}", args.board.open(SourceOptions::default()).map(drop).unwrap_err())
}

#[test]
fn a_garment_or_scene_file_is_checked_before_it_is_sent() {
    let shipped = concat!(env!("CARGO_MANIFEST_DIR"), "/../taxel/garments/block-4x16.toml");
    assert_eq!(taxel::files::garments::load(shipped).unwrap(), taxel_core::garment::Garment::block());
    let refused = |edit: &dyn Fn(&mut LiveArgs)| {
        let mut args = args("sim:idle", Some(1));
        edit(&mut args);
        refusal(&args)
    };
    let file = scratch("scene.toml");
    for (text, wrong) in [("colour = 3", "colour"), ("[contact]\nlow = 9\nhigh = 8", "contact.high")] {
        std::fs::write(&file, text).unwrap();
        let why = refused(&|args| args.board.config.scene = Some(file.clone()));
        assert!(why.starts_with(&file.display().to_string()) && why.contains(wrong), "{why}");
    }
    std::fs::write(&file, "rate_hz = 50\n[stream]\nframes_hz = 10").unwrap();
    let mut slower = LiveArgs { seconds: Some(2.0), ..args("sim:pat", None) };
    slower.board.config.scene = Some(file.clone());
    let lines = json(&slower);
    let images = of_type(&parsed(&lines), "frame").count();
    assert!((19..=23).contains(&images), "{images} images in 2 s at 10 a second");
    std::fs::remove_file(file).unwrap();
}

#[test]
fn gestures_are_reported_where_they_are_asked_for() {
    let mut asked = args("sim:pat", Some(300));
    asked.board.config.gestures = Some(GestureModel::Gestures);
    let lines = parsed(&json(&asked));
    let printed: Vec<&Value> = of_type(&lines, "gesture").collect();
    assert!(!printed.is_empty());
    for line in &printed {
        assert_eq!((line["touch"].as_u64(), line["panel"].as_str()), (Some(1), Some("back")));
        assert!(line["lead"].as_f64().unwrap() >= 0.0 && line["observed_ms"].as_u64().unwrap() > 0);
    }
    let ended = printed.iter().filter(|line| line["ended"] == true).count();
    assert!(ended <= 1, "a touch ends once");
    assert!(of_type(&parsed(&json(&args("sim:pat", Some(300)))), "gesture").next().is_none());
    let mut intent = asked.clone();
    intent.board.config.gestures = Some(GestureModel::Intent);
    let classes = ["kindness", "threat", "attack"];
    let lines = parsed(&json(&intent));
    let printed: Vec<&Value> = of_type(&lines, "gesture").collect();
    assert!(
        !printed.is_empty() && printed.iter().all(|line| classes.contains(&line["name"].as_str().unwrap()))
    );
    let mut certain = asked.clone();
    certain.board.config.gesture_certainty = Some(0.7);
    let lines = parsed(&json(&certain));
    let sure = |line: &&Value| line["confidence"].as_f64().unwrap() >= 0.7;
    assert!(of_type(&lines, "gesture").filter(|line| line["ended"] == false).all(|line| sure(&line)));
    let mut refused = asked;
    refused.board.config.gesture_certainty = Some(-0.1);
    assert_eq!(refusal(&refused), "--gestures: gestures.certainty must be at most 999 (0.999)");
    refused.board.config.gesture_certainty = None;
    refused.board.config.gesture_gain = Some(17.0);
    assert_eq!(refusal(&refused), "--gestures: gestures.gain must be 1 to 4096 (16.0)");
}

/// Teaches a board a base, and compares the shape of a single contact with the base's result for its image.
struct Teacher {
    base: Base,
    taught: bool,
    /// Number of contact lists since the base is in use.
    lists: Option<u32>,
    compared: usize,
}

impl Observer for Teacher {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        if let Event::Shapes { names, prototypes } = event {
            assert_eq!(
                (names, usize::from(*prototypes)),
                (&self.base.names(), self.base.gallery.prototypes.len())
            );
            self.lists = Some(0);
        }
        if let (Some(lists), Event::Contacts { .. }) = (&mut self.lists, event) {
            *lists += 1;
        }
        // The first list may be of the scan before.
        if let (Some(2..), Event::Frame { image: ImageNews::Whole, .. }, [placed]) =
            (self.lists, event, client.contacts())
        {
            let (bounds, (_, image)) = (&placed.contact.bounds, client.image().unwrap());
            let area = &client.layout().unwrap().areas()[usize::from(bounds.panel)];
            let low = client.description().unwrap().scene.contact.low;
            let mut patch = Vec::new();
            for row in bounds.top..=bounds.bottom {
                let start = usize::from(area.base + row * area.columns);
                let row = &image[start + usize::from(bounds.left)..=start + usize::from(bounds.right)];
                patch.extend(row.iter().map(|value| if *value >= low { *value } else { 0 }));
            }
            let width = usize::from(bounds.right - bounds.left) + 1;
            let found = self.base.gallery.recognise(&descriptor(&Patch::new(&patch, width)));
            let class = found.class.map_or("unknown", |class| &self.base.gallery.names[usize::from(class)]);
            let said = (client.shape_name(placed.shape.class), placed.shape.confidence);
            assert_eq!(said, (class.to_string(), found.confidence));
            self.compared += 1;
        }
        Ok(())
    }

    fn idle(&mut self, client: &mut Client) -> taxel::Result<()> {
        if client.description().is_some() && !std::mem::replace(&mut self.taught, true) {
            set_shapes(client, &self.base)?;
        }
        Ok(())
    }
}

#[test]
fn a_taught_base_says_on_the_board_what_it_says_here() {
    let base = Base::open(std::path::Path::new("drawn")).unwrap();
    let mut teacher = Teacher { base, taught: false, lists: None, compared: 0 };
    let args = args("sim:pat", Some(300));
    watch(&args.watched(), open(&args), &mut teacher).unwrap();
    assert!(teacher.compared > 10, "{}", teacher.compared);
}
