//! Edits: each changes the world and its description, or nothing.

use carom::{Bisect, ConstantForce, DQuat, DVec3, Exact, Friction, Pose, Sphere, Spring, SpringId};
use carom_scene::scene::{self, Color, Force, ImpactLaw, Integrator, Scene};
use carom_session::{Edit, Session, SphereChange, View, group_name};

use crate::{busy, busy_scene, hashes};

const RED: Option<Color> = Some([1.0, 0.0, 0.0]);
const GREEN: Option<Color> = Some([0.0, 1.0, 0.0]);
const BLUE: Option<Color> = Some([0.0, 0.0, 1.0]);
const YELLOW: Option<Color> = Some([1.0, 1.0, 0.0]);

fn view(session: &Session) -> View {
    let mut view = View::default();
    session.fill(&mut view);
    view
}

#[test]
fn an_edit_of_the_simulation_reaches_the_world() {
    let mut session = busy();
    let mut simulation = session.setup().simulation.clone();
    simulation.rule = scene::Rule::Bisect;
    simulation.bisect.max_halvings = 20;
    simulation.bisect.integrator = Integrator::RungeKutta4;
    simulation.exact.impact_law = ImpactLaw::Sequential;
    simulation.spheres_collide = false;
    session.edit(Edit::Simulation(Box::new(simulation.clone()))).unwrap();
    let settings = session.world().settings();
    let bisect = Bisect::default().with_integrator(carom::Integrator::RungeKutta4);
    assert_eq!(settings.rule, bisect.with_max_halvings(20).into());
    assert!(!settings.spheres_collide);
    assert_eq!(session.scene_now().simulation, simulation);

    simulation.rule = scene::Rule::Exact;
    session.edit(Edit::Simulation(Box::new(simulation))).unwrap();
    let exact = Exact::default().with_impact_law(carom::ImpactLaw::Sequential);
    assert_eq!(session.world().settings().rule, exact.into());
}

#[test]
fn a_simulation_that_no_file_could_say_is_refused_in_the_words_of_files() {
    let mut session = busy();
    let mut simulation = session.setup().simulation.clone();
    simulation.rule = scene::Rule::Bisect;
    simulation.bisect.tolerance = 0.1;
    let error = session.edit(Edit::Simulation(Box::new(simulation))).unwrap_err().to_string();
    assert!(error.contains("simulation.bisect.tolerance"), "{error}");
}

#[test]
fn forces_are_changed_added_and_removed_in_both() {
    let mut session = busy();
    let [gravity, drag] = [0, 1].map(|i| session.setup().forces[i].0);
    let moon = Force::Gravity { acceleration: [0.0, -1.62, 0.0] };
    let wind = Force::Constant { force: [0.5, 0.0, 0.0] };
    session.edit(Edit::Force(gravity, moon.clone())).unwrap();
    session.edit(Edit::AddForce(wind.clone())).unwrap();
    session.edit(Edit::RemoveForce(drag)).unwrap();
    assert_eq!(session.scene_now().forces, [moon, wind]);
    assert_eq!(session.world().forces().len(), 2);
    let added = format!("{:?}", session.world().forces().last().unwrap().1);
    assert_eq!(added, format!("{:?}", ConstantForce::new(DVec3::new(0.5, 0.0, 0.0))));
    let negative = Force::ViscousDrag { coefficient: -1.0 };
    assert!(session.edit(Edit::AddForce(negative.clone())).is_err());
    assert!(session.edit(Edit::Force(gravity, negative)).is_err());
    assert_eq!(session.setup().forces.len(), 2);
}

