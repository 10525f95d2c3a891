//! Which boards of a robot are on the same USB host controller, and so on one time.

use super::finding::Finding;

/// Returns what is found of the board at `at`, given names and controllers of all boards; none if it is on no
/// controller.
pub fn controller(boards: &[(&str, Option<usize>)], at: usize) -> Option<Finding> {
    let (name, own) = *boards.get(at)?;
    own?;
    let shares = |(other, bus): &&(&str, Option<usize>)| *bus == own && *other != name;
    let beside: Vec<&str> = boards.iter().filter(shares).map(|(other, _)| *other).collect();
    let what = match &beside[..] {
        [] => "no other board is on its USB host controller: its time is as certain as `clock` says".into(),
        beside => format!("it shares its USB host controller, and so one time, with {}", beside.join(", ")),
    };
    Some(Finding::good("controller", what))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boards_are_shown_who_shares_their_controller() {
        let boards =
            [("a", Some(0)), ("b", Some(1)), ("c", None), ("d", Some(0)), ("e", Some(0)), ("f", None)];
        let reported = |at| controller(&boards, at).map(|found| found.what);
        let ends = |at, end: &str| reported(at).is_some_and(|what| what.ends_with(end));
        assert!(ends(0, "with d, e") && ends(3, "with a, e") && ends(4, "with a, d"));
        assert!(reported(1).unwrap().starts_with("no other board"));
        assert_eq!([reported(2), reported(5), reported(6)], [None, None, None]);
    }
}
