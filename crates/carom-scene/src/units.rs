//! Converts numbers with units, as in `"5 cm"`, to the unit of their field.

use winnow::ascii::float;
use winnow::error::ContextError;
use winnow::prelude::*;

use crate::wording::{DECIMAL_POINT, quoted};

/// A unit: its name, its base unit, and its factor as a fraction. A fraction makes decimal factors
/// round once: 7 cm is exactly the number 0.07.
type Unit = (&'static str, &'static str, [f64; 2]);

const UNITS: [Unit; 53] = [
    ("m", "m", [1.0, 1.0]),
    ("km", "m", [1000.0, 1.0]),
    ("cm", "m", [1.0, 100.0]),
    ("mm", "m", [1.0, 1e3]),
    ("um", "m", [1.0, 1e6]),
    ("nm", "m", [1.0, 1e9]),
    ("in", "m", [0.0254, 1.0]),
    ("ft", "m", [0.3048, 1.0]),
    ("s", "s", [1.0, 1.0]),
    ("ms", "s", [1.0, 1e3]),
    ("us", "s", [1.0, 1e6]),
    ("min", "s", [60.0, 1.0]),
    ("h", "s", [3600.0, 1.0]),
    ("kg", "kg", [1.0, 1.0]),
    ("g", "kg", [1.0, 1e3]),
    ("mg", "kg", [1.0, 1e6]),
    ("t", "kg", [1e3, 1.0]),
    ("m/s", "m/s", [1.0, 1.0]),
    ("cm/s", "m/s", [1.0, 100.0]),
    ("mm/s", "m/s", [1.0, 1e3]),
    ("km/s", "m/s", [1e3, 1.0]),
    ("km/h", "m/s", [1.0, 3.6]),
    ("m/s²", "m/s²", [1.0, 1.0]),
    ("m/s^2", "m/s²", [1.0, 1.0]),
    ("cm/s²", "m/s²", [1.0, 100.0]),
    ("cm/s^2", "m/s²", [1.0, 100.0]),
    ("kg/m³", "kg/m³", [1.0, 1.0]),
    ("kg/m^3", "kg/m³", [1.0, 1.0]),
    ("g/cm³", "kg/m³", [1e3, 1.0]),
    ("g/cm^3", "kg/m³", [1e3, 1.0]),
    ("N", "N", [1.0, 1.0]),
    ("kN", "N", [1e3, 1.0]),
    ("mN", "N", [1.0, 1e3]),
    ("J", "J", [1.0, 1.0]),
    ("mJ", "J", [1.0, 1e3]),
    ("N/m", "N/m", [1.0, 1.0]),
    ("kN/m", "N/m", [1e3, 1.0]),
    ("N/mm", "N/m", [1e3, 1.0]),
    ("Pa s", "Pa s", [1.0, 1.0]),
    ("mPa s", "Pa s", [1.0, 1e3]),
    ("kg/s", "kg/s", [1.0, 1.0]),
    ("g/s", "kg/s", [1.0, 1e3]),
    ("Hz", "Hz", [1.0, 1.0]),
    ("kHz", "Hz", [1e3, 1.0]),
    ("mHz", "Hz", [1.0, 1e3]),
    ("rad/s", "rad/s", [1.0, 1.0]),
    ("deg/s", "rad/s", [PI, 180.0]),
    ("°/s", "rad/s", [PI, 180.0]),
    ("rpm", "rad/s", [PI, 30.0]),
    (RADIANS, DEGREES, [180.0, PI]),
    ("deg", DEGREES, [1.0, 1.0]),
    ("°", DEGREES, [1.0, 1.0]),
    ("turns", DEGREES, [360.0, 1.0]),
];

const PI: f64 = std::f64::consts::PI;
const DEGREES: &str = "degrees";
const RADIANS: &str = "rad";

/// Unit of each field that has one.
const FIELDS: [(&str, &str); 77] = [
    ("acceleration", "m/s²"),
    ("amplitude", "m"),
    ("amplitude_degrees", DEGREES),
    ("anchor", "m"),
    ("angular_velocity", "rad/s"),
    ("arc_degrees", DEGREES),
    ("azimuth_degrees", DEGREES),
    ("bank_degrees", DEGREES),
    ("bottom_radius", "m"),
    ("center", "m"),
    ("coefficient", "kg/s"),
    ("contact_duration", "s"),
    ("core_radius", "m"),
    ("cue_mass", "kg"),
    ("damping", "kg/s"),
    ("degrees", DEGREES),
    ("density", "kg/m³"),
    ("depth", "J"),
    ("diameter", "m"),
    ("drop", "m"),
    ("duration", "s"),
    ("elevation_degrees", DEGREES),
    ("euler_degrees", DEGREES),
    ("facet_degrees", DEGREES),
    ("far", "m"),
    ("force", "N"),
    ("force_tick", "s"),
    ("frame_time", "s"),
    ("frequency", "Hz"),
    ("gravity", "m/s²"),
    ("growth_speed", "m/s"),
    ("height", "m"),
    ("heights", "m"),
    ("interval", "s"),
    ("kick", "m/s"),
    ("length", "m"),
    ("look_at", "m"),
    ("mass", "kg"),
    ("max", "m"),
    ("min", "m"),
    ("near", "m"),
    ("opening_degrees", DEGREES),
    ("period", "s"),
    ("phase_degrees", DEGREES),
    ("pitch_degrees", DEGREES),
    ("pivot", "m"),
    ("position", "m"),
    ("positions", "m"),
    ("radius", "m"),
    ("radius_range", "m"),
    ("rate", "rad/s"),
    ("rest_length", "m"),
    ("ring_radius", "m"),
    ("row_step", "m"),
    ("shift", "m"),
    ("size", "m"),
    ("size_x", "m"),
    ("size_z", "m"),
    ("softening", "m"),
    ("spacing", "m"),
    ("speed", "m/s"),
    ("start", "m"),
    ("step", "m"),
    ("stiffness", "N/m"),
    ("surface_height", "m"),
    ("surface_velocity", "m/s"),
    ("temperature", "J"),
    ("tolerance", "m"),
    ("times", "s"),
    ("top_radius", "m"),
    ("tube_radius", "m"),
    ("velocity", "m/s"),
    ("vertical_fov_degrees", DEGREES),
    ("vertices", "m"),
    ("viscosity", "Pa s"),
    ("wind", "m/s"),
    ("zone_tick", "s"),
];

