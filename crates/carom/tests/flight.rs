//! Free flight: the parabola, drag, and their limits. The digits are checked against 77 of them
//! in `contact_time/oracle`.

mod common;

use carom::{DVec3, Flight};
use common::{G, assert_close, assert_close_vec, vec};

fn thrown(drag_rate: f64) -> Flight {
    Flight {
        position: vec(1.0, 2.0, 3.0),
        velocity: vec(4.0, 30.0, -5.0),
        acceleration: vec(0.0, -G, 0.0),
        drag_rate,
    }
}

#[test]
fn flight_without_drag_is_a_parabola() {
    let (x, v) = thrown(0.0).after(2.0);
    assert_eq!(x, vec(9.0, 62.0 - 2.0 * G, -7.0));
    assert_eq!(v, vec(4.0, 30.0 - 2.0 * G, -5.0));
}

#[test]
fn faint_drag_changes_no_digit() {
    let (parabola, v) = thrown(0.0).after(2.0);
    for rate in [1e-300, 1e-100, 1e-18] {
        assert_eq!(thrown(rate).after(2.0), (parabola, v));
    }
}

#[test]
fn speed_tends_to_the_terminal_one() {
    for rate in [1e-3, 1.0, 1e3] {
        let terminal = vec(0.0, -G / rate, 0.0);
        // e^-80 of the 30 m/s is nothing; the quotient rounds twice.
        assert_close_vec(thrown(rate).velocity_at(80.0 / rate), terminal, 3e-16 * G / rate);
    }
}

#[test]
fn without_a_force_drag_stops_a_sphere_after_v_over_the_rate() {
    let coasting = Flight { acceleration: DVec3::ZERO, ..thrown(2.0) };
    for t in [1e3, 1e300, f64::MAX] {
        let (x, v) = coasting.after(t);
        assert_close_vec(x, coasting.position + coasting.velocity / 2.0, 4e-15);
        assert_close(v.length(), 0.0, 0.0);
    }
}

#[test]
fn drag_of_any_size_and_time_gives_numbers() {
    for rate in [0.0, 1e-300, 1e-5, 1e5, 1e300] {
        for t in [0.0, 1e-300, 1.0, 1e150, 1e300] {
            let at_rest =
                Flight { velocity: DVec3::ZERO, acceleration: DVec3::ZERO, ..thrown(rate) };
            assert_eq!(at_rest.after(t), (at_rest.position, DVec3::ZERO));
            let (x, v) = thrown(rate).after(t);
            assert!(!x.is_nan() && !v.is_nan(), "{x} {v} at {t} with {rate}");
        }
    }
}

#[test]
fn two_flights_in_a_row_are_one() {
    let flight = thrown(0.7);
    let (position, velocity) = flight.after(0.4);
    let rest = Flight { position, velocity, ..flight };
    let (x, v) = flight.after(1.0);
    // A few roundings of the way, some 30 m, and of the speed, 30 m/s.
    assert_close_vec(rest.position_at(0.6), x, 3e-14);
    assert_close_vec(rest.velocity_at(0.6), v, 3e-14);
}
