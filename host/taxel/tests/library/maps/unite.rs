//! Uniting several maps.

use crate::maps::files::map;
use taxel::fcm::aggregate::Aggregation;
use taxel::fcm::combine::table;
use taxel::fcm::load;
use taxel::fcm::map::MapFile;
use taxel::fcm::unite::{EdgeConflict, unite};

/// A map of concepts and edges: `a>b: strong +; b>c: -0.5`, with an input for each concept in `inputs`.
fn of(name: &str, concepts: &[&str], edges: &[(&str, &str, &str)], inputs: &[&str]) -> MapFile {
    let mut text = format!("name = \"{name}\"\n");
    concepts.iter().for_each(|concept| text += &format!("[[concept]]\nname = \"{concept}\"\n"));
    for (from, to, weight) in edges {
        text += &format!("[[edge]]\nfrom = \"{from}\"\nto = \"{to}\"\nweight = {weight}\n");
    }
    for concept in inputs {
        text += &format!("[[input]]\nconcept = \"{concept}\"\nsource = \"press\"\nrise = [0, 100]\n");
    }
    map(&text)
}

fn experts() -> [MapFile; 3] {
    let concepts = ["press", "shape", "attack"];
    [
        of(
            "anna",
            &concepts,
            &[("press", "attack", "\"strong +\""), ("shape", "attack", "\"weak -\"")],
            &["press"],
        ),
        of(
            "ben",
            &concepts,
            &[("press", "attack", "\"weak +\""), ("shape", "attack", "\"strong +\"")],
            &["press"],
        ),
        of("carla", &concepts[..], &[("press", "attack", "\"strong +\"")], &["press"]),
    ]
}

#[test]
fn experts_are_combined_and_their_disagreement_is_named() {
    let united = unite(&experts(), "ours", EdgeConflict::Vote(Aggregation::Sum)).unwrap();
    // Equal triangles: the centroid of the sum is the mean of 0.75, 0.25, 0.75; and of -0.25, 0.75, 0.
    let weights: Vec<f64> = united.map.edge.iter().map(|edge| edge.weight.value()).collect();
    assert_eq!(weights, [0.58, 0.17]);
    assert_eq!((united.edges[0].spread(), united.edges[0].is_conflict()), (0.5, false));
    assert_eq!((united.edges[1].spread(), united.edges[1].is_conflict()), (1.0, true));
    assert_eq!(united.edges[1].said[2].1.to_string(), "none");
    assert!(united.conflicts.is_empty() && united.map.input.len() == 1);
    let text = table(&united);
    assert!(text.contains("weak - (anna), strong + (ben), none (carla); SIGNS CONFLICT"), "{text}");
    // Edges are sorted by disagreement.
    assert!(text.find("shape -> attack").unwrap() < text.find("press -> attack").unwrap());
    // Maximum of the memberships: a repeated statement counts once.
    let max = unite(&experts(), "ours", EdgeConflict::Vote(Aggregation::Max)).unwrap();
    assert_eq!(max.map.edge[0].weight.value(), 0.5);
    assert_eq!(
        unite(&experts(), "ours", EdgeConflict::Vote(Aggregation::Sum)).unwrap().map,
        united.map,
        "the same again"
    );
}

#[test]
fn what_all_say_stays_as_it_is_written() {
    let shipped = load::map("tactile").unwrap();
    let all = [shipped.clone(), shipped.clone()];
    for shared in
        [EdgeConflict::Agree, EdgeConflict::Combine(Aggregation::Sum), EdgeConflict::Vote(Aggregation::Max)]
    {
        let united = unite(&all, "tactile", shared).unwrap();
        assert_eq!(united.map, shipped);
        assert!(united.conflicts.is_empty() && united.edges.iter().all(|edge| edge.spread() == 0.0));
    }
}

#[test]
fn maps_that_share_concepts_merge() {
    let touch = of("touch", &["press", "attack"], &[("press", "attack", "0.5")], &["press"]);
    let seen = of(
        "seen",
        &["vision", "attack", "press"],
        &[("vision", "attack", "-0.5"), ("vision", "press", "0.25")],
        &["vision"],
    );
    let united = unite(&[touch.clone(), seen], "both", EdgeConflict::Agree).unwrap();
    let names: Vec<&str> = united.map.concept.iter().map(|concept| concept.name.as_str()).collect();
    assert_eq!((names, united.map.edge.len()), (vec!["press", "attack", "vision"], 3));
    assert_eq!(united.map.input.len(), 1, "press has a cause now");
    assert_eq!(
        united.conflicts,
        ["press is an input of touch and has causes in another: the causes are used"]
    );
    let mut other = touch.clone();
    (other.name, other.lambda, other.input[0].rise) = ("other".into(), 2.0, Some([0, 50]));
    other.edge[0].weight = taxel::fcm::weight::Weight::Number(0.25);
    let error = unite(&[touch.clone(), other.clone()], "both", EdgeConflict::Agree).unwrap_err().to_string();
    assert_eq!(error, "edge press -> attack is 0.5 in touch, 0.25 in other: --combine makes them one");
    let united = unite(&[touch, other], "both", EdgeConflict::Combine(Aggregation::Sum)).unwrap();
    assert_eq!(united.map.edge[0].weight.value(), 0.38);
    assert_eq!(
        united.conflicts,
        [
            "lambda of other differs from that of touch, which is used",
            "the input of press in other differs from that of the map before, which is used"
        ]
    );
}
