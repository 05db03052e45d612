//! Tables that have one row for each time, with the coordinates of several balls side by side.

use crate::heading::{self, Heading};

/// What may stand between a coordinate and the name of a ball.
const SEPARATORS: [char; 5] = ['_', '.', '-', ' ', '#'];

/// A column with a coordinate of one ball.
#[derive(Debug, Clone, PartialEq)]
struct Part {
    /// Index of the column.
    place: usize,
    /// Number or name of the ball.
    ball: String,
    /// Coordinate, as `x` or `vx`.
    key: &'static str,
}

/// The columns of one ball.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Ball {
    /// Number or name.
    pub name: String,
    /// Coordinate of each column of the heading that belongs to the ball.
    pub keys: Vec<(usize, &'static str)>,
}

/// Finds the balls of a heading such as `t, x1, y1, x2, y2` or `t, red_x, red_y`, in the order of
/// their columns; none if no column names a ball. `coordinates` lists each key with its names.
///
/// # Errors
/// The column that is there twice, or whose ball lacks a coordinate that it needs.
pub(crate) fn balls(
    heading: &csv::StringRecord,
    coordinates: &[(&'static str, &'static [&'static str])],
) -> Result<Vec<Ball>, String> {
    let mut found: Vec<Ball> = Vec::new();
    for (place, text) in heading.iter().enumerate() {
        let Some(part) = part(place, &Heading::of(text).name, coordinates) else { continue };
        let Part { ball: name, key, .. } = part;
        match found.iter_mut().find(|it| it.name == name) {
            Some(ball) if ball.keys.iter().any(|it| it.1 == key) => {
                return Err(format!("the column \"{text}\" is there twice: {key} of ball {name}"));
            }
            Some(ball) => ball.keys.push((place, key)),
            None => found.push(Ball { name, keys: vec![(place, key)] }),
        }
    }
    let has = |ball: &Ball, key: &str| ball.keys.iter().any(|it| it.1 == key);
    for ball in &found {
        for (key, _) in coordinates {
            let is_needed = ["x", "y"].contains(key) || found.iter().any(|it| has(it, key));
            if is_needed && !has(ball, key) {
                let own = ball.keys.first().and_then(|it| heading.get(it.0)).unwrap_or_default();
                let name = &ball.name;
                return Err(format!("ball {name} has a column \"{own}\", but none for its {key}"));
            }
        }
    }
    Ok(found)
}

/// Takes `x1`, `x_red`, `ball 2 x` or `red.vx` apart.
fn part(
    place: usize,
    name: &str,
    coordinates: &[(&'static str, &'static [&'static str])],
) -> Option<Part> {
    let names =
        || coordinates.iter().flat_map(|(key, names)| names.iter().map(move |it| (*key, *it)));
    // Without a ball, it is a coordinate: `pos_x` is x, not that of a ball `pos`.
    if names().any(|it| it.1 == name) {
        return None;
    }
    let ball = |of: &str| {
        let before = name.strip_suffix(of).filter(|it| it.ends_with(SEPARATORS));
        let after = name.strip_prefix(of).filter(|it| {
            it.starts_with(SEPARATORS) || it.bytes().all(|byte| byte.is_ascii_digit())
        });
        let ball = before.or(after)?.trim_matches(SEPARATORS);
        // In `x_cm`, it is the unit.
        let is_ball = !ball.is_empty() && heading::length(ball).is_none();
        is_ball.then(|| ball.to_owned())
    };
    // The longest name counts: `red_pos_x` is x of `red`.
    let found = names().filter_map(|(key, of)| Some((of.len(), key, ball(of)?)));
    let (_, key, ball) = found.max_by_key(|it| it.0)?;
    Some(Part { place, ball, key })
}

#[cfg(test)]
mod tests {
    use super::*;

    const COORDINATES: [(&str, &[&str]); 4] =
        [("x", &["x", "pos_x"]), ("y", &["y", "pos_y"]), ("z", &["z", "pos_z"]), ("vx", &["vx"])];

    #[test]
    fn a_coordinate_and_the_name_of_its_ball_are_taken_apart() {
        for (name, expected) in [
            ("x1", Some(("1", "x"))),
            ("y_12", Some(("12", "y"))),
            ("z red", Some(("red", "z"))),
            ("ball 2 x", Some(("ball 2", "x"))),
            ("red_pos_x", Some(("red", "x"))),
            ("pos_y3", Some(("3", "y"))),
            ("b.vx", Some(("b", "vx"))),
            ("x", None),
            ("pos_x", None),
            ("x_cm", None),
            ("x_", None),
            ("xray", None),
            ("max", None),
            ("", None),
        ] {
            let part = part(0, name, &COORDINATES);
            let found = part.as_ref().map(|it| (it.ball.as_str(), it.key));
            assert_eq!(found, expected, "{name}");
        }
    }
}