#[test]
fn springs_are_changed_added_and_removed_and_shown_and_saved() {
    let mut session = busy();
    let ids = session.world().spheres().ids().to_vec();
    let pair = Spring::between(ids[0], ids[1], 0.5).with_stiffness(20.0);
    let thread = Spring::to_point(ids[2], DVec3::Y, 1.0).with_only_pulls(true);
    session.edit(Edit::AddSpring(pair)).unwrap();
    session.edit(Edit::AddSpring(thread)).unwrap();
    let stiff = pair.with_stiffness(50.0).with_damping(0.25);
    let [first, second] = [0, 1].map(SpringId::from_number);
    session.edit(Edit::Spring(first, stiff)).unwrap();
    assert_eq!(view(&session).springs, [(first, stiff), (second, thread)]);
    session.edit(Edit::RemoveSpring(second)).unwrap();
    assert_eq!(view(&session).springs, [(first, stiff)]);
    let saved = session.scene_now().springs;
    assert_eq!((saved[0].spheres, saved[0].damping), (Some([0, 1]), 0.25));
    // Invalid edits change nothing.
    for wrong in [
        Edit::AddSpring(pair.with_damping(-1.0)),
        Edit::Spring(first, pair.with_stiffness(f64::NAN)),
        Edit::AddSpring(Spring::between(ids[0], ids[0], 1.0)),
        Edit::Spring(second, thread),
        Edit::RemoveSpring(second),
    ] {
        assert!(session.edit(wrong.clone()).is_err(), "{wrong:?}");
    }
    assert_eq!(view(&session).springs, [(first, stiff)]);
    session.edit(Edit::RemoveSphere(ids[1])).unwrap();
    assert_eq!(view(&session).springs, []);
}

#[test]
fn restitutions_of_colliders_are_changed_one_by_one_and_together() {
    let mut session = busy();
    let floor = session.setup().colliders[0].0;
    let restitutions = |session: &Session| -> Vec<f64> {
        let said = session.scene_now().colliders.iter().map(|it| it.restitution).collect();
        let real: Vec<f64> = session.world().colliders().map(|it| it.1.restitution).collect();
        assert_eq!(said, real);
        said
    };
    session.edit(Edit::ColliderRestitution(floor, 0.25)).unwrap();
    assert_eq!(restitutions(&session), [0.25, 1.0]);
    session.edit(Edit::AllColliderRestitutions(0.5)).unwrap();
    assert_eq!(restitutions(&session), [0.5, 0.5]);
}

/// Two pegs and a floor.
const PEGS: &str = r#"
name = "pegs"
[[generators]]
row = { count = 2, start = [0, 0, 0], step = [1, 0, 0], collider = { name = "peg", shape = { sphere = { radius = 0.1 } } } }
[[colliders]]
name = "floor"
shape = "half-space"
position = [0, -1, 0]
"#;

#[test]
fn colliders_of_one_name_are_changed_together_and_the_others_stay() {
    let scene = carom_scene::Scene::from_toml(PEGS, "pegs").unwrap();
    let mut session = Session::new(scene).unwrap();
    let rough = Friction::sliding(0.3);
    session.edit(Edit::NamedColliderRestitutions("peg".to_owned(), 0.25)).unwrap();
    session.edit(Edit::NamedColliderFrictions("peg".to_owned(), rough)).unwrap();
    for (_, it) in &session.setup().colliders {
        let is_peg = it.name.starts_with("peg");
        assert_eq!(it.restitution, if is_peg { 0.25 } else { 1.0 }, "{}", it.name);
        let friction = if is_peg { rough } else { Friction::default() };
        assert_eq!(it.surface_friction(), friction, "{}", it.name);
    }
    let names: Vec<_> = session.setup().colliders.iter().map(|it| group_name(&it.1.name)).collect();
    assert_eq!(names.iter().filter(|it| **it == "peg").count(), 2, "{names:?}");
    // Only numbers after a space are those of generators.
    for name in ["peg", "peg 3a", "12", "row-1", "left wall", "peg -", ""] {
        assert_eq!(group_name(name), name);
    }
    assert_eq!(group_name("left peg 3-12"), "left peg");
    assert!(session.edit(Edit::NamedColliderRestitutions("peg".to_owned(), 1.5)).is_err());
    let refused = session.edit(Edit::NamedColliderFrictions("pge".to_owned(), rough)).unwrap_err();
    let told = "no collider has the name \"pge\"; there are \"floor\", \"peg\"";
    assert_eq!(refused.to_string(), told);
}

#[test]
fn frictions_of_colliders_are_changed_one_by_one_and_together() {
    let mut session = busy();
    let floor = session.setup().colliders[0].0;
    let frictions = |session: &Session| -> Vec<Friction> {
        let colliders = session.scene_now().colliders;
        let said = colliders.iter().map(|it| it.surface_friction()).collect();
        let real: Vec<Friction> = session.world().colliders().map(|it| it.1.friction).collect();
        assert_eq!(said, real);
        said
    };
    let rough = Friction::sliding(0.3).with_rolling(0.01).with_tangential_restitution(0.5);
    session.edit(Edit::ColliderFriction(floor, rough)).unwrap();
    assert_eq!(frictions(&session), [rough, Friction::default()]);
    let spinning = Friction::default().with_spinning(0.1);
    session.edit(Edit::AllColliderFrictions(spinning)).unwrap();
    assert_eq!(frictions(&session), [spinning; 2]);
    assert_eq!(session.setup().colliders[0].1.restitution, 0.8);
    assert!(session.edit(Edit::AllColliderFrictions(Friction::sliding(-0.1))).is_err());
    assert_eq!(frictions(&session), [spinning; 2]);
}

