//! All mutants of a run in one build of the tests: a function that has some becomes a `match` over a number
//! in the environment, with a copy of its body for each. cargo-mutants builds the tests again for each
//! mutant, which takes longer than running them.

use super::list::{Mutant, Place};
use crate::{paths, process};
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Environment variable with the number of the mutant that is in force, from 1.
const VARIABLE: &str = "TAXEL_MUTANT";
/// Shortest time after which tests are taken for endless. On a busy machine they may take long.
const PATIENCE: Duration = Duration::from_secs(60);
/// The module that says which mutant is in force, for each crate that has some.
const MODULE: &str = r#"
#[doc(hidden)]
mod mutant {
    extern crate std;
    static NUMBER: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    pub(crate) fn number() -> u32 {
        let read = || std::env::var("TAXEL_MUTANT").ok()?.parse().ok();
        *NUMBER.get_or_init(|| read().unwrap_or(0))
    }
}
"#;

/// How the tests end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    Passed,
    Failed,
    Endless,
}

/// Programs that hold the mutants.
pub struct Built {
    /// Numbers of the mutants that are not in the programs: those in constants, in `const fn`, and in
    /// functions that return a type without a name.
    pub left: BTreeSet<usize>,
    /// Numbers of those that do not compile, where the same function without the change does.
    pub unviable: BTreeSet<usize>,
    programs: Vec<PathBuf>,
}

/// Lines of a changed file that belong to a mutant; without a number, to the function as it was.
type Arms = Vec<(Option<usize>, Range<usize>)>;

/// Bytes of a function's body, and its mutants with their numbers.
type Function<'a> = (Range<usize>, Vec<(usize, &'a Mutant)>);

/// Builds the tests of packages with all mutants; `command` is `cargo` with its environment and targets.
pub fn build(mutants: &[Mutant], mut command: Command, log: &Path) -> Result<Built, String> {
    let tree = tree();
    copy(&tree)?;
    command.current_dir(&tree).args(["--no-run", "--message-format", "short"]);
    let (mut left, mut unviable) = (BTreeSet::new(), BTreeSet::new());
    loop {
        let files = change(&tree, mutants, &unviable, &mut left)?;
        let output = command.stdin(Stdio::null()).output().map_err(|error| error.to_string())?;
        let text = String::from_utf8_lossy(&output.stderr);
        if output.status.success() {
            let path =
                |line: &str| Some(line.trim().strip_prefix("Executable")?.split_once('(')?.1.to_string());
            let programs = text.lines().filter_map(path).map(|path| tree.join(path.trim_end_matches(')')));
            return Ok(Built { left, unviable, programs: programs.collect() });
        }
        let before = unviable.len();
        for (file, line) in text.lines().filter_map(error) {
            let arms = files.iter().find(|(name, _)| name == file).map(|(_, arms)| arms);
            let at = arms.into_iter().flatten().find(|(_, lines)| lines.contains(&line));
            unviable.extend(at.and_then(|(number, _)| *number));
        }
        if unviable.len() == before {
            let _ = std::fs::write(log, text.as_bytes());
            return Err(format!("the tests do not build with the changes: see {}", log.display()));
        }
    }
}

/// A copy of the sources, which is changed.
pub fn tree() -> PathBuf {
    paths::target().join("mutants/tree")
}

/// File and line of an error of the compiler.
fn error(line: &str) -> Option<(&str, usize)> {
    let mut parts = line.splitn(4, ':');
    let (file, number, rest) = (parts.next()?, parts.next()?.parse().ok()?, parts.nth(1)?);
    rest.trim_start().starts_with("error").then_some((file, number))
}

/// Copies the files that git knows or would take.
pub fn copy(tree: &Path) -> Result<(), String> {
    let mut list = Command::new("git");
    list.args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"]).current_dir(paths::root());
    let list = process::output(&mut list).ok_or("`git ls-files` failed")?;
    let _ = std::fs::remove_dir_all(tree);
    for file in list.split('\0').filter(|file| paths::root().join(file).is_file()) {
        let to = tree.join(file);
        let made = to.parent().map_or(Ok(()), std::fs::create_dir_all);
        made.and_then(|()| std::fs::copy(paths::root().join(file), &to))
            .map_err(|error| format!("{}: {error}", to.display()))?;
    }
    Ok(())
}

