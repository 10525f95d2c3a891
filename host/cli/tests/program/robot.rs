//! `taxel robot`: all boards of a robot, from outside.

use super::socket::Socket;
use super::validator::wrong;
use crate::start::{root, taxel};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use taxel::mind::{HOST_INPUT, HOST_INPUT_SCHEMA, ROBOT_INTENT, ROBOT_INTENT_SCHEMA};
use taxel::recording::Messages;

fn run(folder: &Path, args: &[&str]) -> Output {
    Command::new(taxel()).current_dir(folder).args(args).stdin(Stdio::null()).output().unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// A folder with this robot's file.
pub fn folder(name: &str, robot: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("robot-{name}"));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("robot.toml"), robot).unwrap();
    folder
}

/// The blocks of the document in this language.
fn blocks(language: &str) -> Vec<String> {
    let document = std::fs::read_to_string(root().join("docs/guides/robot.md")).unwrap();
    let begin = format!("```{language}\n");
    let blocks = document.split(&begin).skip(1).map(|rest| rest.split("```").next().unwrap().to_string());
    blocks.collect()
}

/// The robot of the document.
pub fn two() -> String {
    let [two] = &blocks("toml")[..] else { panic!("the document has one file") };
    two.clone()
}

#[test]
fn the_commands_of_the_document_run() {
    let folder = folder("document", &two());
    _ = std::fs::remove_file(folder.join("touch.mcap"));
    let commands = blocks("sh").concat();
    let lines = commands.lines().map(|line| line.split(" # ").next().unwrap().trim());
    let mut count = 0;
    for line in lines.filter(|line| !line.is_empty()) {
        let words: Vec<&str> = line.split(' ').collect();
        let done = run(&folder, &words[1..]);
        assert!(words[0] == "taxel" && done.status.success(), "{line}: {}", text(&done.stderr));
        assert!(!done.stdout.is_empty() || line.contains(" -o "), "{line}");
        count += 1;
    }
    assert_eq!(count, 10);
}

#[test]
fn the_document_names_every_key_and_state() {
    let document = std::fs::read_to_string(root().join("docs/guides/robot.md")).unwrap();
    let keys = "name urdf maps boards boards.name boards.source boards.garment boards.scene boards.tare \
                boards.body boards.link";
    let states = "absent met lost back other dropped over failed";
    for word in keys.split(' ').chain(states.split(' ')) {
        assert!(
            document.contains(&format!("| `{word}`")) || document.contains(&format!(", `{word}` |")),
            "{word}"
        );
    }
}

#[test]
fn check_lists_boards_or_says_what_is_wrong() {
    let good = folder("good", &two());
    let done = run(&good, &["config", "check", "robot.toml"]);
    let table = "\
robot two: 2 boards; reference: 12 links, base base_link
board  source     garment     taxels  lies on         scene  calibration  tare  also
torso  sim:five   reference   2048    body reference  -      -            -
hand   sim:press  block-4x16  64      left_hand       -      -            32
";
    assert_eq!(text(&done.stdout), table, "{}", text(&done.stderr));
    let printed = run(&good, &["config", "check", "robot.toml", "--json"]);
    let printed: Value = serde_json::from_slice(&printed.stdout).unwrap();
    assert_eq!(printed["boards"][1]["panels"], json!(["mat"]));
    let bad = folder("bad", &two().replace("block-4x16", "block-4x61"));
    let done = run(&bad, &["config", "check", "robot.toml"]);
    assert_eq!(done.status.code(), Some(2), "{}", text(&done.stderr));
    let why = "error: robot.toml, line 13, `boards[1].garment`: board hand: there is no garment \"block-4x61\": did \
               you mean \"block-4x16\"?";
    assert!(text(&done.stderr).starts_with(why), "{}", text(&done.stderr));
    let none = run(&good, &["config", "check", "no-such.toml"]);
    assert_eq!(none.status.code(), Some(1));
    for (words, why) in [
        (["live", "robot.toml#hnad"], "robot.toml: there is no board \"hnad\": did you mean \"hand\"?"),
        (["save", "robot.toml"], "its boards are torso, hand, and this takes one: name it, robot.toml#torso"),
        (["live", "robot.tml"], "known are auto, usb[:SERIAL]"),
    ] {
        let refused = run(&good, &words);
        assert_eq!(refused.status.code(), Some(2), "{words:?}");
        assert!(text(&refused.stderr).contains(why), "{words:?}: {}", text(&refused.stderr));
    }
    let taxel = run(&good, &["live", "robot.toml", "--taxel", "chest,0,0"]);
    assert!(text(&taxel.stderr).contains("--taxel is for a board"), "{}", text(&taxel.stderr));
}

