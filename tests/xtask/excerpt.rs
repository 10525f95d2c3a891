//! Excerpt of a failed check's log.

/// Lines from its end.
const LAST: usize = 60;
/// Lines of one test program's failures.
const FAILURES: usize = 80;

/// Failures of each test program, and the end of the log.
pub fn excerpt(log: &str) -> String {
    let lines: Vec<&str> = log.lines().collect();
    let last = lines.len().saturating_sub(LAST);
    let mut shown: Vec<&str> = Vec::new();
    let mut at = 0;
    while at < last {
        let is_failure = lines[at] == "failures:" || lines[at].starts_with("not ok ");
        let end = if is_failure { end_of(&lines, at) } else { at };
        shown.extend(&lines[at..end.min(at + FAILURES)]);
        at = end.max(at + 1);
    }
    shown.extend(&lines[at.min(lines.len())..]);
    shown.join("\n")
}

/// End of the text about failures: behind cargo's summary of a program, or at node's next test.
fn end_of(lines: &[&str], begin: usize) -> usize {
    let rest = &lines[begin + 1..];
    let sum = rest.iter().position(|line| line.starts_with("test result: "));
    let next = rest.iter().position(|line| line.starts_with("ok ") || line.starts_with("not ok "));
    match if lines[begin] == "failures:" { sum.map(|sum| sum + 1) } else { next } {
        Some(length) => begin + 1 + length,
        None => lines.len(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_is_shown_wherever_it_stands() {
        let more = |count| "test a ... ok\n".repeat(count);
        let failures = "failures:\n\n---- b ----\nwhy\n\ntest result: FAILED. 1 passed; 1 failed\n";
        let log = format!("{}{failures}{}the end", more(500), more(500));
        let shown = excerpt(&log);
        assert!(shown.starts_with(failures) && shown.ends_with("test a ... ok\nthe end"), "{shown}");
        assert_eq!(shown.lines().count(), failures.lines().count() + LAST);
        let node = format!("{}not ok 3 - c\n  why\nok 4 - d\n{}", "ok 1\n".repeat(90), "ok 5\n".repeat(90));
        assert!(excerpt(&node).starts_with("not ok 3 - c\n  why\nok 5"), "{}", excerpt(&node));
        assert_eq!(excerpt("one\ntwo"), "one\ntwo");
    }
}
