//! Names and units of columns, as programs for physics lessons write them.

/// A column's name and unit.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Heading {
    /// Name in lower case, without the name of the run and without the unit.
    pub name: String,
    /// Unit, as it is written.
    pub unit: Option<String>,
}

impl Heading {
    /// Reads `Latest: Time (s)`, `x [cm]`, `t / ms`, `t in s` or `"x"`.
    pub fn of(text: &str) -> Self {
        let text = text.trim().trim_matches('"').trim_start_matches('#').trim();
        // Logger Pro writes the name of the data set before a colon.
        let text = text.rsplit_once(':').map_or(text, |(_, name)| name).trim();
        let brackets = [('(', ')'), ('[', ']')];
        let in_brackets = brackets.into_iter().find_map(|(open, close)| {
            let (name, unit) = text.strip_suffix(close)?.rsplit_once(open)?;
            Some((name, unit))
        });
        let split = in_brackets.or(text.split_once(" / ")).or(text.split_once(" in "));
        match split {
            Some((name, unit)) if !name.trim().is_empty() => {
                let unit = unit.trim().to_owned();
                Self { name: name.trim().to_lowercase(), unit: Some(unit) }
            }
            _ => Self { name: text.to_lowercase(), unit: None },
        }
    }
}

/// Unit of a length \[m\].
pub(crate) fn length(unit: &str) -> Option<f64> {
    Some(match unit.trim().trim_matches(['(', ')', '[', ']']) {
        "m" => 1.0,
        "cm" => 0.01,
        "mm" => 1e-3,
        "km" => 1e3,
        "in" => 0.0254,
        "ft" => 0.3048,
        _ => return None,
    })
}

/// Unit of a time \[s\].
pub(crate) fn time(unit: &str) -> Option<f64> {
    Some(match unit.trim().trim_matches(['(', ')', '[', ']']) {
        "s" | "sec" => 1.0,
        "ms" => 1e-3,
        "min" => 60.0,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_units_are_taken_apart() {
        for (text, name, unit) in [
            ("Latest: Time (s)", "time", Some("s")),
            ("x [cm]", "x", Some("cm")),
            ("t / ms", "t", Some("ms")),
            ("\"y\"", "y", None),
            ("(x)", "(x)", None),
            ("# t", "t", None),
        ] {
            let heading = Heading::of(text);
            assert_eq!((heading.name.as_str(), heading.unit.as_deref()), (name, unit), "{text}");
        }
    }
}
