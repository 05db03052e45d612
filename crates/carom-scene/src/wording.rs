//! Rewrites messages of the TOML deserializer, which speaks of Rust types, for authors of scenes.

use crate::error::nearest;

/// Message for an empty table that must contain one entry.
pub(crate) const SAYS_NOTHING: &str = "is empty: it must have exactly one entry";

/// Common words with the name that scene files use.
const SYNONYMS: [(&str, &str); 34] = [
    ("angle", "degrees"),
    ("ball", "sphere"),
    ("balls", "spheres"),
    ("bounce", "restitution"),
    ("bounciness", "restitution"),
    ("box", "shape"),
    ("colour", "color"),
    ("cube", "box"),
    ("cuboid", "box"),
    ("elasticity", "restitution"),
    ("floor", "half-space"),
    ("gravity", "forces"),
    ("ground", "half-space"),
    ("halfspace", "half-space"),
    ("m", "mass"),
    ("mirror", "metal"),
    ("mu", "friction"),
    ("obstacles", "colliders"),
    ("omega", "angular_velocity"),
    ("planes", "colliders"),
    ("plane", "half-space"),
    ("quad", "rectangle"),
    ("r", "radius"),
    ("shiny", "glossy"),
    ("size", "radius"),
    ("speed", "velocity"),
    ("spin", "angular_velocity"),
    ("steel", "metal"),
    ("transparent", "glass"),
    ("type", "shape"),
    ("vel", "velocity"),
    ("wall", "half-space"),
    ("walls", "colliders"),
    ("weight", "mass"),
];

/// Message about a table with several entries of which one is possible.
const SAYS_SEVERAL: &str = "has several entries: it must have exactly one entry";

/// Hint for authors whose language writes decimals with a comma.
pub(crate) const DECIMAL_POINT: &str = "decimals have a point, not a comma";

/// Tables for which authors may write a number or a list, with an example of each.
const TABLES: [(&str, &str); 20] = [
    ("bowl", "{ radius = 1.0 }"),
    ("box", "{ size = [1.0, 1.0, 1.0] }"),
    ("camera", "[camera]"),
    ("capsule", "{ radius = 0.5, length = 1.0 }"),
    ("colors", "[colors]"),
    ("cone", "{ bottom_radius = 0.5, height = 1.0 }"),
    ("constant", "{ force = [0.0, -1.0, 0.0] }"),
    ("container", "{ size = [1.0, 1.0, 1.0] }"),
    ("cylinder", "{ radius = 0.5, height = 1.0 }"),
    ("disc", "{ radius = 0.5 }"),
    ("funnel", "{ bottom_radius = 0.1, top_radius = 0.5, height = 1.0 }"),
    ("gravity", "{ acceleration = [0.0, -9.81, 0.0] }"),
    ("pipe", "{ radius = 0.5, length = 1.0 }"),
    ("rectangle", "{ size_x = 2.0, size_z = 2.0 }"),
    ("simulation", "[simulation]"),
    ("sphere", "{ radius = 0.5 }"),
    ("sun", "[sun]"),
    ("torus", "{ ring_radius = 1.0, tube_radius = 0.2 }"),
    ("track", "{ radius = 0.05, pieces = [{ straight = { length = 1.0 } }] }"),
    ("viscous-drag", "{ coefficient = 0.1 }"),
];

/// Recognizes a list or a number in the place of a table; returns the path of the table and an
/// example. The deserializer would read a list as the fields of the table in order.
pub(crate) fn table_expected(path: &str, message: &str) -> Option<(String, String)> {
    let of_list = path.strip_suffix(']').and_then(|path| path.rsplit_once('['));
    let path = match of_list {
        Some((path, _)) => path,
        None if message.ends_with("expected a table") => path,
        None => return None,
    };
    let name = path.rsplit('.').next().unwrap_or_default();
    let (_, table) = TABLES.iter().find(|(table, _)| *table == name)?;
    Some((path.to_owned(), format!("is a table: {table}")))
}

/// Adds an example to a message about a table that must contain one entry.
pub(crate) fn with_form(message: String, path: &str) -> String {
    let form = match path.split('[').next() {
        _ if !message.ends_with("it must have exactly one entry") => return message,
        Some("forces") => "gravity = { acceleration = [0.0, -9.81, 0.0] }",
        Some("generators") => "[generators.row] with its fields below",
        Some("colliders") => "shape = { box = { size = [1.0, 1.0, 1.0] } }",
        _ => return message,
    };
    format!("{message}, like {form}")
}