/// Changes all files of the tree that have mutants. Returns their names with the lines of each mutant.
fn change(
    tree: &Path,
    mutants: &[Mutant],
    unviable: &BTreeSet<usize>,
    left: &mut BTreeSet<usize>,
) -> Result<Vec<(String, Arms)>, String> {
    let read = |file: &str| {
        std::fs::read_to_string(paths::root().join(file)).map_err(|error| format!("{file}: {error}"))
    };
    let write = |file: &str, text: String| {
        std::fs::write(tree.join(file), text).map_err(|error| format!("{file}: {error}"))
    };
    let files: BTreeSet<&str> = mutants.iter().map(|mutant| mutant.file.as_str()).collect();
    let crates: BTreeSet<&str> =
        files.iter().filter_map(|file| file.split_once("/src/")).map(|(folder, _)| folder).collect();
    for folder in crates {
        let file = format!("{folder}/src/lib.rs");
        write(&file, read(&file)? + MODULE)?;
    }
    let mut changed = Vec::new();
    for file in files {
        let of_file = mutants.iter().enumerate();
        let of_file = of_file.filter(|(number, mutant)| mutant.file == file && !unviable.contains(number));
        // Copies of bodies that are always inlined multiply, and take minutes to compile.
        let source = read(file)?.replace("#[inline(always)]", "#[inline]");
        let (text, arms) = with_arms(&source, of_file, left);
        write(file, text)?;
        changed.push((file.to_string(), arms));
    }
    Ok(changed)
}

/// A source file with its mutants, and the lines of each. Those without a place join `left`.
fn with_arms<'a>(
    source: &str,
    mutants: impl Iterator<Item = (usize, &'a Mutant)>,
    left: &mut BTreeSet<usize>,
) -> (String, Arms) {
    let mut functions: Vec<Function> = Vec::new();
    for (number, mutant) in mutants {
        let body = mutant.function.as_ref().and_then(|function| body(source, &bytes(source, function)));
        let within =
            |body: &Range<usize>, span: Range<usize>| body.start <= span.start && span.end <= body.end;
        let Some(body) = body.filter(|body| within(body, bytes(source, &mutant.span))) else {
            left.insert(number);
            continue;
        };
        match functions.iter_mut().find(|(other, _)| other.start < body.end && body.start < other.end) {
            Some((other, list)) if *other == body => list.push((number, mutant)),
            // A function in a function.
            Some(_) => _ = left.insert(number),
            None => functions.push((body, vec![(number, mutant)])),
        }
    }
    functions.sort_by_key(|(body, _)| body.start);
    let (mut text, mut arms, mut from) = (String::new(), Arms::new(), 0);
    for (body, list) in functions {
        text += &source[from..body.start];
        text += "\nmatch crate::mutant::number() {\n";
        for (number, mutant) in list {
            let span = bytes(source, &mutant.span);
            let parts = [&source[body.start..span.start], &mutant.replacement, &source[span.end..body.end]];
            arm(&mut text, &mut arms, Some(number), &parts.concat());
        }
        arm(&mut text, &mut arms, None, &source[body.clone()]);
        text += "}\n";
        from = body.end;
    }
    text += &source[from..];
    (text, arms)
}

/// Adds a copy of a body.
fn arm(text: &mut String, arms: &mut Arms, number: Option<usize>, body: &str) {
    let first = text.lines().count() + 1;
    let when = number.map_or("_".into(), |number| (number + 1).to_string());
    *text += &format!("{when} => {{\n{body}\n}}\n");
    arms.push((number, first..text.lines().count() + 1));
}

