//! Demangles names of functions and variables.

/// Path of a symbol without its hash; other symbols are returned unchanged.
pub fn path(symbol: &str) -> String {
    let Some(parts) = components(symbol) else { return symbol.to_string() };
    let parts: Vec<String> = parts.iter().filter(|part| !is_hash(part)).map(|part| plain(part)).collect();
    parts.join("::")
}

/// Crate of a symbol; none for symbols of the compiler, the linker or C.
pub fn of_crate(symbol: &str) -> Option<String> {
    if let Some(newer) = symbol.strip_prefix("_R") {
        // Root of the path: "Cs", a hash, "_", the length and the name.
        let (_, rest) = newer.split_once("Cs")?.1.split_once('_')?;
        return Some(counted(rest)?.0.to_string());
    }
    let path = path(symbol);
    let (first, _) = path.split_once("::")?;
    // "<&T as core": a trait that is implemented for all types is attributed to the trait's crate.
    let of_type = first.trim_start_matches(['<', '&', '[', '(', '*']).trim_start_matches("mut ");
    let owner = of_type
        .split_once(" as ")
        .map_or(of_type, |(of_type, of_trait)| if of_type.len() == 1 { of_trait } else { of_type });
    let owner = owner.trim_start_matches("impl ");
    owner.chars().all(|c| c.is_alphanumeric() || c == '_').then(|| owner.to_string())
}

/// Splits `_ZN`, each part behind its length, `E`.
fn components(symbol: &str) -> Option<Vec<&str>> {
    let mut rest = symbol.strip_prefix("_ZN")?;
    let mut parts = Vec::new();
    while !rest.starts_with('E') {
        let (part, later) = counted(rest)?;
        parts.push(part);
        rest = later;
    }
    Some(parts)
}

/// Splits off a text behind its length.
fn counted(text: &str) -> Option<(&str, &str)> {
    let digits = text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let length: usize = text.get(..digits)?.parse().ok()?;
    Some((text.get(digits..digits + length)?, text.get(digits + length..)?))
}

fn is_hash(part: &str) -> bool {
    part.len() == 17 && part.starts_with('h') && part.chars().skip(1).all(|c| c.is_ascii_hexdigit())
}

/// Replaces escape sequences of characters that a symbol cannot contain.
fn plain(part: &str) -> String {
    const SPELT: [(&str, &str); 12] = [
        ("_$", "$"),
        ("$LT$", "<"),
        ("$GT$", ">"),
        ("$RF$", "&"),
        ("$BP$", "*"),
        ("$C$", ","),
        ("$LP$", "("),
        ("$RP$", ")"),
        ("$u20$", " "),
        ("$u5b$", "["),
        ("$u5d$", "]"),
        ("..", "::"),
    ];
    SPELT.iter().fold(part.to_string(), |text, (spelt, sign)| text.replace(spelt, sign))
}

#[cfg(test)]
mod tests {
    use super::{of_crate, path};

    #[test]
    fn paths_and_their_crates() {
        let of = |symbol: &str| (path(symbol), of_crate(symbol).unwrap_or_default());
        let cases = [
            ("_ZN14taxel_firmware7SCANNER17h16520e55d1a555d6E", "taxel_firmware::SCANNER", "taxel_firmware"),
            (
                "_ZN44_$LT$$RF$T$u20$as$u20$core..fmt..Display$GT$3fmt17h7a4055e9050e4485E",
                "<&T as core::fmt::Display>::fmt",
                "core",
            ),
            (
                "_ZN46_$LT$$RF$mut$u20$postcard..ser..Serializer$GT$3end17h7a4055e9050e4485E",
                "<&mut postcard::ser::Serializer>::end",
                "postcard",
            ),
            ("_RNvNtCseold96UKqg_4core3fmt5write", "_RNvNtCseold96UKqg_4core3fmt5write", "core"),
            ("UART0_IRQ", "UART0_IRQ", ""),
            ("_ZN99short", "_ZN99short", ""),
        ];
        for (symbol, name, owner) in cases {
            assert_eq!(of(symbol), (name.to_string(), owner.to_string()));
        }
    }
}
