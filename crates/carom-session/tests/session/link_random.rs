//! Links of random sessions are repeated bit for bit.

use carom::{
    ColliderId, DQuat, DVec3, ForceId, Friction, Pose, Sphere, SphereId, Spring, SpringId,
};
use carom_scene::scene::{Force, Rule, Zones};
use carom_session::{Edit, Session, SphereChange};
use proptest::prelude::*;

use crate::busy_scene;
use crate::link::assert_repeats;

/// An operation on a session, which may be refused.
#[derive(Debug, Clone)]
enum Deed {
    Steps(u64),
    GoTo(u64),
    Edit(Edit),
}

fn edit() -> impl Strategy<Value = Edit> {
    let force = |it: f64| Force::Gravity { acceleration: [it, -9.0, 0.1] };
    let rules = [Rule::Exact, Rule::Contact, Rule::Bisect, Rule::Discrete];
    let push = |velocity| SphereChange { velocity: Some(velocity), ..Default::default() };
    let ball = |x| Sphere::new(DVec3::new(x, 8.0, 0.0), 0.2);
    prop_oneof![
        (0.001..0.03).prop_map(Edit::FrameTime),
        (0.5..1.1).prop_map(Edit::AllColliderRestitutions),
        (0..3_u64, 0.0..1.0)
            .prop_map(|(id, e)| Edit::ColliderRestitution(ColliderId::from_number(id), e)),
        (-0.1..1.0).prop_map(|it| Edit::AllColliderFrictions(Friction::sliding(it))),
        (0..3_u64, 0.0..1.0).prop_map(|(id, it)| {
            let friction = Friction::default().with_rolling(0.1 * it).with_spinning(it);
            Edit::ColliderFriction(ColliderId::from_number(id), friction)
        }),
        (0..3_u64, -1.0..1.0).prop_map(|(id, it)| {
            let pose = Pose::at(DVec3::new(it, -9.0, 0.3 * it));
            let turned = pose.rotated(DQuat::from_xyzw(0.0, 0.0, 0.6 * it, 0.8));
            Edit::ColliderPose(ColliderId::from_number(id), turned)
        }),
        (0..3_u64, 0.1..2.0)
            .prop_map(|(id, scale)| Edit::ColliderScale(ColliderId::from_number(id), scale)),
        (0..20_u64, -0.1..1.0).prop_map(|(id, it)| {
            let friction = Some(Friction::sliding(it));
            let angular_velocity = Some(DVec3::new(it, -9.0 * it, 4.0));
            let change = SphereChange { friction, angular_velocity, ..Default::default() };
            Edit::Sphere(SphereId::from_number(id), Box::new(change))
        }),
        (0..3_u64, -1.0..1.0)
            .prop_map(move |(id, it)| Edit::Force(ForceId::from_number(id), force(it))),
        (0..4_u64).prop_map(|id| Edit::RemoveForce(ForceId::from_number(id))),
        (-1.0..1.0).prop_map(move |it| Edit::AddForce(force(it))),
        (0..20_u64, 0..20_u64, -0.1..9.0).prop_map(|(one, other, it)| {
            let [one, other] = [one, other].map(SphereId::from_number);
            Edit::AddSpring(Spring::between(one, other, 0.1 * it).with_stiffness(it))
        }),
        (0..4_u64, 0..20_u64, -0.1..9.0).prop_map(|(id, sphere, it)| {
            let spring = Spring::to_point(SphereId::from_number(sphere), DVec3::Y, 1.0);
            Edit::Spring(SpringId::from_number(id), spring.with_stiffness(it))
        }),
        (0..4_u64).prop_map(|id| Edit::RemoveSpring(SpringId::from_number(id))),
        (0..20_u64, -3.0..3.0).prop_map(move |(id, it)| {
            Edit::Sphere(SphereId::from_number(id), Box::new(push(DVec3::new(it, 2.0, -it))))
        }),
        (0..30_u64).prop_map(|id| Edit::RemoveSphere(SphereId::from_number(id))),
        (-3.0..3.0).prop_map(move |x| Edit::Throw { sphere: Box::new(ball(x)), color: None }),
        (0..4_usize, 2..9_u32).prop_map(move |(rule, max_impacts)| {
            let mut simulation = busy_scene().simulation;
            simulation.rule = rules[rule];
            // So few that some steps fail.
            simulation.exact.max_impacts = max_impacts;
            simulation.exact.zones = Zones::Never;
            Edit::Simulation(Box::new(simulation))
        }),
    ]
}

fn deed() -> impl Strategy<Value = Deed> {
    prop_oneof![
        2 => (1..15_u64).prop_map(Deed::Steps),
        1 => (0..80_u64).prop_map(Deed::GoTo),
        4 => edit().prop_map(Deed::Edit),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn it_is_repeated_to_the_bit(deeds in prop::collection::vec(deed(), 1..25)) {
        let mut session = Session::new(busy_scene()).unwrap();
        for deed in deeds {
            // Refused and failed operations belong to the session, too.
            let _ = match deed {
                Deed::Steps(frames) => (0..frames).try_for_each(|_| session.step()),
                Deed::Edit(edit) => session.edit(edit),
                Deed::GoTo(frame) => {
                    session.seek(frame);
                    session.advance_seek(u64::MAX).map(drop)
                }
            };
        }
        assert_repeats(&session);
    }
}
