//! What contact times are in cases that can be worked out by hand, and in those that have no
//! contact.

use glam::DVec3;

use super::obstacle::Obstacle;
use super::roundoff::Magnitudes;
use super::{search, sphere_sphere, sphere_sphere_linear, sphere_surface};
use crate::flight::Flight;
use crate::surface::{Form, Rectangle, SurfaceMotion};

const G: f64 = 9.81;
const GRAVITY: DVec3 = DVec3::new(0.0, -G, 0.0);
const FLOOR: Form = Form::HalfSpace { point: DVec3::ZERO, normal: DVec3::Y };
const FOREVER: f64 = f64::INFINITY;

/// Answers worked out by hand take a few roundings, as the code does.
const FEW_ROUNDINGS: f64 = 4.0 * f64::EPSILON;

fn flight(position: [f64; 3], velocity: [f64; 3], acceleration: DVec3) -> Flight {
    let (position, velocity) = (DVec3::from(position), DVec3::from(velocity));
    Flight { position, velocity, acceleration, drag_rate: 0.0 }
}

fn in_air(flight: Flight, drag_rate: f64) -> Flight {
    Flight { drag_rate, ..flight }
}

fn square(half: f64) -> Form {
    Form::Rectangle(Rectangle {
        center: DVec3::ZERO,
        axis_x: DVec3::X,
        axis_z: DVec3::Z,
        normal: DVec3::Y,
        half_x: half,
        half_z: half,
        is_open: false,
    })
}

fn meets(flight: &Flight, radius: f64, form: &Form, horizon: f64) -> Option<f64> {
    sphere_surface(flight, radius, form, &SurfaceMotion::REST, horizon)
}

#[track_caller]
fn assert_time(found: Option<f64>, expected: f64) {
    let t = found.expect("a contact");
    assert!((t - expected).abs() <= FEW_ROUNDINGS * expected, "{t} is not {expected}");
}

mod straight {
    use super::*;

    #[test]
    fn head_on_pair_meets_after_the_gap_over_the_speed() {
        let found = sphere_sphere_linear(DVec3::X * 5.0, DVec3::X * -2.0, 1.0);
        assert_eq!(found, Some(2.0));
    }

    #[test]
    fn grazing_pair_misses() {
        let velocity = DVec3::X * -1.0;
        assert_eq!(sphere_sphere_linear(DVec3::new(5.0, 1.0 + 1e-15, 0.0), velocity, 1.0), None);
        assert!(sphere_sphere_linear(DVec3::new(5.0, 1.0 - 1e-15, 0.0), velocity, 1.0).is_some());
    }

    #[test]
    fn overlapping_pair_meets_now_if_it_closes() {
        let offset = DVec3::new(0.3, 0.4, 0.0);
        assert_eq!(sphere_sphere_linear(offset, -offset, 1.0), Some(0.0));
        assert_eq!(sphere_sphere_linear(offset, offset, 1.0), None);
    }

    #[test]
    fn touching_pair_that_slides_misses() {
        let offset = DVec3::new(0.6, 0.8, 0.0);
        let sliding = DVec3::new(-0.8e8, 0.6e8, 0.0);
        assert_eq!(sphere_sphere_linear(offset, sliding, 1.0), None);
        assert_eq!(sphere_sphere_linear(offset, -sliding, 1.0), None);
    }

    #[test]
    fn common_acceleration_changes_nothing() {
        let first = flight([0.0; 3], [1.0, 2.0, 3.0], GRAVITY);
        let second = flight([7.0, 0.5, 0.0], [-2.0, 2.0, 3.0], GRAVITY);
        let expected = sphere_sphere_linear(second.position, second.velocity - first.velocity, 1.0);
        assert_eq!(sphere_sphere(&first, &second, 1.0, FOREVER), expected);
        assert_eq!(sphere_sphere(&second, &first, 1.0, FOREVER), expected);
        assert_eq!(sphere_sphere(&first, &second, 1.0, 0.9 * expected.unwrap()), None);
    }

    #[test]
    fn drag_that_stops_a_sphere_before_the_contact_prevents_it() {
        let still = in_air(flight([0.0; 3], [0.0; 3], DVec3::ZERO), 1.0);
        let to = |v: f64| in_air(flight([3.0, 0.0, 0.0], [-v, 0.0, 0.0], DVec3::ZERO), 1.0);
        // It goes v/γ in all, and has 2 to go.
        assert_eq!(sphere_sphere(&still, &to(2.0), 1.0, FOREVER), None);
        assert_time(sphere_sphere(&still, &to(4.0), 1.0, FOREVER), std::f64::consts::LN_2);
    }

