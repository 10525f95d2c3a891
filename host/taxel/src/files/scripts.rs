//! Scripts of touches: shipped, or read from TOML files. Errors are one sentence that names the file and the
//! key.

use super::{garments, input};
use crate::error::{Context, Result, SettingError, UsageError};
use crate::sim::{self, FULL_SCALE, Pressure, Script};
use crate::text::words;
use std::path::{Path, absolute};
use taxel_core::garment::{Garment, Layout};
use toml::{Table, Value};

/// Reads a script; `file` names it in errors, and its stem the script if the text does not. Paths in it are
/// relative to the file's folder.
pub fn parse(text: &str, file: &str) -> Result<Script> {
    let mut script: Script =
        toml::from_str(text).map_err(|error| SettingError::Malformed(words::toml(&error, text, file)))?;
    if script.name.is_empty() {
        let stem = Path::new(file).file_stem().and_then(|s| s.to_str());
        script.name = stem.unwrap_or(file).into();
    }
    script.folder = Path::new(file).parent().unwrap_or(Path::new("")).into();
    script.check().map_err(|error| error.inside(format_args!("in {file}")))?;
    Ok(script)
}

/// Loads a shipped script of touches, or a TOML file.
pub fn load(name_or_path: &str) -> Result<Script> {
    if let Some(text) = sim::text(name_or_path) {
        return parse(text, &format!("{name_or_path}.toml"));
    }
    if !name_or_path.ends_with(".toml") && !Path::new(name_or_path).is_file() {
        let known = words::unknown("script of touches", name_or_path, sim::names());
        fail!(UsageError::Unknown, "{known}, or give a .toml file");
    }
    let text = input::text(name_or_path);
    parse(&text.with_context(|| format!("{name_or_path} cannot be read"))?, name_or_path)
}

/// Loads the garment that a script names.
pub fn garment(script: &Script) -> Result<Garment> {
    garments::load(&input::beside(&script.folder, &script.garment))
        .with_context(|| format!("in script {}: `garment`", script.name))
}

/// A garment's name, or its path in a form that holds in every folder.
pub(crate) fn lasting_path(garment: &str) -> Result<String> {
    match Path::new(garment).extension() {
        Some(_) => Ok(absolute(garment)?.display().to_string()),
        None => Ok(garment.into()),
    }
}

/// The script on a garment: what touches a panel that this lacks touches its largest one. Error if a touch still
/// has no place.
pub fn fit(script: Script, layout: &Layout) -> Result<Script> {
    // A script whose garment cannot be loaded keeps its places.
    let home =
        garment(&script).ok().and_then(|home| Layout::build(&home, usize::from(u16::MAX), FULL_SCALE).ok());
    let script = match home {
        Some(home) => sim::refit(&script, &home, layout),
        None => script,
    };
    Pressure::build(&script, layout)?;
    Ok(script)
}

/// A script that says nothing but what it must.
const PLAIN: &str =
    "duration_s = 1\n[[touch]]\npanel = \"\"\nshape = \"palm\"\nforce_n = 0\nat = [0, 0]\nstart_s = 0";
/// Keys that it must have.
const SAID: [&str; 6] = ["duration_s", "panel", "shape", "force_n", "at", "start_s"];