/// JSON lines by board, in order, without the board's name and the messages about boards.
fn by_board(output: &[u8]) -> BTreeMap<String, Vec<Value>> {
    let mut boards: BTreeMap<String, Vec<Value>> = BTreeMap::new();
    for line in text(output).lines() {
        let mut line: Value = serde_json::from_str(line).unwrap();
        let fields = line.as_object_mut().unwrap();
        let board = fields.remove("board").unwrap();
        assert!(fields.remove("host_time_us").unwrap().as_u64().unwrap() > 1_700_000_000_000_000);
        if line["type"] != "board" {
            boards.entry(board.as_str().unwrap().into()).or_default().push(line);
        }
    }
    boards
}

#[test]
fn live_prints_of_each_board_what_live_prints_of_it_alone() {
    let folder = folder("live", &two());
    let done = run(&folder, &["live", "robot.toml", "--json", "--pixels", "--for", "1s"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let together = by_board(&done.stdout);
    let asked = [
        ("torso", ["sim:five", "--garment", "reference", "--body", "reference"]),
        ("hand", ["sim:press", "--garment", "block-4x16", "--tare", "32"]),
    ];
    for (name, asked) in asked {
        let args = [&["live", "--source"][..], &asked, &["--json", "--pixels", "--for", "1s"]].concat();
        let alone = run(&folder, &args);
        let by_name =
            run(&folder, &["live", &format!("robot.toml#{name}"), "--json", "--pixels", "--for", "1s"]);
        assert!(alone.stdout == by_name.stdout, "{name}: {}", text(&by_name.stderr));
        let alone: Vec<Value> =
            text(&alone.stdout).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        assert!(
            alone.len() > 300 && together[name] == alone,
            "{name}: {} of {}",
            together[name].len(),
            alone.len()
        );
    }
    let lines = run(&folder, &["live", "robot.toml", "--for", "1s", "--tare", "16"]);
    let lines = text(&lines.stdout);
    assert!(lines.lines().all(|line| line.starts_with("torso ") || line.starts_with("hand  ")), "{lines}");
    assert!(lines.contains("hand  tare: done\n"), "{lines}");
    assert_eq!(lines.matches(" end: ").count(), 2, "{lines}");
}

/// Records a second of all boards to `touch.mcap`; returns what the program says of it.
fn recorded(folder: &Path) -> String {
    let record = ["record", "robot.toml", "-o", "touch.mcap", "--for", "1s", "--force"];
    let done = run(folder, &record);
    assert!(done.status.success(), "{}", text(&done.stderr));
    text(&done.stderr).into()
}

/// Number of lines of a table, without its head.
fn rows(done: &Output) -> usize {
    assert!(done.status.success(), "{}", text(&done.stderr));
    text(&done.stdout).lines().count() - 1
}

#[test]
fn a_board_of_a_recording_is_read_by_all_commands() {
    let folder = folder("parts", &two());
    recorded(&folder);
    let counted = |board: &str| {
        let info = run(&folder, &["info", "touch.mcap", "--json"]);
        let printed: Value = serde_json::from_slice(&info.stdout).unwrap();
        printed["boards"][board]["frames"].as_u64().unwrap() as usize
    };
    for (board, taxels) in [("torso", 2048), ("hand", 64)] {
        let part = format!("touch.mcap#{board}");
        let table = run(&folder, &["export", &part, "--to", "csv", "--every", "10", "-o", "-"]);
        assert_eq!(rows(&table), counted(board).div_ceil(10) * taxels, "{board}");
        let contacts = run(&folder, &["export", &part, "--to", "csv", "--contacts", "-o", "-"]);
        assert!(rows(&contacts) > 100, "{board}");
        let page = run(&folder, &["report", &part, "-o", "-"]);
        assert!(page.status.success() && text(&page.stdout).contains(&part), "{}", text(&page.stderr));
        let replayed = run(&folder, &["live", &part, "--json"]);
        let source = format!("replay:{part}");
        assert_eq!(replayed.stdout, run(&folder, &["live", "--source", &source, "--json"]).stdout, "{board}");
    }
    // Who names none is shown how.
    for args in [
        &["export", "touch.mcap", "--to", "csv", "-o", "-"][..],
        &["report", "touch.mcap", "-o", "-"],
        &["live", "touch.mcap", "--json"],
        &["view", "touch.mcap"],
        &["body", "learn", "touch.mcap", "-o", "folds.taxel"],
    ] {
        let done = run(&folder, args);
        let why = text(&done.stderr);
        let names = "touch.mcap is of a robot's boards, torso, hand: name one, touch.mcap#torso";
        assert!(!done.status.success() && why.contains(names), "{args:?}: {why}");
    }
    let over = run(&folder, &["export", "touch.mcap#hand", "--to", "npz", "-o", "touch.mcap", "--force"]);
    assert!(!over.status.success() && counted("hand") > 0, "{}", text(&over.stderr));
    let alone =
        run(&folder, &["record", "--source", "sim:pat", "--for", "0.2s", "-o", "pat.mcap", "--force"]);
    assert!(alone.status.success());
    let none = run(&folder, &["report", "pat.mcap#hand", "-o", "-"]);
    assert!(
        text(&none.stderr).contains("pat.mcap is of a single board: leave out #hand"),
        "{}",
        text(&none.stderr)
    );
}

#[test]
fn record_and_doctor_report_all_boards() {
    let folder = folder("record", &two());
    let summary = recorded(&folder);
    assert!(summary.contains("\ntorso  1.0 s, 19") && summary.contains("\nhand   1.0 s, "), "{summary}");
    let info = run(&folder, &["info", "touch.mcap", "--json"]);
    let printed: Value = serde_json::from_slice(&info.stdout).unwrap();
    assert_eq!(printed["whole"], true);
    let table = text(&run(&folder, &["info", "touch.mcap"]).stdout).to_string();
    for board in ["torso", "hand"] {
        let counts = &printed["boards"][board];
        assert_eq!((&counts["lost"], &counts["restarts"]), (&json!("0"), &json!("0")), "{counts}");
        let frames = counts["frames"].as_u64().unwrap();
        assert!(frames > 190 && table.contains(&format!("\n  {board}: {frames} frames (")), "{table}");
        assert!(table.contains(&format!("\n{board}\n  counts_per_newton")), "{table}");
    }
    let again = run(&folder, &["record", "robot.toml", "-o", "touch.mcap", "--for", "1s"]);
    assert_eq!(again.status.code(), Some(1));
    assert!(text(&again.stderr).contains("touch.mcap already exists"));
    let over = run(&folder, &["record", "robot.toml", "-o", "robot.toml", "--force"]);
    assert!(!over.status.success() && std::fs::read_to_string(folder.join("robot.toml")).unwrap() == two());
    let doctor = run(&folder, &["doctor", "robot.toml", "--for", "1s", "--json"]);
    assert!(doctor.status.success(), "{}", text(&doctor.stderr));
    let printed: Value = serde_json::from_slice(&doctor.stdout).unwrap();
    let boards = printed["boards"].as_array().unwrap();
    assert_eq!((boards[0]["board"].as_str(), boards[1]["board"].as_str()), (Some("torso"), Some("hand")));
    let tested =
        |board: &Value| board["findings"].as_array().unwrap().iter().any(|it| it["of"] == "self-test");
    assert!(boards.iter().all(tested), "{printed}");
    let gone = two().replace("sim:press", "tcp:127.0.0.1:1");
    std::fs::write(folder.join("gone.toml"), gone).unwrap();
    let doctor = run(&folder, &["doctor", "gone.toml", "--for", "1s"]);
    assert_eq!(doctor.status.code(), Some(3), "{}", text(&doctor.stderr));
    assert!(text(&doctor.stdout).contains("X link         tcp:127.0.0.1:1 cannot be reached"));
}

#[test]
fn boards_that_are_pulled_come_back_in_another_order_and_never_under_another_name() {
    const GARMENTS: [(&str, &str); 3] = [("a", "reference"), ("b", "block-4x16"), ("c", "mat-64x32")];
    let sockets = GARMENTS.map(|(_, garment)| Socket::new(garment));
    let boards: String = GARMENTS
        .iter()
        .zip(&sockets)
        .map(|((name, garment), socket)| {
            format!(
                "[[boards]]\nname = \"{name}\"\nsource = \"tcp:{}\"\ngarment = \"{garment}\"\n",
                socket.address
            )
        })
        .collect();
    let folder = folder("pulled", &format!("name = \"three\"\n{boards}"));
    let mut program = Command::new(taxel())
        .current_dir(&folder)
        .args(["live", "robot.toml", "--json"])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(program.stdout.take().unwrap()).lines();
    let mut frames: BTreeMap<String, usize> = BTreeMap::new();
    // Reads until each of these boards is in this state, and returns the messages about boards.
    let mut until = |state: &str, boards: &[&str]| {
        let mut missing = boards.to_vec();
        let mut states = Vec::new();
        while !missing.is_empty() {
            let line: Value = serde_json::from_str(&lines.next().expect("it goes on").unwrap()).unwrap();
            if line["type"] == "robot_intent" {
                continue;
            }
            let board = line["board"].as_str().unwrap().to_string();
            let garment = GARMENTS.iter().find(|(name, _)| *name == board).unwrap().1;
            match line["type"].as_str().unwrap() {
                "board" => {
                    if line["state"] == state {
                        missing.retain(|name| *name != board);
                    }
                    states.push(line);
                }
                "hello" => assert_eq!(line["garment"], garment),
                "frame" => *frames.entry(board).or_default() += 1,
                _ => {}
            }
        }
        states
    };
    until("met", &["a", "b", "c"]);
    sockets[0].plug(None);
    sockets[1].plug(None);
    let lost = until("lost", &["a", "b"]);
    let since = |line: &Value| line["host_time_us"].as_u64().unwrap() - line["since_us"].as_u64().unwrap();
    assert!(
        lost.iter().filter(|line| line["state"] == "lost").all(|line| since(line) < 6_000_000),
        "{lost:?}"
    );
    // The boards come back in each other's place, then in their own, the second one first.
    sockets[0].plug(Some("block-4x16"));
    sockets[1].plug(Some("reference"));
    let others = until("other", &["a", "b"]);
    assert!(others.iter().all(|line| line["state"] != "back"), "{others:?}");
    let why =
        others.iter().find(|line| line["state"] == "other" && line["board"] == "a").unwrap()["why"].clone();
    let address = &sockets[0].address;
    assert_eq!(
        why,
        format!("tcp:{address} answers with another board: it has the garment block-4x16, not reference")
    );
    sockets[1].plug(Some("block-4x16"));
    until("back", &["b"]);
    sockets[0].plug(Some("reference"));
    let back = until("back", &["a"]);
    assert!(back.iter().all(|line| line["board"] != "c"), "{back:?}");
    program.kill().unwrap();
    program.wait().unwrap();
    assert!(frames["c"] > frames["a"] && frames["c"] > 5, "{frames:?}");
}

#[test]
fn boards_are_asked_by_lines_while_they_are_followed() {
    let robot = "name = \"two\"\n[[boards]]\nname = \"hand\"\nsource = \"sim:idle\"\ntare = 0\ngarment = \"block-4x16\"\n\
                 [[boards]]\nname = \"gone\"\nsource = \"serial:nowhere\"\n\
                 [[boards]]\nname = \"foot\"\nsource = \"sim:idle\"\ntare = 0\ngarment = \"block-4x16\"\n";
    let folder = folder("requests", robot);
    std::fs::write(folder.join("calm.toml"), "name = \"calm\"\n[contact]\nlow = 70\nhigh = 140\n").unwrap();
    let lines = "tare hand 8\n\ntare gone\nscene foot calm.toml\nself-test\nself-test hnad\ntare foot many\n\
                 tare 5000\ndance\nscene gone none.toml\n";
    std::fs::write(folder.join("lines.txt"), lines).unwrap();
    let args = ["live", "robot.toml", "--json", "--realtime", "--for", "2s", "--requests", "lines.txt"];
    let done = run(&folder, &args);
    // The board that is gone does not come in time; the others have done what they were asked.
    assert_eq!(done.status.code(), Some(3), "{}", text(&done.stderr));
    let answers: Vec<String> = text(&done.stdout)
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).unwrap())
        .filter(|line| line["type"] == "answer")
        .map(|line| format!("{} {} {}", line["board"], line["request"], line["refusal"]))
        .collect();
    let count = |board: &str, what: &str| {
        answers
            .iter()
            .filter(|line| line.contains(board) && line.contains(what) && line.ends_with("null"))
            .count()
    };
    assert_eq!([count("hand", "tare"), count("foot", "tare")], [1, 0]);
    assert_eq!([count("hand", "set-scene"), count("foot", "set-scene")], [0, 1]);
    assert_eq!([count("hand", "self-test"), count("foot", "self-test")], [1, 1]);
    for why in [
        "lines.txt, line 6: there is no board \"hnad\": did you mean \"hand\"? Known are hand, gone, foot",
        "lines.txt, line 7: board foot: tare over \"many\"",
        "lines.txt, line 8: a tare takes 1 to 4096 frames, not 5000",
        "lines.txt, line 9: \"dance\": must be tare [BOARD] [N], scene [BOARD] FILE, self-test [BOARD] or host_input NAME VALUE \
         [AGE_MS]",
        "lines.txt, line 10: board gone: ",
    ] {
        assert!(text(&done.stderr).contains(why), "{why}\n{}", text(&done.stderr));
    }
}

