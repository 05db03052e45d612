//! Comparison of two rules.

use carom::{DVec3, Sphere};
use carom_scene::scene::{Force, ImpactLaw, Rule, Zones};
use carom_session::{Comparison, Edit, Session, SessionError, View, Watched};

use crate::busy_scene;

fn comparison() -> Comparison {
    Comparison::new(&busy_scene(), [Rule::Exact, Rule::Discrete]).unwrap()
}

#[test]
fn each_side_is_what_it_would_be_alone() {
    let mut both = comparison();
    for rule in [Rule::Exact, Rule::Discrete] {
        let mut scene = busy_scene();
        scene.simulation.rule = rule;
        let mut alone = Session::new(scene).unwrap();
        alone.jump(1.0).unwrap();
        both.seek(60);
        assert!(both.advance_seek(u64::MAX).unwrap());
        let side = if rule == Rule::Exact { both.first() } else { both.second() };
        assert_eq!(side.state_hash(), alone.state_hash());
    }
}

#[test]
fn rules_that_agree_are_at_no_distance() {
    let mut both = Comparison::new(&busy_scene(), [Rule::Exact, Rule::Exact]).unwrap();
    (0..60).for_each(|_| both.step().unwrap());
    assert_eq!((both.distance().largest, both.distance().root_mean_square), (0.0, 0.0));
}

#[test]
fn the_distance_starts_at_zero_and_is_measured_over_common_spheres() {
    let mut both = comparison();
    (0..60).for_each(|_| both.step().unwrap());
    let distances: Vec<_> = both.distances().copied().collect();
    assert_eq!((distances.len(), distances[0].largest), (61, 0.0));
    let last = both.distance();
    assert_eq!(distances[60], last);
    assert!(last.largest > 0.0 && last.root_mean_square <= last.largest);
    // Computed directly from the worlds.
    let (first, second) = (both.first().world(), both.second().world());
    let ways: Vec<f64> = first
        .spheres()
        .ids()
        .iter()
        .filter_map(|id| {
            let (one, other) = (first.sphere(*id).ok()?, second.sphere(*id).ok()?);
            Some((one.position - other.position).length())
        })
        .collect();
    let largest = ways.iter().copied().fold(0.0, f64::max);
    assert!((last.largest - largest).abs() <= 1e-15 * largest);
}

#[test]
fn they_stay_in_step_on_every_way() {
    let mut both = comparison();
    for frame in [50, 20, 21, 70] {
        both.seek(frame);
        while !both.advance_seek(3).unwrap() {}
        assert_eq!((both.first().frame(), both.second().frame()), (frame, frame));
    }
    both.seek(0);
    both.seek(65);
    both.advance_seek(5).unwrap();
    both.stop_seeking().unwrap();
    assert_eq!(both.first().frame(), both.second().frame());
}

#[test]
fn an_edit_is_made_to_both_or_to_none() {
    let mut both = comparison();
    (0..10).for_each(|_| both.step().unwrap());
    both.edit(&Edit::AddForce(Force::Constant { force: [1.0, 0.0, 0.0] })).unwrap();
    let mut simulation = both.first().setup().simulation.clone();
    simulation.spheres_collide = false;
    both.edit(&Edit::Simulation(Box::new(simulation.clone()))).unwrap();
    assert_eq!(both.first().setup().simulation.rule, Rule::Exact);
    assert_eq!(both.second().setup().simulation.rule, Rule::Discrete);
    assert!(!both.second().world().settings().spheres_collide);
    // Only one of the rules supports a periodic box.
    simulation.boundary = carom_scene::scene::Boundary::Periodic {
        size: [9.0; 3],
        shear_rate: 0.0,
        relative_velocities: false,
    };
    let hashes = [both.first().state_hash(), both.second().state_hash()];
    assert!(both.edit(&Edit::Simulation(Box::new(simulation))).is_err());
    assert_eq!([both.first().state_hash(), both.second().state_hash()], hashes);
    assert_eq!(both.first().setup().forces.len(), 3);
}

#[test]
fn parameters_of_rules_that_are_not_edited_stay_each_its_own() {
    let mut simulations = [Rule::Exact, Rule::Exact].map(|rule| {
        let mut simulation = busy_scene().simulation;
        simulation.rule = rule;
        simulation
    });
    simulations[1].exact.impact_law = ImpactLaw::Sequential;
    let session = Watched::from(Session::new(busy_scene()).unwrap());
    let Ok(Watched::Two(mut both)) = session.compared(Some(&simulations)) else { panic!("two") };
    simulations[0].spheres_collide = false;
    both.edit(&Edit::Simulation(Box::new(simulations[0].clone()))).unwrap();
    let second = &both.second().setup().simulation;
    assert_eq!((second.exact.impact_law, second.spheres_collide), (ImpactLaw::Sequential, false));
    simulations[0].exact.zones = Zones::Never;
    both.edit(&Edit::Simulation(Box::new(simulations[0].clone()))).unwrap();
    assert_eq!(both.second().setup().simulation.exact, simulations[0].exact);
}

#[test]
fn if_one_cannot_go_on_neither_does() {
    let mut scene = busy_scene();
    scene.simulation.exact.max_impacts = 2;
    scene.simulation.exact.zones = Zones::Never;
    let mut both = Comparison::new(&scene, [Rule::Discrete, Rule::Exact]).unwrap();
    let error = loop {
        if let Err(error) = both.step() {
            break error;
        }
    };
    assert!(matches!(error, SessionError::World(carom::Error::TooManyImpacts { .. })));
    assert_eq!(both.first().frame(), both.second().frame());
    let frame = both.first().frame();
    both.seek(frame + 10);
    assert!(both.advance_seek(u64::MAX).is_err());
    assert_eq!((both.first().frame(), both.second().frame()), (frame, frame));
    // Both can still be edited and viewed.
    let sphere = Sphere::new(DVec3::new(0.0, 99.0, 0.0), 0.1);
    both.edit(&Edit::Throw { sphere: Box::new(sphere), color: None }).unwrap();
    let mut view = View::default();
    both.fill(&mut view);
    assert_eq!(view.other.unwrap().spheres.ids.len(), view.spheres.ids.len());
}