#[test]
fn friction_and_spin_of_a_sphere_are_changed_and_shown() {
    let mut session = busy();
    hashes(&mut session, 10);
    let id = session.world().spheres().ids()[0];
    let before = session.world().sphere(id).unwrap();
    let (friction, spin) = (Friction::sliding(0.3).with_spinning(0.1), DVec3::new(1.0, 2.0, 3.0));
    let rough = SphereChange { friction: Some(friction), ..SphereChange::default() };
    let spun = SphereChange { angular_velocity: Some(spin), ..SphereChange::default() };
    // In a session that is edited with a mouse, these may be merged.
    let both = Edit::Sphere(id, Box::new(rough)).merged(&Edit::Sphere(id, Box::new(spun))).unwrap();
    session.edit(both).unwrap();
    let changed = before.with_friction(friction).with_angular_velocity(spin);
    assert_eq!(session.world().sphere(id).unwrap(), changed);
    let view = view(&session);
    let shown = (view.spheres.friction(0), view.spheres.angular_velocity(0));
    assert_eq!(shown, (friction, spin));
    let silent = SphereChange { friction: Some(Friction::default()), ..SphereChange::default() };
    session.edit(Edit::Sphere(id, Box::new(silent))).unwrap();
    assert_eq!(session.world().sphere(id).unwrap().friction, Friction::default());
    let bad = SphereChange { friction: Some(Friction::sliding(-1.0)), ..SphereChange::default() };
    assert!(session.edit(Edit::Sphere(id, Box::new(bad))).is_err());
}

#[test]
fn a_change_of_a_sphere_leaves_the_rest_of_it_as_it_is_by_then() {
    let mut session = busy();
    hashes(&mut session, 10);
    let id = session.world().spheres().ids()[0];
    let before = session.world().sphere(id).unwrap();
    let change = SphereChange { mass: Some(7.0), ..SphereChange::default() };
    session.edit(Edit::Sphere(id, Box::new(change))).unwrap();
    assert_eq!(session.world().sphere(id).unwrap(), before.with_mass(7.0));
    session.edit(Edit::RemoveSphere(id)).unwrap();
    assert!(session.world().sphere(id).is_err());
    assert!(session.edit(Edit::RemoveSphere(id)).is_err());
}

#[test]
fn emitters_emit_what_they_were_changed_to() {
    let mut session = busy();
    hashes(&mut session, 30);
    let (id, emitter) = session.world().emitters().next().map(|it| (it.0, *it.1)).unwrap();
    let sphere = emitter.sphere.with_mass(3.0);
    let changed = emitter.with_sphere(sphere).with_period(0.5).with_max_spheres(None);
    session.edit(Edit::Emitter(id, Box::new(changed))).unwrap();
    let said = &session.scene_now().emitters[0];
    assert_eq!((said.period, said.max_spheres, said.sphere.mass), (0.5, None, Some(3.0)));
    assert_eq!(said.sphere.color, GREEN);
    session.step().unwrap();
    let view = view(&session);
    let newest = view.spheres.masses.iter().position(|mass| *mass == 3.0).unwrap();
    assert_eq!(view.spheres.paints[newest].color, GREEN);
    let bad = changed.with_period(-1.0);
    assert!(session.edit(Edit::Emitter(id, Box::new(bad))).is_err());
}

#[test]
fn spheres_keep_the_colour_they_came_with() {
    for rule in [scene::Rule::Exact, scene::Rule::Discrete] {
        let mut scene = busy_scene();
        scene.simulation.rule = rule;
        let mut session = Session::new(scene).unwrap();
        for _ in 0..100 {
            session.step().unwrap();
        }
        // A step back and forth must not confuse them.
        session.jump(0.9).unwrap();
        for _ in 0..30 {
            session.step().unwrap();
            let view = view(&session);
            let of = |color| view.spheres.paints.iter().filter(|it| it.color == color).count();
            assert_eq!([RED, BLUE, GREEN, YELLOW].map(of), [1, 12, 4, 5], "{rule:?}");
        }
    }
}

