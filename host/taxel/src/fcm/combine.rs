//! Reports of combined maps: weights and disagreements.

use super::unite::United;
use serde_json::{Value, json};

/// `{"map", "concepts", "edges": [{"from", "to", "weight", "said", "spread", "sign_conflict"}], "conflicts"}`.
pub fn report(united: &United) -> Value {
    json!({
        "map": united.map.name,
        "concepts": united.map.concept.iter().map(|concept| &concept.name).collect::<Vec<_>>(),
        "edges": united.edges.iter().map(|edge| edge.json()).collect::<Value>(),
        "conflicts": united.conflicts,
    })
}

/// Readable form: one line for each edge, the largest disagreement first.
pub fn table(united: &United) -> String {
    let mut edges: Vec<_> = united.edges.iter().collect();
    edges.sort_by(|a, b| b.spread().total_cmp(&a.spread()));
    let name = |edge: &super::unite::Opinions| format!("{} -> {}", edge.from, edge.to);
    let width = edges.iter().map(|edge| name(edge).chars().count()).max().unwrap_or(0).max(4);
    let mut text = format!("{:width$} {:>7} {:>7}  said\n", "edge", "weight", "spread");
    for edge in edges {
        let said: Vec<String> = edge.said.iter().map(|(map, weight)| format!("{weight} ({map})")).collect();
        let conflict = if edge.is_conflict() { "; SIGNS CONFLICT" } else { "" };
        text += &format!(
            "{:width$} {:>7} {:>7.2}  {}{conflict}\n",
            name(edge),
            edge.weight.value(),
            edge.spread(),
            said.join(", ")
        );
    }
    united.conflicts.iter().for_each(|conflict| text += &format!("note: {conflict}\n"));
    text + &format!(
        "{}: {} concepts, {} edges\n",
        united.map.name,
        united.map.concept.len(),
        united.map.edge.len()
    )
}