/// What is between the braces of a function whose body may be chosen when it runs.
fn body(source: &str, function: &Range<usize>) -> Option<Range<usize>> {
    let text = source.get(function.clone())?;
    let mut depth = 0;
    let open = text.char_indices().find(|(_, sign)| {
        depth += i32::from(matches!(sign, '(' | '[')) - i32::from(matches!(sign, ')' | ']'));
        *sign == '{' && depth == 0
    })?;
    let head = &text[..open.0];
    let fixed = head.contains("const fn") || head.contains("-> impl");
    (!fixed).then_some(function.start + open.0 + 1..function.end - 1)
}

/// Bytes of a stretch of a text.
fn bytes(source: &str, span: &Range<Place>) -> Range<usize> {
    let byte = |(line, column): Place| {
        let before: usize = source.split_inclusive('\n').take(line - 1).map(str::len).sum();
        let column: usize = source[before..].chars().take(column - 1).map(char::len_utf8).sum();
        before + column
    };
    byte(span.start)..byte(span.end)
}

impl Built {
    /// The test program of a crate or of a target, by its name.
    pub fn program(&self, name: &str) -> Result<&Path, String> {
        let is = |path: &&PathBuf| {
            let name_of = |path: &PathBuf| Some(path.file_stem()?.to_str()?.rsplit_once('-')?.0.to_string());
            name_of(path).is_some_and(|program| program == name)
        };
        let found = self.programs.iter().find(is).map(PathBuf::as_path);
        found.ok_or(format!("there is no test program {name}"))
    }
}

/// Runs tests with one mutant, or with none: their end, and the time that they took.
pub fn run(
    program: &Path,
    folder: &Path,
    args: &[&str],
    mutant: Option<usize>,
    longest: Duration,
) -> Result<(End, Duration), String> {
    let mut command = Command::new(program);
    command.args(args).current_dir(folder).env("CARGO_MANIFEST_DIR", folder).env("INSTA_UPDATE", "no");
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.env(VARIABLE, mutant.map_or(0, |number| number + 1).to_string());
    let begun = Instant::now();
    let fail = |error: std::io::Error| format!("{}: {error}", program.display());
    let mut child = command.spawn().map_err(fail)?;
    let end = wait(&mut child, begun + longest.max(PATIENCE)).map_err(fail)?;
    Ok((end, begun.elapsed()))
}

fn wait(child: &mut Child, until: Instant) -> std::io::Result<End> {
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(if status.success() { End::Passed } else { End::Failed });
        }
        if Instant::now() > until {
            child.kill()?;
            child.wait()?;
            return Ok(End::Endless);
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_function_becomes_a_choice_of_its_bodies() {
        let source =
            "const A: u8 = 1 + 1;\nfn f(a: u8) -> u8 {\n    a + 1\n}\nconst fn g() -> u8 {\n    1 + 1\n}\n";
        let mutant = |span: Range<Place>, function: Option<Range<Place>>| Mutant {
            span,
            function,
            replacement: "-".into(),
            ..Mutant::default()
        };
        let mutants = [
            mutant((1, 17)..(1, 18), None),
            mutant((3, 7)..(3, 8), Some((2, 1)..(4, 2))),
            mutant((6, 7)..(6, 8), Some((5, 1)..(7, 2))),
        ];
        let mut left = BTreeSet::new();
        let (text, arms) = with_arms(source, mutants.iter().enumerate(), &mut left);
        assert_eq!(left, BTreeSet::from([0, 2]));
        let expected = "const A: u8 = 1 + 1;\nfn f(a: u8) -> u8 {\nmatch crate::mutant::number() {\n\
            2 => {\n\n    a - 1\n\n}\n_ => {\n\n    a + 1\n\n}\n}\n}\n\
            const fn g() -> u8 {\n    1 + 1\n}\n";
        assert_eq!(text, expected);
        assert_eq!(arms, [(Some(1), 4..9), (None, 9..14)]);
        assert_eq!(error("core/src/a.rs:6:7: error[E0308]: mismatched"), Some(("core/src/a.rs", 6)));
        assert_eq!(error("core/src/a.rs:6:7: warning: unused"), None);
    }
}