    #[test]
    fn search_agrees_with_the_closed_form() {
        let found = flight([3.0, 0.8, 0.4], [-1.0, 0.01, 0.0], DVec3::ZERO);
        let expected = sphere_sphere_linear(found.position, found.velocity, 1.0).unwrap();
        let size = Magnitudes::of(&found);
        let obstacle = Obstacle::Point { radius: 1.0 };
        assert_time(search::first_contact(&found, &obstacle, size, FOREVER), expected);
    }
}

mod thrown {
    use super::*;

    #[test]
    fn dropped_ball_meets_the_floor_after_the_root_of_2h_over_g() {
        let expected = (2.0 / G).sqrt();
        let ball = flight([0.0, 1.25, 0.0], [3.0, 0.0, 0.0], GRAVITY);
        assert_time(meets(&ball, 0.25, &FLOOR, FOREVER), expected);
        assert_time(meets(&ball, 0.25, &square(10.0), FOREVER), expected);
        assert_eq!(meets(&ball, 0.25, &FLOOR, 0.99 * expected), None);
    }

    #[test]
    fn ball_that_leaves_the_floor_comes_back_after_2v_over_g() {
        // However low the hop, and however the start is rounded.
        for speed in [1e-9, 1e-3, 1.0, 1e8] {
            for off in [-1e-16, 0.0, 1e-16] {
                let ball = flight([0.0, 0.5 + off, 0.0], [0.0, speed, 0.0], GRAVITY);
                assert_time(meets(&ball, 0.5, &FLOOR, FOREVER), 2.0 * speed / G);
            }
        }
    }

    #[test]
    fn light_drag_goes_over_into_none() {
        let ball = flight([0.0, 0.5, 0.0], [0.0, 5.0, 0.0], GRAVITY);
        let in_vacuum = meets(&ball, 0.5, &FLOOR, FOREVER).unwrap();
        for rate in [1e-300, 1e-30, 1e-17] {
            assert_time(meets(&in_air(ball, rate), 0.5, &FLOOR, FOREVER), in_vacuum);
        }
        // To first order, the time is shorter by v γt/(3g) = γt²/6.
        let found = meets(&in_air(ball, 1e-9), 0.5, &FLOOR, FOREVER).unwrap();
        let shorter = in_vacuum * in_vacuum * 1e-9 / 6.0;
        // The next order is a part γt of that.
        assert!((in_vacuum - found - shorter).abs() <= 1e-8 * shorter + 1e-15);
    }

    #[test]
    fn heavy_drag_lets_a_ball_sink_at_terminal_speed() {
        let ball = in_air(flight([0.0, 100.5, 0.0], [0.0; 3], GRAVITY), 1e3);
        // x = -(g/γ) (t - 1/γ) but for e^-γt, which is nothing.
        let expected = 100.0 * 1e3 / G + 1e-3;
        assert_time(meets(&ball, 0.5, &FLOOR, FOREVER), expected);
    }

    #[test]
    fn ball_at_rest_on_something_presses() {
        let resting = flight([0.0, 0.5, 0.0], [0.0; 3], GRAVITY);
        assert_eq!(meets(&resting, 0.5, &FLOOR, FOREVER), Some(0.0));
        assert_eq!(meets(&resting, 0.5, &square(1.0), FOREVER), Some(0.0));
        let ground = Form::Sphere { center: DVec3::new(0.0, -2.0, 0.0), radius: 2.0 };
        assert_eq!(meets(&resting, 0.5, &ground, FOREVER), Some(0.0));
        let held = flight([0.0, -0.5, 0.0], [0.0; 3], DVec3::ZERO);
        assert_eq!(sphere_sphere(&held, &resting, 1.0, FOREVER), Some(0.0));
    }

    #[test]
    fn ball_that_is_fast_enough_leaves_a_summit() {
        let ground = Form::Sphere { center: DVec3::new(0.0, -2.0, 0.0), radius: 2.0 };
        // It takes v² > g R to lift off, R to the centre of the ball.
        let limit = (G * 2.5_f64).sqrt();
        let slow = flight([0.0, 0.5, 0.0], [0.999 * limit, 0.0, 0.0], GRAVITY);
        assert_eq!(meets(&slow, 0.5, &ground, FOREVER), Some(0.0));
        let fast = flight([0.0, 0.5, 0.0], [1.001 * limit, 0.0, 0.0], GRAVITY);
        assert_eq!(meets(&fast, 0.5, &ground, FOREVER), None);
    }

