//! Explanations add up, for any map.

use crate::maps::files::map;
use taxel::fcm::decimal::Decimal;
use taxel::fcm::load;
use taxel::fcm::map::MapFile;
use taxel::fcm::why::{Explained, explain, report, text, what_if};

fn inputs(pairs: &[(&str, &str)]) -> Vec<(String, Decimal)> {
    pairs.iter().map(|(name, value)| (name.to_string(), Decimal::parse(value).unwrap())).collect()
}

/// The parts minus the threshold are the sum; the shares are, too; and the sum gives the activation.
fn adds_up(file: &MapFile, explained: &Explained) {
    let Explained { map, run, why, shares } = explained;
    let parts: i32 = why.parts.iter().map(|part| part.value.0).sum();
    assert_eq!(parts - why.threshold.0, why.sum.0);
    assert_eq!(shares.sum(), i64::from(why.sum.0), "{:?}", shares.rest);
    let by_input: i64 = shares.inputs().iter().map(|(_, share)| share).sum();
    assert_eq!(by_input + shares.rest.values().sum::<i64>(), i64::from(why.sum.0));
    let z = file.lambda * why.sum.to_f64();
    let activation = match file.transfer {
        taxel_core::intent::Transfer::Sigmoid => 1.0 / (1.0 + (-z).exp()),
        taxel_core::intent::Transfer::Positive => z.max(0.0).tanh(),
        _ => z.tanh(),
    };
    assert!((map.value(run.state[usize::from(why.concept)]) - activation).abs() < 1e-3);
}

#[test]
fn a_lash_is_an_attack_because_it_is_sudden_and_pointed() {
    let file = load::map("tactile").unwrap();
    let measured = [("time", "-0.3"), ("shape", "0.1"), ("gradual", "0.05"), ("press", "0.8")];
    let explained = explain(&file, &inputs(&measured), None).unwrap();
    adds_up(&file, &explained);
    let names = |at: usize| file.concept[at].name.as_str();
    assert_eq!(names(explained.why.concept.into()), "attack");
    let paths = &explained.shares.paths;
    assert_eq!(paths[0].concepts.iter().map(|at| names(*at)).collect::<Vec<_>>(), ["time"]);
    assert!(explained.shares.rest.is_empty(), "{:?}", explained.shares.rest);
    let words = text(&file, &explained, None, 2);
    assert!(
        words.starts_with("attack is 0.8")
            && words.contains("time -> attack")
            && words.contains("other paths"),
        "{words}"
    );
    let json = report(&explained, None);
    assert_eq!(
        (json["concept"].as_str(), json["sum_units"].as_i64()),
        (Some("attack"), Some(explained.shares.sum()))
    );
    // Feelings are traced back to measured inputs.
    let anger = explain(&file, &inputs(&measured), Some("anger")).unwrap();
    adds_up(&file, &anger);
    let way = |wanted: &[&str]| {
        anger.shares.paths.iter().find(|p| p.concepts.iter().map(|at| names(*at)).eq(wanted.iter().copied()))
    };
    assert!(way(&["time", "attack"]).unwrap().share > 0);
    assert!(way(&["gradual", "attack"]).unwrap().share < 0);
}

#[test]
fn all_maps_and_settings_add_up() {
    let shipped = load::map("tactile").unwrap();
    for rule in [
        taxel_core::intent::Rule::Kosko,
        taxel_core::intent::Rule::Mkosko,
        taxel_core::intent::Rule::Rescaled,
    ] {
        for transfer in [taxel_core::intent::Transfer::Sigmoid, taxel_core::intent::Transfer::Tanh] {
            let mut file = shipped.clone();
            (file.rule, file.transfer, file.lambda, file.threshold) = (rule, transfer, 0.5, 0.1);
            // A ring: anger makes touches feel threatening.
            file.edge[0].weight = taxel::fcm::weight::Weight::Term("strong -".into());
            file.edge.push(taxel::fcm::map::EdgeFile {
                from: "anger".into(),
                to: "threat".into(),
                ..file.edge[5].clone()
            });
            for concept in ["kindness", "attack", "politeness", "anger"] {
                let start = inputs(&[("press", "0.37"), ("shape", "-0.2"), ("time", "1")]);
                let explained = explain(&file, &start, Some(concept)).unwrap();
                let settled = explained.run.outcome == taxel_core::intent::Outcome::Fixed;
                if settled {
                    adds_up(&file, &explained)
                } else {
                    assert_eq!(explained.shares.sum(), i64::from(explained.why.sum.0))
                }
                assert!(!explained.shares.rest.is_empty(), "thresholds and rings are no input's");
            }
        }
    }
}

#[test]
fn what_if_holds_a_concept_against_its_causes() {
    let file = load::map("tactile").unwrap();
    let start = |time: &str| inputs(&[("goodwill", "1"), ("shape", "0.2"), ("time", time)]);
    let at = |name: &str| file.find(name).unwrap();
    let before = explain(&file, &start("-0.8"), None).unwrap().run.state;
    let calm = what_if(&file, &start("-0.8"), &inputs(&[("attack", "0"), ("sting", "0")])).unwrap().state;
    assert_eq!(calm[at("attack")], 0);
    assert!(calm[at("kindness")] > before[at("kindness")]);
    assert!(calm[at("anger")] < before[at("anger")] && calm[at("happiness")] > before[at("happiness")]);
    let gentle = what_if(&file, &start("-0.8"), &inputs(&[("time", "1")])).unwrap().state;
    assert_eq!(gentle, explain(&file, &start("1"), None).unwrap().run.state);
}

#[test]
fn what_cannot_be_explained_is_refused() {
    let file = load::map("tactile").unwrap();
    let refused = |pairs: &[(&str, &str)], of| explain(&file, &inputs(pairs), of).err().unwrap().to_string();
    assert_eq!(refused(&[("force", "1")], None), "map tactile: --input names the unknown concept force");
    assert_eq!(
        refused(&[("anger", "1")], None),
        "--input: anger has causes, which would overwrite it; --set holds it"
    );
    assert_eq!(refused(&[], Some("joy")), "map tactile: --of names the unknown concept joy");
    assert_eq!(refused(&[], Some("press")), "press has no cause: its value was set");
    let lonely = map("name = \"m\"\n[[concept]]\nname = \"a\"\n");
    assert_eq!(explain(&lonely, &[], None).err().unwrap().to_string(), "no concept of the map has a cause");
}