/// A robot whose chest and back are boards of their own, and that is embraced.
fn embraced(name: &str) -> PathBuf {
    let board = |name: &str| {
        format!("[[boards]]\nname = \"{name}\"\nsource = \"sim:{name}.toml\"\ngarment = \"reference\"\n")
    };
    let folder =
        folder(name, &format!("name = \"two\"\nurdf = \"reference\"\n{}{}", board("front"), board("rear")));
    for (name, panel, newtons) in [("front", "chest", 12), ("rear", "back", 15)] {
        let script = format!(
            "duration_s = 3.5\ngarment = \"reference\"\n[[touch]]\npanel = \"{panel}\"\nshape = \"palm\"\n\
             at = [7.5, 15.5]\nsize_mm = [120, 90]\nforce_n = {newtons}\nstart_s = 0.6\nrise_s = 0.4\nhold_s = 1.2\nfall_s = 0.2\n"
        );
        std::fs::write(folder.join(format!("{name}.toml")), script).unwrap();
    }
    folder
}

/// Messages of a topic about the robot, with the times at which they were logged, us.
fn of_robot(file: &Path, name: &str) -> Vec<(u64, Value)> {
    let mut messages = Messages::of_topic(file, &format!("/taxel/{name}")).unwrap();
    let mut all = Vec::new();
    while let Some(message) = messages.next_message().unwrap() {
        all.push((message.header.log_time / 1000, serde_json::from_slice(message.data).unwrap()));
    }
    all
}