#[test]
fn the_colour_of_an_emitted_sphere_is_that_of_its_emitter() {
    // Also if the green emitter leaves out half of its spheres, which stay at its place too long.
    for (rule, needs_room) in
        [(scene::Rule::Exact, false), (scene::Rule::Exact, true), (scene::Rule::Discrete, true)]
    {
        let mut scene = busy_scene();
        scene.simulation.rule = rule;
        if needs_room {
            scene.emitters[0].needs_room = Some(true);
            scene.emitters[0].period = 0.03;
        }
        scene.simulation.frame_time = 0.02;
        scene.forces.clear();
        scene.spheres.clear();
        scene.generators.clear();
        let mut session = Session::new(scene).unwrap();
        // Until the first spheres reach an obstacle: green ones move to the right, yellow ones to
        // the left.
        for _ in 0..60 {
            session.step().unwrap();
            let view = view(&session);
            for (velocity, paint) in view.spheres.velocities.iter().zip(&view.spheres.paints) {
                let expected = if velocity.x > 0.0 { GREEN } else { YELLOW };
                assert_eq!(paint.color, expected, "{rule:?}, {} s", session.time());
            }
        }
    }
}

#[test]
fn a_thrown_sphere_is_there_with_its_colour() {
    let mut session = busy();
    let sphere = Sphere::new(DVec3::new(0.0, 50.0, 0.0), 0.1).with_density(800.0);
    session.edit(Edit::Throw { sphere: Box::new(sphere), color: None }).unwrap();
    session.edit(Edit::Throw { sphere: Box::new(sphere), color: RED }).unwrap();
    assert_eq!(
        view(&session).spheres.paints[13..].iter().map(|it| it.color).collect::<Vec<_>>(),
        [BLUE, RED]
    );
    let nowhere = Sphere::new(DVec3::NAN, 0.1);
    assert!(session.edit(Edit::Throw { sphere: Box::new(nowhere), color: RED }).is_err());
    assert_eq!(view(&session).spheres.paints.len(), 15);
}

const FELT: &str = r#"
name = "felt"
forces = [{ gravity = { acceleration = [0, -9.81, 0] } }]
spheres = [
    { position = [0, 1, 0], radius = 0.1, material = "steel" },
    { position = [1, 1, 0], radius = 0.1, material = "steel" },
]
colliders = [{ name = "floor", shape = "half-space", material = "felt" }]
materials = { steel = { restitution_law = { viscoelastic = { speed = 1e6 } } }, felt = { restitution = 0.5 } }
material_pairs = [{ materials = ["steel", "felt"], restitution = 0.25 }]
"#;

#[test]
fn a_coefficient_set_by_hand_overrides_law_and_pair_and_the_others_keep_theirs() {
    let mut session = Session::new(Scene::from_toml(FELT, "felt.toml").unwrap()).unwrap();
    let first = session.world().spheres().ids()[0];
    let change = SphereChange { restitution: Some(0.8), ..SphereChange::default() };
    session.edit(Edit::Sphere(first, Box::new(change))).unwrap();
    let now = session.scene_now();
    assert_eq!((now.spheres[0].restitution, now.spheres[0].restitution_law), (0.8, None));
    assert_eq!(now.spheres[0].material, None);
    let law = scene::RestitutionLaw::Viscoelastic { speed: 1e6 };
    assert_eq!(now.spheres[1].restitution_law, Some(law));
    assert_eq!(now.spheres[1].material.as_deref(), Some("steel"));
    assert_eq!(now.colliders[0].material.as_deref(), Some("felt"));
    assert_eq!(Scene::from_toml(&now.to_toml(), "now.toml").unwrap(), now);
    // 0.8 times 0.5 by the combine rule, and 0.25 by the pair.
    let mut found = Vec::new();
    let mut world = now.world().unwrap();
    for _ in 0..60 {
        let impacts = world.step(1.0 / 60.0).unwrap().impacts.iter();
        found.extend(impacts.map(|it| (it.point.x, it.separation_speed / it.approach_speed)));
    }
    let at = |x: f64| found.iter().find(|it| it.0 == x).unwrap().1;
    assert!((at(0.0) - 0.4).abs() < 1e-12 && (at(1.0) - 0.25).abs() < 1e-12, "{found:?}");
}

