//! Why the mind decided, down to the contacts.

use super::spread::families;
use super::touched::{explained, robot};

#[test]
fn a_hug_is_explained_down_to_the_contacts_of_both_boards() {
    let family = families().into_iter().find(|family| family.name == "hug").unwrap();
    let touch = (family.make)(1);
    let robot = robot([None; 2]);
    let reasons = explained(&robot, touch, "hug");
    let json = reasons.json(&robot);
    assert!(json["activation"].as_f64().unwrap() > 0.5, "{json}");
    let sum: i64 = json["parts"].as_array().unwrap().iter().map(|part| part["units"].as_i64().unwrap()).sum();
    assert_eq!(sum - json["threshold_units"].as_i64().unwrap(), json["sum_units"].as_i64().unwrap());
    for (concept, board) in [("chest", "one"), ("back", "two")] {
        let heard =
            json["heard"].as_array().unwrap().iter().find(|heard| heard["concept"] == concept).unwrap();
        let causes = heard["causes"].as_array().unwrap();
        assert!(!causes.is_empty() && causes.iter().all(|cause| cause["board"] == board), "{heard}");
        assert!(causes.iter().all(|cause| cause["region"] == concept && cause["contact"].as_u64() > Some(0)));
        let sum: i64 = causes.iter().map(|cause| cause["value"].as_i64().unwrap()).sum();
        assert_eq!(heard["value"].as_i64(), Some(sum));
    }
    let text = reasons.text(&robot, 12);
    for part in [
        "hug is 0.",
        "chest: load of chest ",
        "board one: contact ",
        "on back (torso): ",
        "voice: host input voice 0, the default",
    ] {
        assert!(text.contains(part), "{part} in {text}");
    }
}
