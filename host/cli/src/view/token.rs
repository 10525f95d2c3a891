//! Token of a page that other machines may open: the first folder of its address.

use std::hash::{BuildHasher, RandomState};

/// A secret of 128 bits.
#[derive(Debug, Clone)]
pub struct Token(String);

impl Token {
    /// A token that nobody can guess: two values of a keyed hash, whose key is the system's random numbers.
    pub fn random() -> Token {
        let keyed = RandomState::new();
        Token(format!("{:016x}{:016x}", keyed.hash_one(0u8), keyed.hash_one(1u8)))
    }

    /// The token as text.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Path behind the token; none if the path does not begin with it. It takes the same time wherever they differ.
    pub fn behind<'a>(&self, path: &'a str) -> Option<&'a str> {
        let (folder, rest) = path.strip_prefix('/')?.split_at_checked(self.0.len())?;
        let apart = folder.bytes().zip(self.0.bytes()).fold(0, |apart, (one, other)| apart | (one ^ other));
        (apart == 0 && rest.starts_with('/')).then_some(rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_whole_token_leads_behind_it() {
        let token = Token::random();
        let text = token.as_str();
        assert!(text.len() == 32 && text != Token::random().as_str(), "{text}");
        assert_eq!(token.behind(&format!("/{text}/socket")), Some("/socket"));
        assert_eq!(token.behind(&format!("/{text}/")), Some("/"));
        let other = text.replace(&text[31..], if text.ends_with('0') { "1" } else { "0" });
        for path in [
            "/".into(),
            "/socket".into(),
            "".into(),
            format!("/{text}"),
            format!("/{text}x/"),
            format!("/{}/", &text[1..]),
            format!("/{other}/"),
            format!("//{text}/"),
        ] {
            assert_eq!(token.behind(&path), None, "{path}");
        }
    }
}
