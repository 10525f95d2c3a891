//! Drawings of maps.

use taxel::fcm::{draw, load};

#[test]
fn every_concept_and_edge_is_drawn() {
    let map = load::map("tactile").unwrap();
    let plain = draw::dot(&map, None);
    for concept in &map.concept {
        assert!(plain.contains(&format!("\n\"{0}\" [label=\"{0}\"", concept.name)), "{}", concept.name);
    }
    assert_eq!(plain.matches("\" -> \"").count(), map.edge.len());
    let negative = map.edge.iter().filter(|edge| edge.weight.value() < 0.0).count();
    assert_eq!(plain.matches("style=dashed").count(), negative);
    assert_eq!(plain.matches("fillcolor=\"#ffffff\"").count(), map.concept.len(), "none is active");
    // The strongest edge is the widest.
    let strongest = plain.lines().find(|line| line.starts_with("\"own\" -> \"kindness\" [label=\"-1\""));
    assert!(strongest.is_some_and(|line| line.ends_with("penwidth=5.0]")), "{plain}");
    let mut live = vec![0.0; map.concept.len()];
    (live[0], live[4]) = (1.0, -1.0);
    let live = draw::dot(&map, Some(&live));
    assert!(live.contains("fillcolor=\"#56b4e9\"") && live.contains("label=\"press +1.00\""));
    assert!(live.contains("fillcolor=\"#e69f00\"") && live.contains("label=\"kindness -1.00\""));
}

#[test]
fn names_cannot_break_the_graph() {
    let text = "name = \"\\\"\"\n[[concept]]\nname = \"a\\\"b\"\nnote = \"\\\\n\"\n[[edge]]\nfrom = \"a\\\"b\"\nto = \"a\\\"b\"\nweight = -1\n";
    let dot = draw::dot(&load::parse(text, "m").unwrap(), Some(&[0.5]));
    for part in [r#"digraph "\"" {"#, r#""a\"b" [label="a\"b +0.50", tooltip="\\n""#, r#""a\"b" -> "a\"b" ["#]
    {
        assert!(dot.contains(part), "{dot}");
    }
}
