//! The report page has the figures of the source.

use super::stage::play;
use taxel::files::calibrate::ForceScale;
use taxel::session::Observer;
use taxel::source::{self, SourceOptions};
use taxel_cli::on_robot::ShownRobot;
use taxel_cli::report::{Seen, page};
use taxel_cli::watch::{WatchOptions, watch};

/// Shows a source to its end whose newtons nobody knows.
fn play_in_counts(spec: &str, observer: &mut dyn Observer) {
    let spec = spec.parse().unwrap();
    let source = source::open(&spec, &SourceOptions::default()).unwrap();
    let source = source::Source { scale: ForceScale::default(), ..source };
    watch(&WatchOptions::of(spec), source, observer).unwrap();
}

#[test]
fn the_figures_of_the_source_are_drawn() {
    let mut seen = Seen::new("sim:source".into());
    play("sim:source", &mut seen);
    let html = page(&seen).unwrap();
    let count = |what: &str| html.matches(what).count();
    for panel in ["chest", "back", "left arm", "right arm"] {
        assert_eq!(count(&format!("class=\"title\">{panel}</text>")), 1, "2-D of {panel}");
        assert_eq!(count(&format!("{{\"name\":\"{panel}\",\"rows\":32")), 1, "3-D of {panel}");
    }
    // Ten objects: each has a centre and a peak in 2-D, a peak with its value in 3-D, and a row of the table.
    for mark in ["class=\"centre\"", "class=\"peak\"", "{\"taxel\":", "<tr><td>#"] {
        assert_eq!(count(mark), 10, "{mark}");
    }
    assert_eq!(count("class=\"level\""), 4 * 4);
    for title in ["Ranges of pressure", "Force over time", "Intention over time", "Events", "Health"] {
        assert_eq!(count(&format!("<h2>{title}</h2>")), 1);
    }
    // The surface, and what it shows: nothing is fetched.
    assert_eq!(count("<script"), 2);
    // The namespace of SVG is a name, not an address.
    let html = html.replace("http://www.w3.org/2000/svg", "");
    let count = |what: &str| html.matches(what).count();
    for foreign in ["http://", "https://", "url("] {
        assert_eq!(count(foreign), 0, "{foreign}");
    }
}

#[test]
fn a_page_is_in_one_unit() {
    let mut seen = Seen::new("sim:pat".into());
    play("sim:pat", &mut seen);
    let html = page(&seen).unwrap();
    assert!(html.contains("<th>total, N</th><th>peak, N</th>"));
    let printed = "the source knows that 1000 counts are a newton";
    assert_eq!(
        (html.matches(" counts").count(), html.matches(printed).count()),
        (1, 1),
        "only what the unit is"
    );
    let mut seen = Seen::new("sim:pat".into());
    play_in_counts("sim:pat", &mut seen);
    let html = page(&seen).unwrap();
    assert!(html.contains("<th>total, counts</th><th>peak, counts</th>") && !html.contains(" N<"));
}

#[test]
fn without_an_image_there_is_no_page() {
    let error = page(&Seen::new("replay:x".into())).unwrap_err().to_string();
    assert_eq!(error, "replay:x: no image was received, so there is nothing to report");
}

#[test]
fn a_garment_is_shown_on_its_robot() {
    let shown_robot = ShownRobot::read("reference", Some("reference"), "waist=20deg").unwrap();
    let mut seen = Seen::new("sim:five".into()).on(Some(shown_robot));
    play("sim:five", &mut seen);
    let html = page(&seen).unwrap();
    assert_eq!(html.matches("<h2>On the robot</h2>").count(), 1);
    let data = html.split("id=\"data\">").nth(1).unwrap().split("</script>").next().unwrap();
    let data: serde_json::Value = serde_json::from_str(data).unwrap();
    assert_eq!(data["pressing"]["contacts"].as_array().unwrap().len(), 5);
    let sin = data["poses"]["links"]["torso"]["turn"][2].as_f64().unwrap();
    assert!((sin - 10f64.to_radians().sin()).abs() < 1e-9, "{sin}");
    assert_eq!(data["body"]["taxels"].as_array().unwrap().len(), data["image"].as_array().unwrap().len());
    let mut without = Seen::new("sim:idle".into());
    play("sim:idle", &mut without);
    let html = page(&without).unwrap();
    assert!(!html.contains("On the robot") && html.contains("\"body\":null"));
}