/// The text of a script's file, without what holds by default. Error for a number that TOML cannot hold.
pub fn text(script: &Script) -> Result<String> {
    let usual = Table::try_from(PLAIN.parse::<Script>()?)?;
    let usual_touch = usual.get("touch").and_then(|touches| touches.get(0)).and_then(Value::as_table);
    let shorten = |table: &mut Table, usual: &Table| {
        table.retain(|key, value| SAID.contains(&key) || usual.get(key) != Some(value));
    };
    let mut all = Table::try_from(script)?;
    shorten(&mut all, &usual);
    for key in ["touch", "trace"] {
        let touches = all.get_mut(key).and_then(Value::as_array_mut).into_iter().flatten();
        for (touch, usual) in touches.filter_map(Value::as_table_mut).zip(usual_touch.into_iter().cycle()) {
            shorten(touch, usual);
        }
    }
    all.retain(|_, value| value.as_array().is_none_or(|items| !items.is_empty()));
    Ok(toml::to_string(&all)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str) -> String {
        let message = parse(text, "x.toml").unwrap_err().to_string();
        assert!(!message.contains('\n'), "{message}");
        message
    }

    const TOUCH: &str = "duration_s = 1\n[[touch]]\npanel = \"back\"\nshape = \"palm\"\nforce_n = 8\nat = [8, 16]\nstart_s = 0.2\n";

    #[test]
    fn a_script_is_written_in_a_few_words_and_read_again() {
        let trace = "[[trace]]\npanel = \"back\"\nshape = \"palm\"\npath = [[0.2, 7.5, 11.0, 0.0], [0.216, 7.5, 11.0, 8.0]]\n";
        let script = parse(&format!("{TOUCH}{trace}"), "").unwrap();
        let written = text(&script).unwrap();
        assert_eq!(written.lines().count(), 13, "{written}");
        assert_eq!(written.lines().next(), Some("duration_s = 1.0"));
        assert!(written.contains("path = [[0.2, 7.5, 11.0, 0.0], [0.216, 7.5, 11.0, 8.0]]"), "{written}");
        for name in sim::names() {
            let script = load(name).unwrap();
            let again = parse(&text(&script).unwrap(), "").unwrap();
            assert_eq!(Script { folder: script.folder.clone(), ..again }, script);
        }
    }

    #[test]
    fn a_script_without_a_name_is_named_after_its_file() {
        assert_eq!(parse(TOUCH, "some/where.toml").unwrap().name, "where");
        let wrong = error(&format!("{TOUCH}hold_s = -1\n"));
        assert_eq!(wrong, "in x.toml: touch 1: `hold_s` is -1, it must be 0 to 86400");
    }

    #[test]
    fn paths_in_a_script_are_relative_to_its_folder() {
        let folder = std::env::temp_dir().join(format!("taxel-scripts-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("own")).unwrap();
        let mine = Garment { name: taxel_core::format::name("mine"), ..Garment::block() };
        std::fs::write(folder.join("own/mine.toml"), garments::text(&mine, "").unwrap()).unwrap();
        let path = folder.join("touch.toml");
        std::fs::write(&path, "duration_s = 1\ngarment = \"own/mine.toml\"\n").unwrap();
        let script = load(path.to_str().unwrap()).unwrap();
        assert_eq!(garment(&script).unwrap(), mine);
        let absolute = Script { garment: folder.join("own/mine.toml").display().to_string(), ..script };
        assert_eq!(garment(&absolute).unwrap(), mine);
        std::fs::remove_dir_all(folder).unwrap();
        assert_eq!(garment(&load("pat").unwrap()).unwrap(), Garment::reference());
    }

    #[test]
    fn errors_name_file_line_and_key() {
        assert_eq!(error("seed = 2\n"), "x.toml, line 1: `duration_s` is missing");
        let unknown = error("duration_s = 1\ncolour = 3\n");
        assert!(unknown.starts_with("x.toml, line 2: `colour` is not a known key: `name`"), "{unknown}");
        let wrong = error("duration_s = 1\nseed = \"a\"\n");
        assert_eq!(wrong, "x.toml, line 2, `seed`: must be a whole number of 0 or more, not \"a\"");
        let size = error(&format!("{TOUCH}size_mm = \"large\"\n"));
        assert_eq!(size, "x.toml, line 8, `size_mm`: must be a number or [length, width]");
        assert!(error("duration_s = = 1").starts_with("x.toml, line 1"));
    }

    #[test]
    fn names_that_do_not_exist_are_answered_with_those_that_do() {
        let error = load("tickle").unwrap_err().to_string();
        assert!(
            error.starts_with("there is no script of touches \"tickle\"; known are pat, lash, "),
            "{error}"
        );
        let error = format!("{:#}", load("no/such.toml").unwrap_err());
        assert!(error.starts_with("no/such.toml cannot be read: "), "{error}");
        let script = Script { garment: "shirt".into(), ..load("pat").unwrap() };
        let error = format!("{:#}", garment(&script).unwrap_err());
        assert!(
            error.starts_with(
                "in script pat: `garment`: there is no garment \"shirt\"; known are reference, "
            )
        );
    }
}
