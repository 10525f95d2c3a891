//! How a check ends.

/// Result of a check; an outer error means that it cannot run, and why.
pub type End<T = ()> = Result<Result<T, String>, String>;

/// Prints the lines of a check that are for people.
pub fn shown(end: Result<Vec<String>, String>) -> End {
    Ok(end.map(|lines| lines.iter().filter(|line| !line.is_empty()).for_each(|line| println!("  {line}"))))
}
