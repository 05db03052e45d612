//! Colours as text: `red`, `#c0392b`, `hsl(210 60% 40%)`, as CSS writes them.

use toml::Value;

/// Names of fields that hold a colour: in any table, and in the table `colors`.
const FIELDS: [&str; 1] = ["color"];
const TABLE: &str = "colors";
const FIELDS_OF_TABLE: [&str; 3] = ["background", "spheres", "colliders"];

/// Whether the field of this name in this table holds a colour.
fn is_color(table: Option<&str>, field: &str) -> bool {
    FIELDS.contains(&field) || (table == Some(TABLE) && FIELDS_OF_TABLE.contains(&field))
}

/// Whether fields of this name hold a colour in at least one table.
pub(crate) fn may_be_color(field: &str) -> bool {
    is_color(Some(TABLE), field)
}

/// Parses a colour: red, green and blue in \[0, 1\]. Returns `None` if this field of this table
/// holds no colour.
///
/// # Errors
/// A description of what is wrong with the text.
pub(crate) fn numbers_of(
    table: Option<&str>,
    field: &str,
    text: &str,
) -> Option<Result<Value, String>> {
    if !is_color(table, field) {
        return None;
    }
    // The parser also accepts hexadecimal digits without `#`: it would read 100 as a dark green.
    let is_marked = !text.chars().all(|it| it.is_ascii_hexdigit());
    let color = csscolorparser::parse(text).ok().filter(|color| color.a == 1.0 && is_marked);
    let numbers = color.map(|color| {
        let [red, green, blue, _] = color.to_rgba8();
        [red, green, blue].map(|part| Value::Float(f64::from(part) / 255.0))
    });
    let expected = "three numbers from 0 to 1, a name like \"red\", or \"#c0392b\"";
    let wrong = || format!("\"{text}\" is no colour: write {expected}");
    Some(numbers.map(|parts| Value::Array(parts.to_vec())).ok_or_else(wrong))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_hexadecimal_digits_are_colours_and_other_texts_are_not() {
        let parts = |text: &str| {
            let Some(Ok(Value::Array(parts))) = numbers_of(None, "color", text) else {
                panic!("{text}")
            };
            parts.iter().filter_map(Value::as_float).map(|it| (255.0 * it).round()).collect()
        };
        let read: [Vec<f64>; 4] = ["red", "SteelBlue", "#c0392b", "hsl(120 100% 50%)"].map(parts);
        let expected = [[255., 0., 0.], [70., 130., 180.], [192., 57., 43.], [0., 255., 0.]];
        assert_eq!(read, expected.map(Vec::from));
        for text in ["reddish", "", "#12", "100", "c0392b", "rgb(0 0 0 / 50%)"] {
            let error = numbers_of(None, "color", text).unwrap().unwrap_err();
            assert!(error.starts_with(&format!("\"{text}\" is no colour")), "{error}");
        }
        assert_eq!(numbers_of(None, "name", "red"), None);
        assert_eq!(numbers_of(None, "spheres", "red"), None);
        assert!(numbers_of(Some("colors"), "spheres", "red").unwrap().is_ok());
    }
}