#[test]
fn a_surface_put_elsewhere_is_there_in_world_and_file_whatever_its_motion() {
    let motions = [
        "",
        "velocity = [0.5, 0.0, 0.0]\nangular_velocity = [0.0, 1.0, 0.0]",
        "motion = { swing = { axis = [0, 0, 1], amplitude_degrees = 20, frequency = 2 } }",
        "motion = [{ oscillate = { axis = [0, 1, 0], amplitude = 0.1, frequency = 1 } }, \
         { turn = { axis = [0, 1, 0], rate = 2 } }]",
    ];
    for motion in motions {
        let text = format!(
            "name = \"put\"\nspheres = [{{ position = [0, 2, 0], radius = 0.2 }}]\n\
             [[colliders]]\nshape = {{ mesh = {{ vertices = [[0, 0, 1], [1, 0, -1], [-1, 0, -1]], \
             triangles = [[0, 1, 2]] }} }}\n{motion}\n"
        );
        let mut session = Session::new(Scene::from_toml(&text, "put").unwrap()).unwrap();
        (0..20).for_each(|_| session.step().unwrap());
        let id = session.setup().colliders[0].0;
        let turned = DQuat::from_xyzw(0.0, 0.6, 0.0, 0.8);
        let pose = Pose::at(DVec3::new(0.25, -1.0, 0.5)).rotated(turned);
        session.edit(Edit::ColliderPose(id, pose)).unwrap();
        let now = session.world().collider(id).unwrap().pose;
        // Rounding of the pose at rest, from which a motion leads back.
        assert!((now.position - pose.position).length() < 1e-14, "{motion}: {now:?}");
        assert!(now.rotation.dot(pose.rotation).abs() > 1.0 - 1e-14, "{motion}: {now:?}");
        let mut again = Session::new(session.scene_now()).unwrap();
        for frame in 0..20 {
            let [one, other] = [&session, &again].map(|it| view(it).poses[0]);
            // The same, by sines of angles that were rounded on another clock.
            let apart = (one.position - other.position).length();
            assert!(apart < 1e-12, "{motion}, frame {frame}: {one:?} {other:?}");
            let alike = one.rotation.dot(other.rotation).abs();
            assert!(alike > 1.0 - 1e-12, "{motion}, frame {frame}: {one:?} {other:?}");
            session.step().unwrap();
            again.step().unwrap();
        }
    }
}

#[test]
fn a_scaled_surface_is_so_in_world_and_file_and_undo_brings_it_back() {
    let shapes = [
        "{ mesh = { vertices = [[0, 0, 1], [1, 0.25, -1], [-1, 0, -1]], triangles = [[0, 1, 2]] } }",
        "{ height-field = { size_x = 2, size_z = 3, heights = [[0, 0.5], [0.25, 0]] } }",
        "{ track = { radius = 0.5, pieces = [{ straight = { length = 1 } }] } }",
        "half-space",
    ];
    for (number, shape) in shapes.into_iter().enumerate() {
        let quoted = if number == 3 { format!("\"{shape}\"") } else { shape.to_owned() };
        let text = format!(
            "name = \"scaled\"\nforces = [{{ gravity = {{ acceleration = [0, -9.81, 0] }} }}]\n\
             spheres = [{{ position = [0.1, 2, 0.1], radius = 0.2 }}]\n\
             [[colliders]]\nshape = {quoted}\nrestitution = 0.5\n"
        );
        let mut session = Session::new(Scene::from_toml(&text, "scaled").unwrap()).unwrap();
        let id = session.setup().colliders[0].0;
        let before = session.scene_now();
        let Some(scale) = before.colliders[0].shape.scale() else {
            let refused = session.edit(Edit::ColliderScale(id, 2.0)).unwrap_err();
            assert!(refused.to_string().contains("have a scale"), "{refused}");
            continue;
        };
        for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(session.edit(Edit::ColliderScale(id, wrong)).is_err(), "{shape}, {wrong}");
        }
        session.edit(Edit::ColliderScale(id, 3.0 * scale)).unwrap();
        let mut again = Session::new(session.scene_now()).unwrap();
        for _ in 0..90 {
            session.step().unwrap();
            again.step().unwrap();
        }
        let places = [&session, &again].map(|it| it.world().spheres().positions()[0]);
        assert_eq!(places[0], places[1], "{shape}");
        assert!(session.undo());
        assert_eq!(session.scene_now().colliders, before.colliders, "{shape}");
    }
}
