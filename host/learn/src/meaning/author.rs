//! Folders of scripts with their rules.

use super::rule::Rule;
use anyhow::{Context, Result, ensure};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use taxel::files::scripts;
use taxel::sim::Script;

/// File of the rules in an author's folder.
const RULES: &str = "rules.json";

/// A script and its rule.
#[derive(Debug, Clone)]
pub struct JudgedScript {
    /// The script.
    pub script: Script,
    /// Rule of a person for it.
    pub rule: Rule,
}

/// An author's scripts, by their file names.
#[derive(Debug, Clone)]
pub struct Author {
    /// Name of the folder.
    pub name: String,
    /// The scripts.
    pub scripts: Vec<JudgedScript>,
}

impl Author {
    /// Reads a folder. Errors name the file.
    pub fn read(folder: &Path) -> Result<Author> {
        let place = folder.join(RULES);
        let text = fs::read_to_string(&place).with_context(|| place.display().to_string())?;
        let rules: BTreeMap<String, Rule> =
            serde_json::from_str(&text).with_context(|| place.display().to_string())?;
        ensure!(!rules.is_empty(), "{}: there are no rules", place.display());
        let read = |(file, rule): (String, Rule)| {
            ensure!((0.0..=1.0).contains(&rule.sure), "{}: {file}: sure is {}", place.display(), rule.sure);
            let script = scripts::load(&folder.join(&file).display().to_string())?;
            Ok(JudgedScript { script, rule })
        };
        let scripts = rules.into_iter().map(read).collect::<Result<_>>()?;
        let name = folder.file_name().unwrap_or(folder.as_os_str()).display().to_string();
        Ok(Author { name, scripts })
    }
}
