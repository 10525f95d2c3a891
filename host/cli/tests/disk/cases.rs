//! The commands that write files, with their outputs.

/// How a complete output is recognised.
#[derive(Debug, Clone, Copy)]
pub enum Content {
    /// Each run writes the same.
    Same,
    /// It ends like this; it contains a date or a name.
    Ends(&'static str),
    /// A TOML table; it contains a date or measurements.
    Toml,
    /// A recording, of which a fault leaves earlier messages.
    Recording,
}

/// An output of a command.
#[derive(Debug, Clone, Copy)]
pub struct Output {
    pub name: &'static str,
    pub is_folder: bool,
    pub content: Content,
}

impl Output {
    /// True if a file is the output, or in it.
    pub fn holds(&self, name: &str) -> bool {
        let temporary = name.contains(".part");
        let rest = name.strip_prefix(self.name).filter(|_| !temporary);
        rest.is_some_and(|rest| {
            if self.is_folder { rest.starts_with('/') || rest.is_empty() } else { rest.is_empty() }
        })
    }

    /// Files that it had before.
    pub fn old(&self) -> Vec<String> {
        match (self.is_folder, self.name) {
            (false, name) => vec![name.into()],
            (true, "set") => vec!["set/data/old.parquet".into(), "set/meta/old.json".into()],
            (true, name) => vec![format!("{name}/old.png"), format!("{name}/mat/old.png")],
        }
    }
}

/// When a command may replace an output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Replaces {
    /// With `--force`.
    Forced,
    /// Always: the user names the file to change.
    Always,
}

/// A command.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    pub name: &'static str,
    pub args: &'static str,
    pub outputs: &'static [Output],
    pub replaces: Replaces,
    /// It takes seconds: fewer of its calls are tried.
    pub is_slow: bool,
}

impl Case {
    /// Variants: the output exists or not.
    pub fn variants(&self) -> impl Iterator<Item = bool> + use<> {
        let always = self.replaces == Replaces::Always;
        [false, true].into_iter().filter(move |replaces| *replaces || !always)
    }

    /// The command line.
    pub fn args(&self, replaces: bool) -> Vec<&'static str> {
        let force = (replaces && self.replaces == Replaces::Forced).then_some("--force");
        self.args.split(' ').chain(force).collect()
    }

    /// Name of a variant.
    pub fn shown(&self, replaces: bool) -> &'static str {
        if replaces { "exists" } else { "new" }
    }
}

const fn file(name: &'static str) -> Output {
    Output { name, is_folder: false, content: Content::Same }
}

const fn folder(name: &'static str) -> Output {
    Output { name, is_folder: true, content: Content::Same }
}

const fn ends(name: &'static str, end: &'static str) -> Output {
    Output { name, is_folder: false, content: Content::Ends(end) }
}

const fn table(name: &'static str) -> Output {
    Output { name, is_folder: false, content: Content::Toml }
}

const fn recording(name: &'static str) -> Output {
    Output { name, is_folder: false, content: Content::Recording }
}

const fn case(name: &'static str, args: &'static str, outputs: &'static [Output]) -> Case {
    Case { name, args, outputs, replaces: Replaces::Forced, is_slow: false }
}

/// All commands.
pub const CASES: &[Case] = &[
    case("export csv", "export in.mcap --to csv --every 20 -o out.csv", &[file("out.csv")]),
    case("export contacts", "export in.mcap --to csv --contacts -o out.csv", &[file("out.csv")]),
    case("export npz", "export in.mcap --to npz --every 10 -o out.npz", &[file("out.npz")]),
    case("export png", "export in.mcap --to png --every 40 -o images", &[folder("images")]),
    case("report", "report in.mcap -o out.html", &[ends("out.html", "</html>\n")]),
    case("record", "record --source sim:press --for 2s -o out.mcap", &[recording("out.mcap")]),
    case("robot record", "record robot.toml --for 2s -o out.mcap", &[recording("out.mcap")]),
    case(
        "record ros2",
        "record --source sim:press --for 1.5s --ros2 -o out.mcap",
        &[recording("out.mcap"), recording("out.ros2.mcap")],
    ),
    case(
        "record rotate",
        "record --source sim:press --for 2.5s --rotate 1s -o out.mcap",
        &[recording("out.mcap"), recording("out-0002.mcap"), recording("out-0003.mcap")],
    ),
    case("info repair", "info cut.mcap --repair -o out.mcap", &[file("out.mcap")]),
    case("info repair whole", "info in.mcap --repair -o out.mcap", &[file("out.mcap")]),
    Case {
        replaces: Replaces::Always,
        ..case("info repair in place", "info cut.mcap --repair --in-place", &[file("cut.mcap")])
    },
    case(
        "config new",
        "config new garment.toml --like block-4x16",
        &[file("garment.toml"), file("taxel-garment.schema.json")],
    ),
    case("config scene", "config scene scene.toml", &[file("scene.toml"), file("taxel-scene.schema.json")]),
    Case {
        is_slow: true,
        ..case(
            "calibrate",
            "calibrate --simulate 7 --garment block-4x16 --weights 5,20 -o out.toml",
            &[table("out.toml")],
        )
    },
    case("body show", "body show reference -o body.svg", &[ends("body.svg", "</svg>\n")]),
    case("body places", "body places reference --robot reference -o places.csv", &[file("places.csv")]),
    case("body drape", "body drape board.obj --panel chest --at 0,0,0 -o chest.txt", &[file("chest.txt")]),
    case("body fit", "body fit reference --touches known.csv -o fitted.toml", &[file("fitted.toml")]),
    case("setup", "setup --simulate 7 -o out.toml", &[file("out.toml")]),
    case("calibrate settle", "calibrate settle --source sim:weights.toml -o out.toml", &[table("out.toml")]),
    case("fcm combine", "fcm combine tactile tactile -o map.toml", &[file("map.toml")]),
    case("fcm merge", "fcm merge tactile tactile -o map.toml", &[file("map.toml")]),
    case("fcm draw", "fcm draw tactile -o map.dot", &[file("map.dot")]),
    case("fcm learn", "fcm learn tactile --touches touches.csv --folds 2 -o map.toml", &[file("map.toml")]),
    case("shapes prune", "shapes prune base.json -o out.json", &[file("out.json")]),
    Case {
        replaces: Replaces::Always,
        ..case(
            "shapes learn",
            "shapes learn more --source sim:box.toml --touches 2 -o base.json",
            &[file("base.json")],
        )
    },
];
