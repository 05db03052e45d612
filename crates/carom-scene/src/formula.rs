//! Formulas: arithmetic with numbers and names, as in `2 * r + sin(pi / 6)`.
//!
//! Functions are those of `libm`, so that a formula has the same bits on every machine.

use winnow::ModalResult;
use winnow::ascii::{float, multispace0};
use winnow::combinator::{
    Infix, Prefix, alt, cut_err, delimited, dispatch, expression, fail, preceded, separated,
    terminated,
};
use winnow::prelude::*;
use winnow::stream::Stateful;
use winnow::token::{any, take_while};

/// Most characters of a formula: parentheses in parentheses must not take the whole stack.
const LONGEST: usize = 200;

/// A function of one number, by name.
type OfOne = (&'static str, fn(f64) -> f64);
/// A function of two numbers, by name.
type OfTwo = (&'static str, fn(f64, f64) -> f64);

const OF_ONE: [OfOne; 14] = [
    ("abs", f64::abs),
    ("acos", libm::acos),
    ("asin", libm::asin),
    ("atan", libm::atan),
    ("cbrt", libm::cbrt),
    ("ceil", f64::ceil),
    ("cos", libm::cos),
    ("exp", libm::exp),
    ("floor", f64::floor),
    ("log", libm::log),
    ("round", f64::round),
    ("sin", libm::sin),
    ("sqrt", f64::sqrt),
    ("tan", libm::tan),
];
const OF_TWO: [OfTwo; 3] = [("atan2", libm::atan2), ("max", f64::max), ("min", f64::min)];
const CONSTANTS: [(&str, f64); 2] = [("pi", std::f64::consts::PI), ("tau", std::f64::consts::TAU)];

/// Numbers by name.
pub(crate) type Names = [(String, f64)];

/// The text of a formula, and the names that it may use.
type Input<'a> = Stateful<&'a str, State<'a>>;

#[derive(Debug, Clone, Copy)]
struct State<'a> {
    known: &'a Names,
    /// The name that is none, once one was met.
    unknown: Option<&'a str>,
}

/// Whether a formula has a meaning of its own for this name.
pub(crate) fn is_taken(name: &str) -> bool {
    of_formulas().any(|own| own == name)
}

fn of_formulas<'a>() -> impl Iterator<Item = &'a str> {
    let functions = OF_ONE.iter().map(|it| it.0).chain(OF_TWO.iter().map(|it| it.0));
    functions.chain(CONSTANTS.iter().map(|it| it.0))
}

/// Whether this is a name: letters, digits and `_`, no digit first.
pub(crate) fn is_name(text: &str) -> bool {
    let is_letter = |it: char| it.is_ascii_alphabetic() || it == '_';
    text.starts_with(is_letter) && text.chars().all(|it| is_letter(it) || it.is_ascii_digit())
}

/// The value of a formula.
///
/// Operators are `+ - * /` and `^`, which binds closest and from the right: `-2^2` is -4. Angles are in
/// radians.
///
/// # Errors
/// What is wrong with it: a place that cannot be read, a name that is none, a value that is no number.
pub(crate) fn evaluate(text: &str, known: &Names) -> Result<f64, String> {
    if text.len() > LONGEST {
        return Err(format!("a formula has {LONGEST} characters at most"));
    }
    let mut input = Input { input: text, state: State { known, unknown: None } };
    let value = terminated(sum, multispace0).parse_next(&mut input);
    if let Some(name) = input.state.unknown {
        let names = known.iter().map(|it| it.0.as_str()).chain(of_formulas());
        let names: Vec<_> = names.map(|name| format!("`{name}`")).collect();
        return Err(format!("unknown name `{name}`, expected one of {}", names.join(", ")));
    }
    match value {
        Ok(value) if input.input.is_empty() && value.is_finite() => Ok(value),
        Ok(value) if input.input.is_empty() => Err(format!("\"{text}\" is {value}, no number")),
        _ => Err(unreadable(text, input.input)),
    }
}

fn unreadable(text: &str, rest: &str) -> String {
    match rest.trim() {
        "" => format!("the formula \"{text}\" ends too early"),
        rest => format!("the formula \"{text}\" cannot be read from \"{rest}\" on"),
    }
}

/// Numbers with operators between them, as closely as these bind.
fn sum(input: &mut Input) -> ModalResult<f64> {
    expression(preceded(multispace0, operand))
        .prefix(preceded(
            multispace0,
            dispatch! {any;
                '-' => Prefix(3, |_: &mut _, value: f64| Ok(-value)),
                '+' => Prefix(3, |_: &mut _, value: f64| Ok(value)),
                _ => fail,
            },
        ))
        .infix(preceded(
            multispace0,
            dispatch! {any;
                '+' => Infix::Left(1, |_: &mut _, a: f64, b: f64| Ok(a + b)),
                '-' => Infix::Left(1, |_: &mut _, a: f64, b: f64| Ok(a - b)),
                '*' => Infix::Left(2, |_: &mut _, a: f64, b: f64| Ok(a * b)),
                '/' => Infix::Left(2, |_: &mut _, a: f64, b: f64| Ok(a / b)),
                '^' => Infix::Right(4, |_: &mut _, a: f64, b: f64| Ok(libm::pow(a, b))),
                _ => fail,
            },
        ))
        .parse_next(input)
}

/// A number, a name, a function of something, or something in parentheses.
fn operand(input: &mut Input) -> ModalResult<f64> {
    alt((in_parentheses, named, number)).parse_next(input)
}

/// Digits first: `inf` and `nan` are no numbers here, and a sign is an operator.
fn number(input: &mut Input) -> ModalResult<f64> {
    let starts = input.input.starts_with(|it: char| it.is_ascii_digit() || it == '.');
    if starts { float.parse_next(input) } else { fail.parse_next(input) }
}

fn in_parentheses(input: &mut Input) -> ModalResult<f64> {
    delimited('(', cut_err(sum), cut_err((multispace0, ')'))).parse_next(input)
}

/// The value of a name, or of a function.
fn named(input: &mut Input) -> ModalResult<f64> {
    let name: &str = take_while(1.., |it: char| it.is_ascii_alphanumeric() || it == '_')
        .verify(is_name)
        .parse_next(input)?;
    let one = OF_ONE.iter().find(|it| it.0 == name);
    let two = OF_TWO.iter().find(|it| it.0 == name);
    if one.is_some() || two.is_some() {
        let values = separated(1..=2, sum, (multispace0, ','));
        let values: Vec<f64> =
            cut_err(delimited((multispace0, '('), values, (multispace0, ')'))).parse_next(input)?;
        return match (one, two, &values[..]) {
            (Some((_, function)), _, [value]) => Ok(function(*value)),
            (_, Some((_, function)), [first, second]) => Ok(function(*first, *second)),
            _ => cut_err(fail).parse_next(input),
        };
    }
    let constants = CONSTANTS.iter().copied();
    let known = input.state.known.iter().map(|(name, value)| (name.as_str(), *value));
    let Some((_, value)) = known.chain(constants).find(|it| it.0 == name) else {
        input.state.unknown = input.state.unknown.or(Some(name));
        return fail.parse_next(input);
    };
    Ok(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Result<f64, String> {
        evaluate(text, &[("r".to_owned(), 0.25), ("count".to_owned(), 8.0)])
    }

    #[test]
    fn operators_bind_as_in_mathematics() {
        let cases = [
            ("1 + 2 * 3", 7.0),
            ("(1 + 2) * 3", 9.0),
            ("7 - 2 - 1", 4.0),
            ("8 / 2 / 2", 2.0),
            ("2 ^ 3 ^ 2", 512.0),
            ("-2 ^ 2", -4.0),
            ("2 ^ -1", 0.5),
            ("2 * -3", -6.0),
            ("- - 3", 3.0),
            (" 2*r ", 0.5),
            ("r*(count-1)", 1.75),
            ("1e-3 * 1.5E2 + .5", 0.65),
            ("sqrt(r) + max(1, 2) + min( 3 , 4 )", 5.5),
            ("abs(-2) * round(2.5) - floor(-0.5) + ceil(0.2)", 8.0),
        ];
        for (text, expected) in cases {
            assert_eq!(value(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn functions_have_the_bits_of_libm() {
        assert_eq!(value("sin(pi / 6)"), Ok(libm::sin(std::f64::consts::PI / 6.0)));
        assert_eq!(value("atan2(1, tau)"), Ok(libm::atan2(1.0, std::f64::consts::TAU)));
    }

    #[test]
    fn errors_say_what_cannot_be_read() {
        let cases = [
            ("", "ends too early"),
            ("2 *", "ends too early"),
            ("(1 + 2", "ends too early"),
            ("2 r", "from \"r\" on"),
            ("2 $ 3", "from \"$ 3\" on"),
            ("1 / 0", "\"1 / 0\" is inf, no number"),
            ("sqrt(-1)", "is NaN, no number"),
            ("inf", "unknown name `inf`"),
            ("2 * radius", "unknown name `radius`, expected one of `r`, `count`"),
            ("max(1)", "the formula"),
            ("sin 3", "the formula"),
        ];
        for (text, expected) in cases {
            let problem = value(text).unwrap_err();
            assert!(problem.contains(expected), "{text}: {problem}");
        }
    }

    #[test]
    fn what_is_nested_without_end_is_refused() {
        for opening in ["(", "-", "sqrt(", "2^"] {
            let problem = value(&opening.repeat(100_000)).unwrap_err();
            assert!(problem.contains("200 characters at most"), "{problem}");
            let just_fits = opening.repeat(LONGEST / opening.len());
            assert!(value(&just_fits).is_err(), "{just_fits}");
        }
    }
}