#[test]
fn record_has_what_touches_mean_and_the_host_input() {
    let folder = embraced("recorded-mind");
    std::fs::write(folder.join("input.txt"), "host_input vision 0.5 40\nhost_input visoin 1\n").unwrap();
    let args = ["record", "robot.toml", "-o", "touch.mcap", "--force", "--requests", "input.txt"];
    let done = run(&folder, &[&args[..], &["--realtime"]].concat());
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(text(&done.stderr).contains("did you mean \"vision\"?"), "{}", text(&done.stderr));
    let file = folder.join("touch.mcap");
    let printed = of_robot(&file, HOST_INPUT);
    let [(sent_us, printed)] = &printed[..] else { panic!("one line is right: {printed:?}") };
    assert_eq!((&printed["host_input"], &printed["age_ms"]), (&json!({ "vision": 0.5 }), &json!(40)));
    assert_eq!(printed["host_time_us"], *sent_us);
    let meant = of_robot(&file, ROBOT_INTENT);
    let schemas = [HOST_INPUT_SCHEMA, ROBOT_INTENT_SCHEMA].map(|text| serde_json::from_str(text).unwrap());
    assert_eq!(wrong(printed, &schemas[0]), None);
    assert!(meant.iter().all(|(_, line)| wrong(line, &schemas[1]).is_none()), "{meant:?}");
    // As `live`, it says what is news alone.
    let news = |(_, line): &(u64, Value)| (line["leading"].clone(), line["holding"].clone());
    assert!(meant.windows(2).all(|two| news(&two[0]) != news(&two[1])), "{meant:?}");
    let holds = |line: &Value, what: &str| line["holding"].as_array().unwrap().contains(&json!(what));
    assert!(meant.iter().any(|(_, line)| line["leading"] == "kindness" && holds(line, "hug")), "{meant:?}");
    assert_eq!(meant.last().unwrap().1["leading"], "none");
    assert!(meant.iter().all(|(us, line)| line["host_time_us"] == *us && us >= sent_us), "{meant:?}");
    let hug = &meant.iter().find(|(_, line)| holds(line, "hug")).unwrap().1;
    assert_eq!(hug["touches"].as_array().unwrap().len(), 2, "{hug}");
    // The boards are as without it.
    let info = run(&folder, &["info", "touch.mcap"]);
    assert!(info.status.success() && text(&info.stdout).contains("front"), "{}", text(&info.stdout));
    let board = run(&folder, &["live", "--source", "replay:touch.mcap#front@max", "--json"]);
    let kinds = text(&board.stdout).lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let kinds: BTreeSet<String> = kinds.map(|line| line["type"].as_str().unwrap().into()).collect();
    assert!(kinds.contains("frame") && !kinds.contains(ROBOT_INTENT), "{kinds:?}");
    // At times of their own, boards have no mind.
    let done = run(&folder, &args);
    assert!(
        text(&done.stderr).contains("input.txt, line 1: nobody takes host input"),
        "{}",
        text(&done.stderr)
    );
    assert!(of_robot(&file, ROBOT_INTENT).is_empty());
}

