//! The layers of a crate: which module imports which, read from its source.
//!
//! A module is a file, or a folder with its `mod.rs` (or the file beside it). Imports are the paths that begin
//! with `crate`, `super` or `self`, also outside of `use`; what a module hands on by `pub use` is followed to
//! the module that defines it. Unit tests, at the end of a file, are left out.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Path of a module from the crate's root: `["client", "known"]`; the root itself is empty.
pub type Module = Vec<String>;

/// A crate's modules and their imports.
#[derive(Debug, Default)]
pub struct Layers {
    /// Source of each module, without comments and tests.
    sources: BTreeMap<Module, String>,
    /// Names that a module hands on: the path that each stands for.
    handed: BTreeMap<Module, BTreeMap<String, Vec<String>>>,
}

impl Layers {
    /// Reads the sources of a crate, whose root is `lib.rs` or `main.rs` of this folder.
    pub fn read(folder: &Path) -> Layers {
        let mut layers = Layers::default();
        layers.add(folder, &Vec::new());
        for (module, source) in &layers.sources {
            let names = statements(source).filter(|(is_handed, _)| *is_handed);
            let leaves = names.flat_map(|(_, tree)| leaves(&tree));
            let named = leaves.filter_map(|(path, name)| Some((name, absolute(&path, module)?)));
            layers.handed.insert(module.clone(), named.collect());
        }
        layers
    }

    /// Adds the modules of a folder.
    fn add(&mut self, folder: &Path, module: &Module) {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        for entry in entries.map(|entry| entry.path()) {
            let name = entry.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let mut own = module.clone();
            if !matches!(name.as_str(), "lib" | "main" | "mod") {
                own.push(name);
            }
            if entry.is_dir() {
                self.add(&entry, &own);
            } else if entry.extension().is_some_and(|end| end == "rs") && !entry.ends_with("tests.rs") {
                let text = std::fs::read_to_string(&entry).unwrap_or_default();
                self.sources.entry(own).or_default().push_str(&code(&text));
            }
        }
    }

    /// Number of modules.
    pub fn count(&self) -> usize {
        self.sources.len()
    }

    /// Modules that each module imports from.
    fn imports(&self) -> BTreeMap<&Module, BTreeSet<Module>> {
        let of = |module: &Module, source: &str| {
            let used = statements(source).filter(|(is_handed, _)| !is_handed);
            let used = used.flat_map(|(_, tree)| leaves(&tree)).map(|(path, _)| path);
            let inline = inline(source);
            let paths = used.chain(inline).filter_map(|path| absolute(&path, module));
            let mut found: BTreeSet<Module> = paths.map(|path| self.home(&path)).collect();
            found.remove(module);
            // The root is a crate's face: it defines nothing that a module needs, but hands on other crates.
            found.remove(&Vec::new());
            found
        };
        self.sources.iter().map(|(module, source)| (module, of(module, source))).collect()
    }

    /// Module that defines what a path from the root leads to.
    fn home(&self, path: &[String]) -> Module {
        let mut path = path.to_vec();
        // What is handed on may be handed on again; circles of names do not compile.
        for _ in 0..8 {
            let depth = (0..=path.len()).rev().find(|n| self.sources.contains_key(&path[..*n]));
            let depth = depth.unwrap_or(0);
            let next = path.get(depth).and_then(|name| self.handed.get(&path[..depth])?.get(name));
            let Some(target) = next else { return path[..depth].to_vec() };
            path = target.iter().chain(&path[depth + 1..]).cloned().collect();
        }
        path
    }

    /// Circles: in each folder the entries that import each other, directly or through others. The folder's
    /// own module counts as an entry, named `mod`.
    pub fn circles(&self) -> Vec<String> {
        let mut edges: BTreeMap<Module, BTreeMap<String, BTreeSet<String>>> = BTreeMap::new();
        for (from, targets) in self.imports() {
            for to in &targets {
                let shared = from.iter().zip(to).take_while(|(a, b)| a == b).count();
                let entry = |module: &Module| module.get(shared).map_or("mod", String::as_str).to_string();
                let folder = edges.entry(from[..shared].to_vec()).or_default();
                folder.entry(entry(from)).or_default().insert(entry(to));
            }
        }
        let circles = edges.iter().filter_map(|(folder, edges)| {
            let members: Vec<&str> =
                edges.keys().filter(|name| reaches(edges, name, name)).map(String::as_str).collect();
            (!members.is_empty()).then(|| format!("{}: {}", folder.join("/"), members.join(", ")))
        });
        circles.collect()
    }