    #[test]
    fn overlap_that_turns_back_meets_where_it_turns() {
        let sunk = flight([0.0, 0.2, 0.0], [0.0, 1.0, 0.0], GRAVITY);
        for form in [FLOOR, square(1.0)] {
            let t = meets(&sunk, 0.5, &form, FOREVER).expect("a contact");
            // It turns where its speed is within 64 roundings of zero, those of the 3 m/s that the
            // start, the gain and the speed come to.
            assert!((t - 1.0 / G).abs() <= 192.0 * f64::EPSILON / G, "{t}");
        }
        // This one comes out first.
        let thrown = flight([0.0, 0.2, 0.0], [0.0, 10.0, 0.0], GRAVITY);
        let back = (10.0 + (100.0 - 2.0 * G * 0.3_f64).sqrt()) / G;
        assert_time(meets(&thrown, 0.5, &FLOOR, FOREVER), back);
        assert_time(meets(&thrown, 0.5, &square(1.0), FOREVER), back);
    }
}

mod surfaces {
    use super::*;

    #[test]
    fn fast_small_ball_does_not_tunnel() {
        let ball = flight([0.01, 1.0, 0.02], [0.0, -1e8, 0.0], GRAVITY);
        for form in [FLOOR, square(1.0), Form::Sphere { center: DVec3::ZERO, radius: 0.1 }] {
            assert!(meets(&ball, 1e-6, &form, 1.0).is_some_and(|t| t < 1.0e-8));
        }
    }

    #[test]
    fn rectangle_is_not_met_from_behind() {
        let ball = flight([0.0, -2.0, 0.0], [0.0, 1.0, 0.0], DVec3::ZERO);
        assert_eq!(meets(&ball, 0.5, &square(1.0), FOREVER), None);
        // It comes through, and falls back onto the face.
        let thrown = flight([0.0, -2.0, 0.0], [0.0, 10.0, 0.0], GRAVITY);
        let expected = (10.0 + (100.0 - 2.0 * G * 2.5_f64).sqrt()) / G;
        assert_time(meets(&thrown, 0.5, &square(1.0), FOREVER), expected);
    }

    #[test]
    fn centre_that_comes_out_beside_an_edge_meets_it_there() {
        // 0.3 from the edge and drifting towards it when its height is zero.
        let ball = flight([1.4, -1.0, 0.0], [-0.1, 1.0, 0.0], DVec3::ZERO);
        assert_time(meets(&ball, 0.5, &square(1.0), FOREVER), 1.0);
    }

    #[test]
    fn open_rectangle_is_not_met_before_a_ball_from_behind_has_left_it() {
        let Form::Rectangle(closed) = square(1.0) else { panic!("a rectangle") };
        let open = Form::Rectangle(Rectangle { is_open: true, ..closed });
        // Thrown up to half a radius over the plane, it falls back; to two radii, it meets the face as it falls.
        let thrown = |height: f64| {
            let speed = (2.0 * G * (2.0 + height)).sqrt();
            flight([0.0, -2.0, 0.0], [0.0, speed, 0.0], GRAVITY)
        };
        assert_eq!(meets(&thrown(0.25), 0.5, &open, FOREVER), None);
        let falls = (2.0_f64 * 3.0 / G).sqrt() + (2.0_f64 * 0.5 / G).sqrt();
        assert_time(meets(&thrown(1.0), 0.5, &open, FOREVER), falls);
        // Beside an edge, as over the face.
        let beside = flight([1.4, -1.0, 0.0], [-0.1, 1.0, 0.0], DVec3::ZERO);
        assert_eq!(meets(&beside, 0.5, &open, FOREVER), None);
        // One that begins within it came from behind.
        let within = flight([0.0, 0.3, 0.0], [0.0, -1.0, 0.0], DVec3::ZERO);
        assert_eq!(meets(&within, 0.5, &open, FOREVER), None);
    }

    #[test]
    fn edge_and_corner_are_met_at_the_radius() {
        let falling = |x: f64, z: f64| flight([x, 2.0, z], [0.0, -1.0, 0.0], DVec3::ZERO);
        assert_time(meets(&falling(1.3, 0.0), 0.5, &square(1.0), FOREVER), 1.6);
        let height = (0.25 - 0.18_f64).sqrt();
        assert_time(meets(&falling(1.3, 1.3), 0.5, &square(1.0), FOREVER), 2.0 - height);
        assert_eq!(meets(&falling(1.4, 1.4), 0.5, &square(1.0), FOREVER), None);
    }

