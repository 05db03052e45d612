//! The rules in a link: `rule`, a short form of an override, and `beside`.

use carom_scene::Override;
use carom_scene::scene::Rule;

use super::error::{LinkError, quoted};

/// Start of an override that sets the rule.
const RULE_PATH: &str = "simulation.rule=";

/// Override for which `rule=` stands.
pub fn rule_override(rule: &str) -> Result<Override, LinkError> {
    let rule = named_rule("rule", rule)?.name();
    Ok(format!("{RULE_PATH}{rule}").parse()?)
}

/// Rule with this name in a part of a link.
pub fn named_rule(part: &'static str, name: &str) -> Result<Rule, LinkError> {
    let rules = [Rule::Exact, Rule::Contact, Rule::Bisect, Rule::Discrete];
    let found = rules.into_iter().find(|rule| rule.name() == name);
    found.ok_or_else(|| LinkError::Rule { part, found: quoted(name) })
}

/// Rule that an override sets, if it sets nothing else.
pub fn rule_of_override(text: &str) -> Option<&str> {
    text.strip_prefix(RULE_PATH).filter(|rule| Rule::NAMES.contains(rule))
}
