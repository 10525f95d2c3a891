//! Judgement of a touch by a person, as a rule for what may be announced.

use serde::Deserialize;
use std::fmt;
use taxel_core::intent::Leading;

/// A rule for one script.
#[derive(Debug, Default, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Rule {
    /// Word of a person.
    pub say: String,
    /// Words of which one is said at least once.
    pub must: Vec<Leading>,
    /// Words that are not said.
    pub never: Vec<Leading>,
    /// If there are any: no others are said.
    pub only: Vec<Leading>,
    /// If there are any: the last word is one of them; `none` stands for no word at all.
    pub last: Vec<Leading>,
    /// Nothing is said.
    pub nothing: bool,
    /// A contact is felt.
    pub felt: bool,
    /// How sure a person is, 0 ..= 1.
    pub sure: f64,
}

/// Part of a rule that does not hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wrong {
    /// Something was said, and nothing should be.
    Nothing,
    /// A word was said that is none of the only ones.
    Only,
    /// A word was said that never should be.
    Never,
    /// No word was said of which one must be.
    Must,
    /// The last word is another.
    Last,
    /// Nothing was felt.
    Felt,
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Wrong::Nothing => "nothing",
            Wrong::Only => "only",
            Wrong::Never => "never",
            Wrong::Must => "must",
            Wrong::Last => "last",
            Wrong::Felt => "felt",
        })
    }
}

impl Rule {
    /// The parts that do not hold, if these words were announced in this order, and if a contact was felt.
    pub fn wrong(&self, said: impl IntoIterator<Item = Leading>, felt: bool) -> Vec<Wrong> {
        let words: Vec<Leading> = said.into_iter().filter(|word| *word != Leading::None).collect();
        let any = |of: &[Leading]| words.iter().any(|word| of.contains(word));
        let last = words.last().copied().unwrap_or_default();
        let parts = [
            (self.nothing && !words.is_empty(), Wrong::Nothing),
            (!self.only.is_empty() && words.iter().any(|word| !self.only.contains(word)), Wrong::Only),
            (any(&self.never), Wrong::Never),
            (!self.must.is_empty() && !any(&self.must), Wrong::Must),
            (!self.last.is_empty() && !self.last.contains(&last), Wrong::Last),
            (self.felt && !felt, Wrong::Felt),
        ];
        parts.into_iter().filter(|(holds, _)| *holds).map(|(_, part)| part).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rule_names_each_part_that_does_not_hold() {
        use Leading::{Attack, Kindness, None, Threat};
        let rule = |text: &str| serde_json::from_str::<Rule>(text).unwrap();
        let slap = rule(r#"{"must": ["attack"], "never": ["threat"], "last": ["kindness", "none"]}"#);
        assert_eq!(slap.wrong([Attack, None, Kindness, None], true), []);
        assert_eq!(slap.wrong([Threat, None], true), [Wrong::Never, Wrong::Must, Wrong::Last]);
        assert_eq!(slap.wrong([], true), [Wrong::Must]);
        let hug = rule(r#"{"only": ["kindness"], "felt": true, "sure": 0.9}"#);
        assert_eq!(
            (hug.wrong([None], true), hug.wrong([Attack], false)),
            (vec![], vec![Wrong::Only, Wrong::Felt])
        );
        assert_eq!(rule(r#"{"nothing": true}"#).wrong([Kindness], true), [Wrong::Nothing]);
        assert!(serde_json::from_str::<Rule>(r#"{"neven": []}"#).is_err());
    }
}