    /// Names of types that two modules of these crates define, with these modules; arguments of commands and
    /// errors excepted.
    pub fn twice(crates: &[(&str, Layers)]) -> Vec<String> {
        let mut homes: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
        let modules = crates
            .iter()
            .flat_map(|(name, layers)| layers.sources.iter().map(move |(at, text)| (name, at, text)));
        for (krate, module, source) in modules {
            for name in source.lines().filter_map(defined).filter(|name| !matches!(*name, "Args" | "Error")) {
                // Twice in a module: one for each machine or feature.
                homes.entry(name).or_default().insert(format!("{krate}/{}", module.join("/")));
            }
        }
        let twice = homes.into_iter().filter(|(_, modules)| modules.len() > 1);
        twice.map(|(name, modules)| format!("{name}: {}", Vec::from_iter(modules).join(", "))).collect()
    }

    /// Modules of the root in the order in which it declares them.
    pub fn order(&self) -> Vec<String> {
        let root = self.sources.get(&Vec::new()).map_or("", String::as_str);
        let names = root.lines().filter_map(|line| {
            let rest = line.strip_prefix("pub mod ").or_else(|| line.strip_prefix("mod "))?;
            rest.strip_suffix(';').map(String::from)
        });
        names.collect()
    }

    /// Imports between modules of the root against their order: `a imports b`.
    pub fn upward(&self) -> Vec<String> {
        let order = self.order();
        let place = |name: &String| order.iter().position(|known| known == name);
        let mut found = BTreeSet::new();
        for (from, targets) in self.imports() {
            for to in &targets {
                if let (Some(from), Some(to)) = (from.first(), to.first())
                    && place(from) < place(to)
                {
                    found.insert(format!("{from} imports {to}"));
                }
            }
        }
        found.into_iter().collect()
    }
}

/// Name of the type that begins on this line, outside of functions and traits.
fn defined(line: &str) -> Option<&str> {
    let rest = line.strip_prefix("pub").map_or(line, |rest| {
        let rest =
            rest.strip_prefix('(').and_then(|rest| rest.split_once(')')).map_or(rest, |(_, rest)| rest);
        rest.trim_start()
    });
    let kinds = ["struct ", "enum ", "trait ", "type ", "union "];
    let rest = kinds.iter().find_map(|kind| rest.strip_prefix(kind))?;
    rest.split(|sign: char| !(sign.is_alphanumeric() || sign == '_')).next()
}

/// True if `to` is imported by `from`, directly or through others.
fn reaches(edges: &BTreeMap<String, BTreeSet<String>>, from: &str, to: &str) -> bool {
    let (mut seen, mut open) = (BTreeSet::new(), vec![from]);
    while let Some(name) = open.pop() {
        for next in edges.get(name).into_iter().flatten() {
            if next == to {
                return true;
            }
            if seen.insert(next.as_str()) {
                open.push(next);
            }
        }
    }
    false
}

/// Source without comments, and without the unit tests at its end.
fn code(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    let lines = text.lines().map(|line| match line.find("//") {
        // A colon before it: an address in a string.
        Some(at) if !line[..at].ends_with(':') => &line[..at],
        _ => line,
    });
    lines.map(|line| format!("{line}\n")).collect()
}

/// `use` statements: whether they hand names on, and the tree.
fn statements(source: &str) -> impl Iterator<Item = (bool, String)> + '_ {
    let begins = source.match_indices("use ").filter(|(at, _)| {
        let before = source[..*at].rsplit('\n').next().unwrap_or_default().trim_start();
        before.is_empty() || (before.starts_with("pub") && before.ends_with(' '))
    });
    begins.filter_map(|(at, word)| {
        let rest = &source[at + word.len()..];
        let tree = &rest[..rest.find(';')?];
        Some((source[..at].ends_with("pub ") || source[..at].ends_with(") "), tree.to_string()))
    })
}

/// Leaves of a `use` tree: path, and the name that it gets.
fn leaves(tree: &str) -> Vec<(Vec<String>, String)> {
    let tree = tree.trim();
    let Some(open) = tree.find('{') else {
        let (path, name) = tree.split_once(" as ").unwrap_or((tree, ""));
        let mut path: Vec<String> = path.trim().split("::").map(|part| part.trim().into()).collect();
        if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
            path.pop();
        }
        let last = path.last().cloned().unwrap_or_default();
        return vec![(path, if name.is_empty() { last } else { name.trim().into() })];
    };
    let inside = &tree[open + 1..tree.rfind('}').unwrap_or(tree.len())];
    let (mut depth, mut start, mut parts) = (0, 0, Vec::new());
    for (at, sign) in inside.char_indices() {
        match sign {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&inside[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&inside[start..]);
    let parts = parts.into_iter().filter(|part| !part.trim().is_empty());
    parts.flat_map(|part| leaves(&format!("{}{}", &tree[..open], part.trim()))).collect()
}

/// Paths outside of `use` statements.
fn inline(source: &str) -> impl Iterator<Item = Vec<String>> + '_ {
    let begins = ["crate::", "super::"].into_iter().flat_map(|word| source.match_indices(word));
    begins.filter_map(|(at, _)| {
        let line = source[..at].rsplit('\n').next().unwrap_or_default();
        let is_middle = source[..at].ends_with(|sign: char| sign.is_alphanumeric() || "_:\"".contains(sign));
        if is_middle
            || line.trim_start().starts_with("use ")
            || line.trim_start().starts_with("pub") && line.contains("use ")
        {
            return None;
        }
        let rest = &source[at..];
        let end = rest.find(|sign: char| !(sign.is_alphanumeric() || "_:".contains(sign)));
        let path = &rest[..end.unwrap_or(rest.len())];
        Some(path.trim_end_matches(':').split("::").map(String::from).collect())
    })
}

