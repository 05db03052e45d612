//! The part `rule` of a link, a short form of an override.

use carom_scene::Override;
use carom_scene::scene::Rule;

use super::error::{LinkError, quoted};

/// Start of an override that sets the rule.
const RULE_PATH: &str = "simulation.rule=";

/// Override for which `rule=` stands.
pub fn rule_override(rule: &str) -> Result<Override, LinkError> {
    if !Rule::NAMES.contains(&rule) {
        return Err(LinkError::Rule { found: quoted(rule) });
    }
    Ok(format!("{RULE_PATH}{rule}").parse()?)
}

/// Rule that an override sets, if it sets nothing else.
pub fn rule_of_override(text: &str) -> Option<&str> {
    text.strip_prefix(RULE_PATH).filter(|rule| Rule::NAMES.contains(rule))
}
