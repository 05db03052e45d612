//! Formulas: arithmetic with numbers and names, as in `2 * r + sin(pi / 6)`.
//!
//! Every function is exact, correctly rounded or taken from `libm`, so a formula has the same bits
//! on every machine.

use thiserror::Error;
use winnow::ModalResult;
use winnow::ascii::{float, multispace0};
use winnow::combinator::{
    Infix, Prefix, alt, cut_err, delimited, dispatch, expression, fail, preceded, separated,
    terminated,
};
use winnow::prelude::*;
use winnow::stream::Stateful;
use winnow::token::{any, one_of, take_while};

use crate::units;
use crate::wording::quoted;

/// Most bytes of a formula, and most nested parentheses: a text must not exhaust the stack.
const LONGEST: usize = 200;
const DEEPEST: u32 = 32;

/// A function of one number, by name.
type Unary = (&'static str, fn(f64) -> f64);
/// A function of two numbers, by name.
type Binary = (&'static str, fn(f64, f64) -> f64);

const UNARY: [Unary; 14] = [
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
const BINARY: [Binary; 3] = [("atan2", libm::atan2), ("max", larger), ("min", smaller)];
const CONSTANTS: [(&str, f64); 3] = [
    ("deg", std::f64::consts::PI / 180.0),
    ("pi", std::f64::consts::PI),
    ("tau", std::f64::consts::TAU),
];

/// The larger of two numbers; NaN if either is NaN.
fn larger(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}

/// The smaller of two numbers; NaN if either is NaN.
fn smaller(a: f64, b: f64) -> f64 {
    if a < b || a.is_nan() { a } else { b }
}

/// Numbers by name.
pub(crate) type NamedValues = [(String, f64)];

/// What is wrong with a formula.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub(crate) enum FormulaError {
    /// The formula contains a name that is no parameter, function or constant.
    #[error("unknown name `{name}`, expected one of {expected}")]
    UnknownName { name: String, expected: String },
    /// Any other error, in words.
    #[error("{0}")]
    Other(String),
}

/// Text of a formula with the state of its parser.
type Input<'a> = Stateful<&'a str, State<'a>>;

#[derive(Debug, Clone)]
struct State<'a> {
    known: &'a NamedValues,
    /// Number of open parentheses.
    depth: u32,
    /// The first error that says more than where the text cannot be read.
    error: Option<FormulaError>,
}

/// Whether the name is that of a function or a constant.
pub(crate) fn is_taken(name: &str) -> bool {
    own_names().any(|own| own == name)
}

/// Names of all functions and constants.
fn own_names<'a>() -> impl Iterator<Item = &'a str> {
    let functions = UNARY.iter().map(|it| it.0).chain(BINARY.iter().map(|it| it.0));
    functions.chain(CONSTANTS.iter().map(|it| it.0))
}

/// Whether the text is a name: letters, digits and `_`, not starting with a digit.
pub(crate) fn is_name(text: &str) -> bool {
    let is_letter = |it: char| it.is_ascii_alphabetic() || it == '_';
    text.starts_with(is_letter) && text.chars().all(|it| is_letter(it) || it.is_ascii_digit())
}

/// Computes the value of a formula.
///
/// Operators are `+ - * /` and `^`, which binds closest and from the right: `-2^2` is -4. Angles are in
/// radians.
///
/// # Errors
/// [`FormulaError`] for text that cannot be read, an unknown name, or a value that is not finite.
pub(crate) fn evaluate(text: &str, known: &NamedValues) -> Result<f64, FormulaError> {
    if text.len() > LONGEST {
        return Err(FormulaError::Other(format!("a formula has {LONGEST} characters at most")));
    }
    let mut input = Input { input: text, state: State { known, depth: 0, error: None } };
    let value = terminated(sum, multispace0).parse_next(&mut input);
    if let Some(error) = input.state.error {
        return Err(error);
    }
    match value {
        Ok(value) if input.input.is_empty() && value.is_finite() => Ok(value),
        Ok(value) if input.input.is_empty() => {
            Err(FormulaError::Other(format!("\"{text}\" must be a finite number, not {value}")))
        }
        _ => Err(FormulaError::Other(unreadable(text, input.input.trim()))),
    }
}

fn unreadable(text: &str, rest: &str) -> String {
    let word = rest.split(|it: char| it.is_whitespace() || "+-*()".contains(it)).next();
    match rest {
        "" => format!("the formula \"{text}\" ends too early"),
        _ if word.is_some_and(units::is_unit) => {
            format!("a formula has no units: give those of \"{text}\" to parameters")
        }
        _ => format!("the formula \"{text}\" cannot be read from \"{rest}\" on"),
    }
}

/// Parses operands with operators between them, by precedence.
fn sum(input: &mut Input) -> ModalResult<f64> {
    input.state.depth += 1;
    if input.state.depth > DEEPEST {
        let error = format!("a formula has {DEEPEST} parentheses in each other at most");
        return wrong(input, FormulaError::Other(error));
    }
    let value = expression(preceded(multispace0, operand))
        .prefix(preceded(
            multispace0,
            dispatch! {one_of(['-', '+']);
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
        .parse_next(input);
    input.state.depth -= 1;
    value
}

/// Parses a number, a name, a call of a function, or an expression in parentheses.
fn operand(input: &mut Input) -> ModalResult<f64> {
    alt((in_parentheses, named, number)).parse_next(input)
}

/// Parses a number that starts with a digit or a point: `inf` and `nan` are no numbers here, and a
/// sign is an operator.
fn number(input: &mut Input) -> ModalResult<f64> {
    let starts = input.input.starts_with(|it: char| it.is_ascii_digit() || it == '.');
    if starts { float.parse_next(input) } else { fail.parse_next(input) }
}

fn in_parentheses(input: &mut Input) -> ModalResult<f64> {
    delimited('(', cut_err(sum), cut_err((multispace0, ')'))).parse_next(input)
}

/// Parses a parameter, a constant or a call of a function.
fn named(input: &mut Input) -> ModalResult<f64> {
    let name: &str = take_while(1.., |it: char| it.is_ascii_alphanumeric() || it == '_')
        .verify(is_name)
        .parse_next(input)?;
    if let Some((_, function)) = UNARY.iter().find(|it| it.0 == name) {
        return match arguments(input)?[..] {
            [value] => Ok(function(value)),
            _ => wrong(input, FormulaError::Other(format!("\"{name}\" takes one number"))),
        };
    }
    if let Some((_, function)) = BINARY.iter().find(|it| it.0 == name) {
        return match arguments(input)?[..] {
            [first, second] => Ok(function(first, second)),
            _ => wrong(input, FormulaError::Other(format!("\"{name}\" takes two numbers"))),
        };
    }
    let constants = CONSTANTS.iter().copied();
    let known = input.state.known.iter().map(|(name, value)| (name.as_str(), *value));
    if let Some((_, value)) = known.chain(constants).find(|it| it.0 == name) {
        return Ok(value);
    }
    let known = input.state.known.iter().map(|it| it.0.as_str());
    let expected = quoted(known.chain(own_names()));
    wrong(input, FormulaError::UnknownName { name: name.to_owned(), expected })
}

/// Parses the arguments of a function, in parentheses.
fn arguments(input: &mut Input) -> ModalResult<Vec<f64>> {
    let values = separated(1.., sum, (multispace0, ','));
    cut_err(delimited((multispace0, '('), values, (multispace0, ')'))).parse_next(input)
}

/// Stops the parser with an error; the first error is kept.
fn wrong(input: &mut Input, error: FormulaError) -> ModalResult<f64> {
    input.state.error.get_or_insert(error);
    cut_err(fail).parse_next(input)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Result<f64, String> {
        let known = [("r".to_owned(), 0.25), ("count".to_owned(), 8.0)];
        evaluate(text, &known).map_err(|error| error.to_string())
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
            ("2 * * 3", "from \"* 3\" on"),
            ("(r + )", "from \")\" on"),
            ("()", "from \")\" on"),
            ("$r", "from \"$r\" on"),
            ("5 cm + r", "a formula has no units"),
            ("1 / 0", "\"1 / 0\" must be a finite number, not inf"),
            ("max(0, sqrt(-1))", "must be a finite number, not NaN"),
            ("inf", "unknown name `inf`"),
            ("2 * radius", "unknown name `radius`, expected one of `r`, `count`"),
            ("max(1) + 2", "\"max\" takes two numbers"),
            ("sin(1, 2)", "\"sin\" takes one number"),
            ("sin 3", "from \"3\" on"),
        ];
        for (text, expected) in cases {
            let problem = value(text).unwrap_err();
            assert!(problem.contains(expected), "{text}: {problem}");
        }
    }

    #[test]
    fn what_is_nested_without_end_is_refused() {
        let nested = format!("{}r{}", "(".repeat(31), ")".repeat(31));
        assert_eq!(value(&nested), Ok(0.25));
        assert!(value(&format!("({nested})")).unwrap_err().contains("in each other at most"));
        for opening in ["(", "-", "sqrt(", "2^"] {
            let problem = value(&opening.repeat(100_000)).unwrap_err();
            assert!(problem.contains("200 characters at most"), "{problem}");
            let just_fits = opening.repeat(LONGEST / opening.len());
            assert!(value(&just_fits).is_err(), "{just_fits}");
        }
    }
}
