//! The virial of a sub-step, of which the stress of a box in steady shear is made.

use glam::{DMat3, DVec3};

use crate::report::StepReport;
use crate::rule::contact::slabs::Slab;
use crate::rule::contact::solver::Solver;

/// Tensor J l, whose column k is the impulse J \[N s\] times part k of the way l between the centres \[m\].
pub(crate) fn of_contact(impulse: DVec3, way: DVec3) -> DMat3 {
    DMat3::from_cols(way.x * impulse, way.y * impulse, way.z * impulse)
}

/// Adds the contacts of a sub-step in a box in steady shear, without those of cascades.
pub(crate) fn account(solver: &Solver, report: &mut StepReport) {
    if !solver.kinds.shear {
        return;
    }
    let of_slab = |slab: &Slab| {
        let pressing =
            |&(number, lane, _): &(usize, usize, _)| slab.batches.pairs[number].impulse[lane] > 0.0;
        let of_pair = |(number, lane, slots): (usize, usize, [u32; 2])| {
            let has_landed = slots.map(|slot| solver.landings.has(slab.start + slot as usize));
            if has_landed != [false; 2] {
                return DMat3::ZERO;
            }
            let radius_sum = slab.batches.approaches[number].radius_sum[lane];
            let way = radius_sum * slab.batches.normal(number, lane);
            of_contact(slab.batches.impulse(number, lane), way)
        };
        slab.batches.contacts().filter(pressing).map(of_pair).sum::<DMat3>()
    };
    *report.virial.get_or_insert(DMat3::ZERO) += solver.slabs.iter().map(of_slab).sum::<DMat3>();
}
