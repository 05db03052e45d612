//! The rule of a link, short for an override.

use carom_scene::Override;
use carom_scene::scene::Rule;

use super::error::{LinkError, quoted};

/// What an override that changes the rule begins with.
const RULE_PATH: &str = "simulation.rule=";

/// What `rule=` stands for.
pub fn rule_override(rule: &str) -> Result<Override, LinkError> {
    if !Rule::NAMES.contains(&rule) {
        return Err(LinkError::Rule { found: quoted(rule) });
    }
    Ok(format!("{RULE_PATH}{rule}").parse()?)
}

/// The rule that an override sets, if that is what it does in so many words.
pub fn rule_of_override(text: &str) -> Option<&str> {
    text.strip_prefix(RULE_PATH).filter(|rule| Rule::NAMES.contains(rule))
}
