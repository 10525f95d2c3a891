//! Errors about unknown names, with a suggestion.

/// The known name nearest to the given one; none if none is near.
pub fn meant<'a>(said: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let lower = |text: &str| text.to_lowercase().chars().collect::<Vec<_>>();
    let wrong = lower(said);
    let near = known.into_iter().map(|name| (distance(&wrong, &lower(name)), name));
    let (edits, name) = near.min_by_key(|(edits, _)| *edits)?;
    (edits <= (wrong.len().max(name.len()) / 3).max(1)).then_some(name)
}

/// Sentence about an unknown name: `there is no scene "pta": did you mean "pat"? Known are pat, lash`.
pub fn unknown<'a>(what: &str, said: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    let all = known.join(", ");
    match meant(said, known) {
        Some(name) => format!("there is no {what} \"{said}\": did you mean \"{name}\"? Known are {all}"),
        None => format!("there is no {what} \"{said}\"; known are {all}"),
    }
}

/// Edit distance: insertions, deletions, replacements and swaps of neighbours.
fn distance(a: &[char], b: &[char]) -> usize {
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    rows[0] = (0..=b.len()).collect();
    for i in 1..=a.len() {
        rows[i][0] = i;
        for j in 1..=b.len() {
            let other = usize::from(a[i - 1] != b[j - 1]);
            let mut least = (rows[i - 1][j] + 1).min(rows[i][j - 1] + 1).min(rows[i - 1][j - 1] + other);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(rows[i - 2][j - 2] + 1);
            }
            rows[i][j] = least;
        }
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_finger_is_seen() {
        let known = ["pat", "lash", "two-hands", "settle_ns"];
        for (said, name) in [("pta", "pat"), ("PAT", "pat"), ("lsh", "lash"), ("twohands", "two-hands")] {
            assert_eq!(meant(said, known), Some(name));
        }
        assert_eq!(meant("setle_n", known), Some("settle_ns"));
        assert_eq!((meant("tickle", known), meant("", known), meant("pat", [])), (None, None, None));
        assert_eq!(
            unknown("scene", "pta", ["pat", "lash"]),
            "there is no scene \"pta\": did you mean \"pat\"? Known are pat, lash"
        );
    }
}
