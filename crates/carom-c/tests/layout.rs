//! The layout of structures and the numbers of constants stay as programs were compiled for. A
//! change here needs a new `CAROM_ABI_VERSION`.

use std::mem::{align_of, offset_of, size_of};

use carom_c::*;

#[test]
fn structures_of_version_3_lie_as_they_did() {
    assert_eq!(CAROM_ABI_VERSION, 3);
    let sizes = [
        size_of::<CaromWorld>(),
        size_of::<CaromSnapshot>(),
        size_of::<CaromSphere>(),
        size_of::<CaromCollider>(),
        size_of::<CaromSphereState>(),
        size_of::<CaromAdded>(),
        size_of::<CaromBodyPair>(),
        size_of::<CaromImpact>(),
        size_of::<CaromContact>(),
        size_of::<CaromTrigger>(),
        size_of::<CaromOverlap>(),
        size_of::<CaromTotals>(),
        size_of::<CaromReport>(),
    ];
    assert_eq!(sizes, [8, 8, 176, 192, 64, 64, 24, 128, 120, 64, 32, 72, 96]);
    assert_eq!(size_of::<CaromForce>(), 4 * size_of::<usize>());
    assert_eq!((align_of::<CaromSphere>(), align_of::<CaromCollider>()), (8, 8));
    let sphere = [
        offset_of!(CaromSphere, radius),
        offset_of!(CaromSphere, density),
        offset_of!(CaromSphere, tangential_restitution),
        offset_of!(CaromSphere, inertia_factor),
    ];
    assert_eq!(sphere, [48, 64, 104, 168]);
    let collider = [
        offset_of!(CaromCollider, radius),
        offset_of!(CaromCollider, rotation),
        offset_of!(CaromCollider, restitution),
    ];
    assert_eq!(collider, [16, 72, 152]);
    let impact = [offset_of!(CaromImpact, point), offset_of!(CaromImpact, tangential_impulse)];
    assert_eq!(impact, [32, 104]);
    let of_queries = [
        size_of::<CaromQueryFilter>(),
        size_of::<CaromRay>(),
        size_of::<CaromMovingSphere>(),
        size_of::<CaromHit>(),
        size_of::<CaromNearBody>(),
        size_of::<CaromSensorEvent>(),
        size_of::<CaromPath>(),
        size_of::<CaromPathLeg>(),
    ];
    assert_eq!(of_queries, [32, 48, 56, 72, 72, 88, 8, 104]);
    assert_eq!([size_of::<CaromSpring>(), size_of::<CaromKeyframe>()], [72, 64]);
    assert_eq!(size_of::<CaromMesh>(), 4 * size_of::<usize>() + 8);
    let accounts = [
        size_of::<CaromEnergyAccount>(),
        size_of::<CaromStageCounts>(),
        size_of::<CaromContactAccount>(),
        size_of::<CaromZoneAccount>(),
        size_of::<CaromStrike>(),
        size_of::<CaromImpactGroup>(),
    ];
    assert_eq!(accounts, [80, 72, 40, 40, 48, 104]);
    let spring = [offset_of!(CaromSpring, to_point), offset_of!(CaromSpring, rest_length)];
    assert_eq!(spring, [16, 48]);
}

#[test]
fn constants_of_version_3_are_what_they_were() {
    assert_eq!(CaromStatus::Panic as i32, 14);
    assert_eq!(CaromQuantity::AppliedForces as i32, 12);
    assert_eq!(CaromShape::Other as i32, 5);
    assert_eq!(CaromSide::Front as i32, 32);
    assert_eq!(CaromList::LeftOut as i32, 6);
    assert_eq!(CaromList::Springs as i32, 7);
    assert_eq!(CaromPathEnd::NoClosedForm as i32, 2);
}
