//! Announcements of a board are explained from its own numbers, live and from a recording.

use crate::record::stage::{file, plan, record};
use std::path::PathBuf;
use taxel::fcm::reported::ReportedIntent;
use taxel::fcm::why::{explain, explain_reported, report};
use taxel::robot::BoardConfig;
use taxel::source::SourceSpec;
use taxel_cli::commands::maps::reported::listen;
use taxel_cli::watch::BoardArgs;
use taxel_core::intent::Leading;

fn spec(words: &str) -> SourceSpec {
    words.parse().unwrap()
}

fn reported(words: &str, at: Option<f64>) -> Result<ReportedIntent, String> {
    listen(BoardArgs::of(spec(words)), at).map_err(|error| error.to_string())
}

#[test]
fn an_announced_intention_is_explained_as_the_board_inferred_it() {
    for (scene, leading) in [("lash", Leading::Attack), ("pat", Leading::Kindness)] {
        let reported = reported(&format!("sim:{scene}"), None).unwrap();
        assert_eq!(reported.report.leading, leading, "{scene}");
        let explained = explain_reported(&reported, None).unwrap();
        assert_eq!(reported.map.concept[usize::from(explained.why.concept)].name, leading.as_str());
        let parts: i32 = explained.why.parts.iter().map(|part| part.value.0).sum();
        assert_eq!(parts - explained.why.threshold.0, explained.why.sum.0);
        assert_eq!(explained.shares.sum(), i64::from(explained.why.sum.0));
        // The same inputs lead to the same state here, so the explained map and touch are the right ones.
        let again = explain(&reported.map, &reported.inputs(), Some(leading.as_str())).unwrap();
        assert_eq!((again.run.state, again.why), (explained.run.state, explained.why.clone()));
        assert_eq!((again.run.steps, again.run.outcome), (reported.report.steps, reported.report.outcome));
        let json = report(&explained, None);
        assert_eq!(json["concept"], leading.as_str());
        assert!(reported.text().contains(&format!(
            "frame {}: {} leads; inputs press=",
            reported.report.frame,
            leading.as_str()
        )));
    }
}

#[test]
fn a_time_may_be_asked_for() {
    let first = reported("sim:lash", None).unwrap();
    let (before, after) = (
        reported("sim:lash", Some(first.seconds - 0.004)),
        reported("sim:lash", Some(first.seconds + 0.001)),
    );
    let (before, after) = (before.unwrap(), after.unwrap());
    assert_eq!((before.report.leading, after.report.leading), (Leading::None, Leading::Attack));
    assert_eq!(after.report, first.report);
    // Nothing leads yet: the strongest concept is explained.
    assert!(explain_reported(&before, None).is_ok());
    assert!(explain_reported(&before, Some("anger")).is_ok());
}

#[test]
fn where_there_is_nothing_to_explain_it_is_said() {
    let quiet = reported("sim:idle", None).unwrap_err();
    assert!(
        quiet.ends_with("no intention was announced; --at TIME explains the state at that time"),
        "{quiet}"
    );
    let early = reported("sim:lash", Some(0.0)).unwrap();
    assert_eq!((early.report.leading, explain_reported(&early, None).unwrap().why.sum.0), (Leading::None, 0));
    let scene = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("silent.toml");
    std::fs::write(&scene, "[stream]\nintent = false\n").unwrap();
    let config = BoardConfig { scene: Some(scene), ..BoardConfig::of(spec("sim:lash")) };
    let board = BoardArgs { config, ..BoardArgs::default() };
    let silent = listen(board, Some(0.1)).unwrap_err().to_string();
    assert!(silent.ends_with("no intention was reported in the first 0.1 s"), "{silent}");
}

/// A map of a single concept, the temperature, which only a host can feed.
const WARM: &str = "name = \"warm\"\nlambda = 1\n[[concept]]\nname = \"warmth\"\n[[concept]]\nname = \"kindness\"\n\
                    [[input]]\nconcept = \"warmth\"\nsource = { host = 3 }\nrise = [-32768, 32768]\nat = [-1, 1]\n\
                    [[edge]]\nfrom = \"warmth\"\nto = \"kindness\"\nweight = 1\n";

#[test]
fn what_the_host_feeds_counts_until_it_is_too_old() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let scene = folder.join("warm scene.toml");
    std::fs::write(folder.join("warm map.toml"), WARM).unwrap();
    std::fs::write(&scene, "react = []\n[intent]\nmap = \"warm map.toml\"\n").unwrap();
    let fed = |words: &str| {
        let feed = vec![taxel::robot::feed(words).unwrap()];
        let config = BoardConfig { scene: Some(scene.clone()), feed, ..BoardConfig::of(spec("sim:lash")) };
        let board = BoardArgs { config, ..BoardArgs::default() };
        let reported = listen(board, Some(0.4)).unwrap();
        let explained = explain_reported(&reported, Some("kindness")).unwrap();
        (reported.report.concepts[0].0, reported.report.leading, explained.why.sum.0)
    };
    assert_eq!(fed("warmth=0.75"), (24_576, Leading::Kindness, 24_576));
    assert_eq!(fed("warmth=0.75,0,60000,-0.5"), (24_576, Leading::Kindness, 24_576));
    assert_eq!(fed("warmth=0.75,0,100,-0.5"), (-16_384, Leading::None, -16_384));
    assert_eq!(fed("warmth=0.75,200,100"), (0, Leading::None, 0));
}

#[test]
fn a_recording_explains_the_same() {
    record("sim:lash", plan("reported.mcap", "sim:lash", None, false));
    let (live, kept) = (
        reported("sim:lash", None).unwrap(),
        reported(&format!("replay:{}@max", file("reported.mcap").display()), None).unwrap(),
    );
    assert_eq!((live.report, live.map, live.seconds), (kept.report, kept.map, kept.seconds));
}