#[test]
fn what_follows_from_host_input_is_printed() {
    let map = "version = 1\nname = \"trust\"\nrule = \"kosko\"\ntransfer = \"positive\"\nlambda = 3.5\n\
               [[concept]]\nname = \"voice\"\n[[concept]]\nname = \"kindness\"\n\
               [[input]]\nconcept = \"voice\"\nrobot = { host_input = \"voice\" }\nrise = [0, 32768]\n\
               [[edge]]\nfrom = \"voice\"\nto = \"kindness\"\nweight = 1.0\nnote = \"who speaks kindly is kind\"\n";
    let robot = "name = \"one\"\nmaps = [\"trust.toml\"]\n[[boards]]\nname = \"hand\"\nsource = \"sim:idle\"\n\
                 garment = \"block-4x16\"\n";
    let folder = folder("input", robot);
    std::fs::write(folder.join("trust.toml"), map).unwrap();
    std::fs::write(folder.join("input.txt"), "host_input voice 1\n").unwrap();
    let args = ["live", "robot.toml", "--realtime", "--for", "1s", "--requests", "input.txt"];
    let done = run(&folder, &args);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert_eq!(text(&done.stdout).matches("robot kindness").count(), 1, "{}", text(&done.stdout));
}

#[test]
fn live_says_what_a_touch_of_two_boards_means_and_why_explains_it() {
    let folder = embraced("embraced");
    let input = "host_input vision 0.5 40\n{\"host_input\": {\"voice\": 0.25}}\n{\"positions\": {\"waist\": 0.0}}\nhost_input visoin 1\n\
                host_input voice 3\nhost_input plan 1 2 3\n{\"positions\": {\"knee\": 1}}\n";
    std::fs::write(folder.join("input.txt"), input).unwrap();
    let args = ["live", "robot.toml", "--realtime", "--requests", "input.txt"];
    let done = run(&folder, &[&args[..], &["--json"]].concat());
    assert!(done.status.success(), "{}", text(&done.stderr));
    let lines = text(&done.stdout).lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let meant: Vec<Value> = lines.filter(|line| line["type"] == "robot_intent").collect();
    let is_hug = |line: &Value| line["holding"].as_array().unwrap().contains(&json!("hug"));
    let hug = meant.iter().find(|line| is_hug(line)).expect("it is embraced");
    assert!(
        hug["concepts"]["hug"].as_f64().unwrap() >= 0.5 && hug["host_time_us"].as_u64().unwrap() > 1 << 50
    );
    assert!(meant.iter().any(|line| is_hug(line) && line["leading"] == "kindness"), "{meant:?}");
    assert!(meant.iter().all(|line| line["leading"] != "threat" && line["leading"] != "attack"), "{meant:?}");
    assert_eq!(meant.last().unwrap()["leading"], "none");
    let defaults = hug["defaults"].as_array().unwrap();
    assert!(defaults.contains(&json!("plan")) && defaults.contains(&json!("hand")), "{hug}");
    for why in [
        "input.txt, line 4: there is no name of a host input \"visoin\": did you mean \"vision\"?",
        "input.txt, line 5: voice is 3, and must be -1 to 1",
        "input.txt, line 6: \"host_input plan 1 2 3\": must be host_input NAME VALUE [AGE_MS]",
        "input.txt, line 7: reference: there is no joint \"knee\"",
    ] {
        assert!(text(&done.stderr).contains(why), "{why}\n{}", text(&done.stderr));
    }
    let lines = run(&folder, &args);
    assert!(text(&lines.stdout).contains("robot kindness; hug 0."), "{}", text(&lines.stdout));
    let why = run(&folder, &["fcm", "why", "--source", "robot.toml", "--at", "1.6s", "--of", "hug"]);
    let why = text(&why.stdout);
    for part in [
        "hug is 0.",
        "chest: a hug is chest",
        "  chest: load of chest ",
        "    board front: contact 1 on chest (torso): ",
        "    board rear: contact 1 on back (torso): ",
        "  voice: host input voice 0, the default: nothing is known",
    ] {
        assert!(why.contains(part), "{part} in {why}");
    }
    let announced = run(&folder, &["fcm", "why", "--source", "robot.toml", "--json"]);
    let announced: Value = serde_json::from_slice(&announced.stdout).unwrap();
    assert_eq!((&announced["leading"], &announced["concept"]), (&json!("kindness"), &json!("kindness")));
    std::fs::write(folder.join("front.toml"), "duration_s = 0.3\ngarment = \"reference\"\n").unwrap();
    std::fs::write(folder.join("rear.toml"), "duration_s = 0.3\ngarment = \"reference\"\n").unwrap();
    let none = run(&folder, &["fcm", "why", "--source", "robot.toml"]);
    let printed =
        "error: robot.toml: no intention was announced; --at TIME explains the state at that time\n";
    assert_eq!((none.status.code(), text(&none.stderr)), (Some(1), printed));
}