/// A path from the root; none if it leads to another crate.
fn absolute(path: &[String], module: &Module) -> Option<Vec<String>> {
    let ups = path.iter().take_while(|part| *part == "super").count();
    let rest = path.iter().skip(ups).cloned();
    match path.first()?.as_str() {
        "crate" => Some(path[1..].to_vec()),
        "self" => Some(module.iter().cloned().chain(path[1..].iter().cloned()).collect()),
        "super" => Some(module.iter().take(module.len().checked_sub(ups)?).cloned().chain(rest).collect()),
        // A child, in the file that declares it.
        _ => Some(module.iter().cloned().chain(path.iter().cloned()).collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paths::root;

    #[test]
    fn modules_of_the_host_import_in_one_direction() {
        for (folder, least) in [("sim", 20), ("taxel", 200), ("cli", 150), ("python", 15)] {
            let layers = Layers::read(&root().join("host").join(folder).join("src"));
            assert!(layers.count() > least, "{folder}: {} modules", layers.count());
            assert_eq!((layers.circles(), layers.upward()), Default::default(), "{folder}");
        }
    }

    #[test]
    fn modules_of_the_core_import_modules_before_them() {
        let layers = Layers::read(&root().join("core/src"));
        assert_eq!(layers.upward(), Vec::<String>::new());
        assert_eq!(layers.circles(), Vec::<String>::new());
    }

    #[test]
    fn modules_of_the_board_and_of_the_tests_import_in_one_direction() {
        for (folder, least) in [
            ("firmware/src", 25),
            ("firmware/store/src", 4),
            ("tests/suite/src", 3),
            ("tests/bench/src", 5),
            ("tests/xtask", 25),
            ("fuzz/src", 8),
        ] {
            let layers = Layers::read(&root().join(folder));
            assert!(layers.count() > least, "{folder}: {} modules", layers.count());
            assert_eq!(layers.circles(), Vec::<String>::new(), "{folder}");
        }
    }

    /// A session is driven by its own iterator, and by the one loop that follows boards.
    #[test]
    fn one_loop_follows_boards() {
        let layers = Layers::read(&root().join("host/taxel/src"));
        let calls =
            |source: &String| ["session.turn(", "self.turn("].iter().any(|call| source.contains(call));
        let callers = layers.sources.iter().filter(|(_, source)| calls(source));
        let callers: Vec<String> = callers.map(|(module, _)| module.join("/")).collect();
        assert_eq!(callers, ["robot/follow", "session"]);
    }

    #[test]
    fn a_type_name_stands_for_one_thing() {
        let groups: [&[&str]; 7] = [
            &["core", "firmware", "firmware/store", "tests/suite"],
            &["host/sim"],
            &["host/taxel"],
            &["host/cli"],
            &["host/learn"],
            &["host/python"],
            &["tests/bench"],
        ];
        for group in groups {
            let read = |name: &&'static str| (*name, Layers::read(&root().join(name).join("src")));
            let crates: Vec<_> = group.iter().map(read).collect();
            assert_eq!(Layers::twice(&crates), Vec::<String>::new());
        }
        assert_eq!(defined("pub(super) struct Moment<'a> {"), Some("Moment"));
        assert_eq!(defined("pub type State = [i32; 4];"), Some("State"));
        assert_eq!(defined("    type Item = u8;"), None);
    }

    #[test]
    fn paths_are_read_from_use_trees() {
        let names = |tree: &str| {
            leaves(tree)
                .into_iter()
                .map(|(path, name)| format!("{}={name}", path.join(".")))
                .collect::<Vec<_>>()
        };
        assert_eq!(names("crate::a"), ["crate.a=a"]);
        assert_eq!(names("super::{self as up, b::{C, D as E}}"), ["super=up", "super.b.C=C", "super.b.D=E"]);
        let module = vec!["a".to_string(), "b".to_string()];
        let path = |text: &str| text.split("::").map(String::from).collect::<Vec<_>>();
        assert_eq!(absolute(&path("super::c"), &module), Some(path("a::c")));
        assert_eq!(absolute(&path("super::super::c"), &module), Some(path("c")));
    }
}
