//! Drawings of maps.

use taxel::fcm::{draw, load};

#[test]
fn every_concept_and_edge_is_drawn() {
    let map = load::map("tactile").unwrap();
    let plain = draw::svg(&map, None);
    for concept in &map.concept {
        assert!(plain.contains(&format!(">{}</text>", concept.name)), "{}", concept.name);
    }
    assert_eq!(plain.matches("<path d=\"M").count(), 2 * map.edge.len(), "a line and a tip each");
    let negative = map.edge.iter().filter(|edge| edge.weight.value() < 0.0).count();
    assert_eq!(plain.matches("stroke-dasharray").count(), negative);
    assert_eq!(plain.matches("fill=\"#ffffff\"").count(), map.concept.len(), "none is active");
    // The strongest edge is the widest.
    assert!(plain.contains("sharp to kindness: -1 ") && plain.contains("stroke-width=\"5.0\""));
    let mut live = vec![0.0; map.concept.len()];
    (live[0], live[4]) = (1.0, -1.0);
    let live = draw::svg(&map, Some(&live));
    assert!(live.contains("fill=\"#56b4e9\"") && live.contains("press +1.00"));
    assert!(live.contains("fill=\"#e69f00\"") && live.contains("kindness -1.00"));
}

#[test]
fn names_cannot_break_the_picture() {
    let text = "name = \"<&>\"\n[[concept]]\nname = \"a<b\"\nnote = \"\\\"&\"\n[[edge]]\nfrom = \"a<b\"\nto = \"a<b\"\nweight = -1\n";
    let svg = draw::svg(&load::parse(text, "m").unwrap(), Some(&[0.5]));
    assert!(svg.contains("a&lt;b") && svg.contains("&quot;&amp;") && !svg.contains("a<b"), "{svg}");
}