/// Rewrites a message of the deserializer in plain words.
pub(crate) fn in_plain_words(message: &str) -> String {
    let message = message.lines().next().unwrap_or_default();
    if let Some((count, expected)) =
        message.strip_prefix("invalid length ").and_then(|rest| rest.split_once(", expected "))
    {
        return match expected.strip_prefix("an array of length ") {
            Some(wanted) => format!("has {count} values, not {wanted}"),
            None if expected.ends_with(" in map") => SAYS_SEVERAL.to_owned(),
            None if may_have_commas(count) => {
                format!("{count} values are too many; {DECIMAL_POINT}")
            }
            None => format!("{count} values are too many"),
        };
    }
    if message == "invalid type: map, expected a sequence" {
        return "is one table, not a list: a list has double brackets, like [[spheres]]".to_owned();
    }
    if message.starts_with("wanted exactly 1 element, found 0") {
        return SAYS_NOTHING.to_owned();
    }
    if message.starts_with("wanted exactly 1 element") {
        return SAYS_SEVERAL.to_owned();
    }
    let Some((found, expected)) = message.split_once(", expected ") else {
        return message.to_owned();
    };
    let found = match found {
        "invalid type: map" => "invalid type: a table",
        "invalid type: sequence" => "invalid type: an array",
        other => other,
    };
    format!("{found}, expected {}", name_of_type(expected))
}

/// Returns whether too many values may be three or four that have decimal commas, of a vector or a rotation.
fn may_have_commas(count: &str) -> bool {
    count.parse().is_ok_and(|count: u64| (4..=8).contains(&count))
}

/// Returns the first line of a message; without the list of valid names if one of them is
/// suggested.
pub(crate) fn without_list(message: &str, is_meant: bool) -> &str {
    let line = message.lines().next().unwrap_or_default();
    match line.split_once(", expected one of ") {
        Some((unknown, _)) if is_meant => unknown,
        _ => line,
    }
}

/// Returns what the author probably meant by a value at `place` that is no TOML.
pub(crate) fn slip_of_syntax(text: &str, place: usize, message: &str) -> Option<String> {
    let line_start = text.get(..place)?.rfind('\n').map_or(0, |end| end + 1);
    let line = text.get(line_start..)?.lines().next()?;
    let (before, _) = line.split_at_checked(place - line_start)?;
    let is_digit = |it: char| it.is_ascii_digit();
    let has_comma = |value: &str| {
        let number = value.trim_start().trim_start_matches(['+', '-']);
        let rest = number.trim_start_matches(is_digit);
        rest.len() < number.len()
            && rest.strip_prefix(',').is_some_and(|it| it.starts_with(is_digit))
    };
    if line.split('=').skip(1).any(has_comma) {
        return Some(DECIMAL_POINT.to_owned());
    }
    // The value around `place`, which may be an element of a list.
    let start = before.rfind(['=', '[', ',', '{']).map_or(0, |end| end + 1);
    let value = line[start..].split([',', ']', '}', '#']).next()?.trim();
    let is_number = value.starts_with(|it: char| is_digit(it) || "+-.".contains(it));
    if is_number && value.ends_with(char::is_alphabetic) {
        return Some(format!("`{value}` is no number; one with a unit has quotes: \"{value}\""));
    }
    if ["True", "False"].contains(&value) {
        return Some(format!("`{value}` is written small: {}", value.to_lowercase()));
    }
    let mut parts = value.split_whitespace();
    if let (Some(first), Some(second)) = (parts.next(), parts.next())
        && [first, second].iter().all(|it| it.parse::<f64>().is_ok())
    {
        return Some(format!("between `{first}` and `{second}` there is no comma"));
    }
    let is_word = value.starts_with(char::is_alphabetic) && !value.contains(['"', '\'']);
    (message.contains("must be quoted") && is_word)
        .then(|| format!("a text stands in quotes: \"{value}\""))
}

/// Formats names for a message in the form that [`suggestion`] reads.
pub(crate) fn quoted<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<_> = names.into_iter().map(|name| format!("`{name}`")).collect();
    names.join(", ")
}

/// Adds names to a message about an unknown field of the scene itself; returns other messages
/// unchanged.
pub(crate) fn with_names<'a>(
    message: String,
    field: &str,
    names: impl IntoIterator<Item = &'a str>,
) -> String {
    let is_of_scene = !field.contains(['.', '[']);
    let names = quoted(names);
    if message.starts_with("unknown field ") && is_of_scene && !names.is_empty() {
        return format!("{message}, {names}");
    }
    message
}

/// Name of a Rust type for authors of scenes.
fn name_of_type(expected: &str) -> &str {
    match expected {
        "f32" | "f64" => "a number",
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number from 0 on",
        "i32" | "i64" => "a whole number",
        "a sequence" => "a list",
        "a map" => "a table",
        _ if expected.starts_with("struct ") => "a table",
        _ if expected.starts_with("an array of length 3") => "an array of 3 numbers",
        _ if expected.starts_with("an array of length 4") => "an array of 4 numbers",
        other => other,
    }
}

/// Returns the expected name that is probably meant in "unknown field `x`, expected one of `y`,
/// `z`".
pub(crate) fn suggestion(message: &str) -> Option<String> {
    if !message.starts_with("unknown ") {
        return None;
    }
    let mut quoted = message.split('`').skip(1).step_by(2);
    let name = quoted.next()?;
    let known: Vec<&str> = quoted.collect();
    let synonym = SYNONYMS.iter().find(|(word, _)| *word == name.to_lowercase());
    match synonym.filter(|(_, meant)| known.contains(meant)) {
        Some((_, meant)) => Some((*meant).to_owned()),
        None => nearest(name, known),
    }
}