/// Whether the text is the name of a unit.
pub(crate) fn is_unit(name: &str) -> bool {
    UNITS.iter().any(|it| it.0 == name)
}

/// Where a number with a unit stands in a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place<'a> {
    /// In the field of this name.
    Field(&'a str),
    /// In a parameter, where any unit is allowed: values are converted to SI units, angles to
    /// radians.
    Parameter,
}

/// Converts a text such as `5 cm` to a number in the unit of its place. Returns `None` if the text
/// is no number with a unit, or if its field has no unit.
///
/// # Errors
/// A description of what is wrong with the unit.
pub(crate) fn in_unit_of(place: Place, text: &str) -> Option<Result<f64, String>> {
    let wanted = match place {
        Place::Field(field) => Some(FIELDS.iter().find(|it| it.0 == field)?.1),
        Place::Parameter => None,
    };
    let mut rest = text.trim();
    let is_number = rest.starts_with(|it: char| it.is_ascii_digit() || "+-.".contains(it));
    let number: Result<f64, ContextError> = float.parse_next(&mut rest);
    let number = number.ok().filter(|number| is_number && number.is_finite())?;
    let name = rest.trim();
    if name.is_empty() {
        return None;
    }
    let Some(&(_, unit, [by, of])) = UNITS.iter().find(|it| it.0 == name) else {
        return Some(Err(unknown(name, wanted)));
    };
    Some(match wanted {
        Some(wanted) if wanted != unit => {
            Err(format!("\"{}\" is in {name}, not in {wanted}", text.trim()))
        }
        None if name == RADIANS => Ok(number),
        None if unit == DEGREES => Ok(number * by / of * PI / 180.0),
        _ => Ok(number * by / of),
    })
}

fn unknown(name: &str, wanted: Option<&str>) -> String {
    if name.starts_with(',') {
        return DECIMAL_POINT.to_owned();
    }
    let fitting = UNITS.iter().filter(|it| wanted.is_none_or(|wanted| wanted == it.1));
    format!("unknown unit `{name}`, expected one of {}", quoted(fitting.map(|it| it.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(name: &str, text: &str) -> Option<Result<f64, String>> {
        in_unit_of(Place::Field(name), text)
    }

    #[test]
    fn a_number_with_a_unit_is_the_number_that_one_would_write() {
        let cases = [
            ("radius", "7 cm", 0.07),
            ("radius", "7cm", 0.07),
            ("position", "-2.5 mm", -0.0025),
            ("size", "1e3 m", 1000.0),
            ("diameter", "2 in", 0.0508),
            ("period", "20 ms", 0.02),
            ("mass", "3 g", 0.003),
            ("density", "7.8 g/cm^3", 7800.0),
            ("velocity", "36 km/h", 10.0),
            ("acceleration", "-9.81 m/s^2", -9.81),
            ("angular_velocity", "2 rad/s", 2.0),
            ("degrees", "30 deg", 30.0),
            ("vertical_fov_degrees", "0.5 turns", 180.0),
        ];
        for (name, text, expected) in cases {
            assert_eq!(field(name, text), Some(Ok(expected)), "{name} = {text}");
        }
    }

    #[test]
    fn angles_are_degrees_where_a_field_says_so_and_radians_in_parameters() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let of_field = field("degrees", &format!("{quarter} rad")).unwrap().unwrap();
        // Two rounding errors of an eighth of an ulp of 90 each.
        assert!((of_field - 90.0).abs() <= 2.0 * 90.0 * f64::EPSILON, "{of_field}");
        let spin = field("angular_velocity", "60 rpm").unwrap().unwrap();
        assert!((spin - 2.0 * PI).abs() <= 2.0 * PI * f64::EPSILON, "{spin}");
        assert_eq!(in_unit_of(Place::Parameter, "90 deg"), Some(Ok(quarter)));
        assert_eq!(in_unit_of(Place::Parameter, "0.03 rad"), Some(Ok(0.03)));
        assert_eq!(in_unit_of(Place::Parameter, "5 cm"), Some(Ok(0.05)));
    }

    #[test]
    fn units_of_something_else_are_errors() {
        let wrong = field("radius", "5 kg").unwrap().unwrap_err();
        assert_eq!(wrong, "\"5 kg\" is in kg, not in m");
        let comma = field("radius", "0,4 m").unwrap().unwrap_err();
        assert_eq!(comma, "decimals have a point, not a comma");
        let unknown = field("mass", "5 kgs").unwrap().unwrap_err();
        assert_eq!(unknown, "unknown unit `kgs`, expected one of `kg`, `g`, `mg`, `t`");
    }

    #[test]
    fn other_texts_are_left_alone() {
        for (name, text) in [
            ("shape", "half-space"),
            ("color", "#aabbcc"),
            ("name", "3 pegs"),
            ("radius", "wide"),
            ("radius", "5"),
            ("radius", "inf m"),
        ] {
            assert_eq!(field(name, text), None, "{name} = {text}");
        }
    }
}
