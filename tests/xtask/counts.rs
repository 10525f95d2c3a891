//! Counts the tests that a program ran, from its output.

use std::ops::AddAssign;

/// Tests by result.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Counts {
    /// Tests that passed.
    pub passed: u32,
    /// Tests that failed.
    pub failed: u32,
    /// Tests that were skipped.
    pub skipped: u32,
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Counts) {
        self.passed += other.passed;
        self.failed += other.failed;
        self.skipped += other.skipped;
    }
}

impl Counts {
    /// Sum over all `test result:` lines of cargo and all `# pass` lines of node in a log; none if there are
    /// no such lines.
    pub fn of(log: &str) -> Option<Counts> {
        let mut counts = Counts::default();
        let mut found = false;
        for line in log.lines() {
            let Some(one) = cargo(line).or_else(|| node(line)) else { continue };
            counts += one;
            found = true;
        }
        found.then_some(counts)
    }
}

/// "test result: ok. 12 passed; 0 failed; 1 ignored; 0 measured; ..."
fn cargo(line: &str) -> Option<Counts> {
    let (_, counts) = line.trim().strip_prefix("test result: ")?.split_once(". ")?;
    let number = |what: &str| {
        let part = counts.split("; ").find_map(|part| part.strip_suffix(what));
        part.and_then(|number| number.trim().parse().ok()).unwrap_or(0)
    };
    Some(Counts { passed: number("passed"), failed: number("failed"), skipped: number("ignored") })
}

/// "# pass 5", "# fail 0", "# skipped 1", each on its own line.
fn node(line: &str) -> Option<Counts> {
    let number = |what| line.strip_prefix(what)?.trim().parse::<u32>().ok();
    let none = Counts::default();
    number("# pass ")
        .map(|passed| Counts { passed, ..none })
        .or_else(|| number("# fail ").map(|failed| Counts { failed, ..none }))
        .or_else(|| number("# skipped ").map(|skipped| Counts { skipped, ..none }))
}

#[cfg(test)]
mod tests {
    use super::Counts;

    #[test]
    fn sums_what_cargo_and_node_print() {
        let log = "running 3 tests\n\
            test result: ok. 3 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.01s\n\
            test result: FAILED. 1 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.01s\n\
            # tests 9\n# pass 7\n# fail 1\n# cancelled 0\n# skipped 1\n";
        assert_eq!(Counts::of(log), Some(Counts { passed: 11, failed: 3, skipped: 2 }));
        assert_eq!(Counts::of("Finished"), None);
    }
}