    #[test]
    fn sliding_and_rolling_past_is_no_contact() {
        let pull = DVec3::new(3.0, 0.0, 0.0);
        let on_face = flight([0.1, 0.5, 0.2], [1.0, 0.0, 2.0], pull);
        for rate in [0.0, 0.1] {
            let ball = in_air(on_face, rate);
            assert_eq!(meets(&ball, 0.5, &FLOOR, FOREVER), None);
            // Beyond the edge it flies on straight.
            assert_eq!(meets(&ball, 0.5, &square(1e6), FOREVER), None);
            // Along an edge, at 0.5 from it.
            let along = in_air(flight([0.1, 0.4, 1.3], [1.0, 0.0, 0.0], pull), rate);
            assert_eq!(meets(&along, 0.5, &square(1.0), FOREVER), None);
        }
    }

    #[test]
    fn moving_floor_is_met_as_from_the_floor() {
        let motion = SurfaceMotion { velocity: DVec3::new(0.0, 2.0, 0.0), ..SurfaceMotion::REST };
        let ball = flight([0.0, 3.5, 0.0], [0.0, -1.0, 0.0], DVec3::ZERO);
        assert_time(sphere_surface(&ball, 0.5, &FLOOR, &motion, FOREVER), 1.0);
        // At rest in still air, the floor comes all the same.
        let still = in_air(flight([0.0, 3.5, 0.0], [0.0; 3], DVec3::ZERO), 10.0);
        assert_time(sphere_surface(&still, 0.5, &FLOOR, &motion, FOREVER), 1.5);
    }

    #[test]
    fn turning_gate_meets_the_ball_that_waits() {
        // A gate in the xy plane that faces +z, hinged on the y axis, turns about it by -x.
        let gate = Form::Rectangle(Rectangle {
            center: DVec3::X,
            axis_x: DVec3::X,
            axis_z: -DVec3::Y,
            normal: DVec3::Z,
            half_x: 1.0,
            half_z: 1.0,
            is_open: false,
        });
        let motion = SurfaceMotion { angular_velocity: DVec3::Y * -0.5, ..SurfaceMotion::REST };
        let ball = flight([0.0, 0.0, 1.0], [0.0; 3], DVec3::ZERO);
        // The face touches where sin(90° - ωt) = r/1.
        let expected = libm::acos(0.25) / 0.5;
        assert_time(sphere_surface(&ball, 0.25, &gate, &motion, 10.0), expected);
    }

    #[test]
    fn turntable_carries_nothing() {
        let motion = SurfaceMotion { angular_velocity: DVec3::Y * 30.0, ..SurfaceMotion::REST };
        let sliding = flight([0.3, 0.5, 0.0], [1.0, 0.0, 0.0], DVec3::ZERO);
        for form in [FLOOR, square(1e3)] {
            assert_eq!(sphere_surface(&sliding, 0.5, &form, &motion, 100.0), None);
        }
        let falling = flight([0.3, 1.5, 0.0], [1.0, 0.0, 0.0], GRAVITY);
        let expected = (2.0 / G).sqrt();
        assert_time(sphere_surface(&falling, 0.5, &FLOOR, &motion, 100.0), expected);
    }
}

mod extremes {
    use super::*;

    #[test]
    fn numbers_that_are_none_end_the_search() {
        let values = [0.0, -1.0, 1e-300, 1e300, f64::INFINITY, f64::NAN];
        for a in values {
            for b in values {
                for rate in [0.0, 1e-300, 1e300] {
                    let odd = in_air(flight([a, 1.0, b], [b, a, -1.0], DVec3::splat(a)), rate);
                    let other = in_air(flight([0.0; 3], [a, b, 0.0], DVec3::X * b), 0.5);
                    let found = [
                        sphere_sphere(&odd, &other, 1.0, FOREVER),
                        sphere_sphere(&other, &odd, 1.0, 1e300),
                        meets(&odd, 1.0, &FLOOR, FOREVER),
                        meets(&odd, 1.0, &square(1.0), FOREVER),
                    ];
                    for t in found.into_iter().flatten() {
                        assert!(t >= 0.0 && t.is_finite(), "{t} for {a} {b} {rate}");
                    }
                }
            }
        }
    }
}
