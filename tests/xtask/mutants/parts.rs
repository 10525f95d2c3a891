//! The parts of the code that are mutated.

/// A part to be mutated, and the tests that should notice.
pub struct Part {
    pub name: &'static str,
    pub folders: &'static [&'static str],
    pub package: &'static str,
    /// Test target besides the unit tests.
    pub target: &'static str,
    /// Filters of test names; the other tests test other parts.
    pub tests: &'static [&'static str],
    /// Filters of the tests that take seconds for each change and notice hardly one that no other test does.
    pub long: &'static [&'static str],
}

/// All parts.
pub const PARTS: [Part; 3] = [
    Part {
        name: "contact",
        folders: &["core/src/segment", "core/src/measure", "core/src/track", "core/src/contact"],
        package: "taxel-core",
        target: "core",
        tests: &[
            "segment::",
            "measure::",
            "track::",
            "contact",
            "hard::",
            "moments",
            "dense",
            "bounds::",
            "tracking::",
            "board",
        ],
        long: &[
            "baseline::",
            "sparse_is_dense",
            "bounds::map",
            "bounds::nmi",
            "axes_hold_at_every_magnitude",
            "never_slip",
            "slides_under_the_whole_panel",
            "that_moves_as_a_whole",
        ],
    },
    Part {
        name: "wire",
        folders: &["core/src/wire"],
        package: "taxel-core",
        target: "core",
        tests: &["wire", "golden", "board", "exchange"],
        long: &[],
    },
    Part {
        name: "store",
        folders: &["firmware/store/src"],
        package: "taxel-store",
        target: "settings",
        tests: &[""],
        long: &[],
    },
];
