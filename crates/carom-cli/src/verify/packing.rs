//! Random packings: packing fraction of balls that settled under gravity, and number of contacts
//! per ball.

use carom::{BodyPair, Contact, DVec3, Error, Rule, World};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};
use super::dense;
use super::grains::{add_floor, add_shaft, empty, fill, grain, settle, top};

/// Diameter of a ball \[m\]. It is large, so that sub-steps are short compared with the fall by a
/// diameter: a packing without friction has the fewest possible contacts, and errors of the
/// sub-steps keep it moving.
const DIAMETER: f64 = 1.0;
/// Distance from walls, floor and surface beyond which they cause no layers, in diameters.
const AWAY: f64 = 3.0;
/// Spacing of the points that are tested for balls, in diameters.
const MESH: f64 = 0.04;

/// Numbers of balls in the boxes whose packing fractions are averaged.
const BOXES: [usize; 3] = [2_900, 3_000, 3_100];

const STATISTICS: &str = "0.005 between boxes that differ by chance, of which the mean of three is taken, and the way of \
     settling: isotropic in the source";

pub fn claims() -> Vec<Claim> {
    let claims = vec![
        Claim::new(
            "balls with mu = 0.3 that have settled: packing fraction",
            Expected::value(0.593, "Agnolin and Roux, Phys. Rev. E 76, 061302 (2007)"),
            Tolerance::absolute(0.01, STATISTICS),
            |_| fraction(14.0, 0.3, 10.0),
        ),
        Claim::new(
            "balls without friction that have settled: packing fraction",
            Expected::value(
                0.639,
                "Agnolin and Roux (2007); under gravity 0.637: Faure et al., ESAIM Proc. 28, 13 (2009)",
            ),
            Tolerance::absolute(0.01, STATISTICS),
            |_| fraction(14.0, 0.0, 60.0),
        )
        .slow(),
        Claim::new(
            "balls without friction that have settled: contacts for each",
            Expected::value(3.0, "isostatic: Silbert et al., Phys. Rev. E 65, 031304 (2002)"),
            Tolerance::relative(
                0.03,
                "overlaps of up to 0.0005 diameters close 2 % more: Donev et al. (2005), 11 x^0.6",
            ),
            |_| contacts_for_each(),
        )
        .slow(),
        Claim::new(
            "contacts of each ball fall from 6 with mu, but stay above 4 [steps that are so]",
            Expected::value(4.0, "Silbert et al., Phys. Rev. E 65, 031304 (2002)"),
            Tolerance::none("they fall or do not"),
            |_| contacts_by_friction(),
        )
        .slow(),
    ];
    let settled = claims.into_iter().map(|claim| claim.about(Rule::Contact(Contact::default())));
    settled.chain(dense::packings()).collect()
}

/// Lets balls settle in a box of this width \[diameters\].
fn settled(count: usize, width: f64, mu: f64, time: f64) -> Result<World, Error> {
    let mut world = empty()?;
    add_floor(&mut world, mu)?;
    add_shaft(&mut world, width * DIAMETER, mu)?;
    fill(&mut world, grain(DIAMETER, mu), count, width * DIAMETER)?;
    settle(&mut world, time)?;
    Ok(world)
}

/// Mean packing fraction of several boxes. The state is that of the last box.
fn fraction(width: f64, mu: f64, time: f64) -> Outcome {
    let (mut sum, mut world) = (0.0, World::default());
    for count in BOXES {
        world = settled(count, width, mu, time)?;
        sum += packing_fraction(&world, Region::away_from_walls(&world, width));
    }
    Ok(Measured::in_world(&world, sum / BOXES.len() as f64))
}

/// Number of contacts, including those with walls and floor, per ball.
fn contacts_for_each() -> Outcome {
    let count = 1_000;
    let world = settled(count, 10.0, 0.0, 60.0)?;
    Ok(Measured::in_world(&world, world.contacts().len() as f64 / count as f64))
}

/// Counts the decreases of the number of contacts, from 6 over increasing friction to 4.
fn contacts_by_friction() -> Outcome {
    let (mut last, mut steps, mut worlds) = (6.0, 0, Vec::new());
    for mu in [0.1, 0.3, 1.0] {
        let world = settled(2_000, 12.0, mu, 10.0)?;
        let contacts = coordination(&world, Region::away_from_walls(&world, 12.0));
        steps += u32::from(contacts < last);
        last = contacts;
        worlds.push(Measured::in_world(&world, contacts));
    }
    steps += u32::from(4.0 < last);
    Ok(Measured { value: f64::from(steps), ..Measured::sum(worlds) })
}

/// A box-shaped region between two corners.
#[derive(Debug, Clone, Copy)]
struct Region {
    from: DVec3,
    to: DVec3,
}

impl Region {
    /// Region of a box of this width \[diameters\] that is far from walls, floor and surface.
    fn away_from_walls(world: &World, width: f64) -> Self {
        let side = (0.5 * width - AWAY) * DIAMETER;
        let (bottom, top) = (AWAY * DIAMETER, top(world) - AWAY * DIAMETER);
        Self { from: DVec3::new(-side, bottom, -side), to: DVec3::new(side, top, side) }
    }

    fn contains(&self, point: DVec3) -> bool {
        point.cmpge(self.from).all() && point.cmple(self.to).all()
    }
}

/// Fraction of a region that is inside balls, measured at the points of a mesh.
fn packing_fraction(world: &World, region: Region) -> f64 {
    let spheres = world.spheres();
    let cells = ((region.to - region.from) / (MESH * DIAMETER)).floor();
    let mesh = (region.to - region.from) / cells;
    // Indices of the points on an axis within `half` of `middle`.
    let range = |middle: f64, half: f64, axis: usize| {
        let number = |x: f64| (x - region.from[axis]) / mesh[axis] - 0.5;
        let first = number(middle - half).ceil().max(0.0);
        let last = number(middle + half).floor().min(cells[axis] - 1.0);
        first as u32..(last + 1.0).max(0.0) as u32
    };
    let from_middle = |number: u32, middle: f64, axis: usize| {
        region.from[axis] + (f64::from(number) + 0.5) * mesh[axis] - middle
    };
    let mut filled = 0;
    for (&center, &radius) in spheres.positions().iter().zip(spheres.radii()) {
        for i in range(center.x, radius, 0) {
            let x = from_middle(i, center.x, 0);
            let half = (radius * radius - x * x).max(0.0).sqrt();
            for j in range(center.y, half, 1) {
                let y = from_middle(j, center.y, 1);
                let half = (radius * radius - x * x - y * y).max(0.0).sqrt();
                filled += range(center.z, half, 2).len();
            }
        }
    }
    filled as f64 / (cells.x * cells.y * cells.z)
}

/// Mean number of contacts with a force, over the balls in a region.
fn coordination(world: &World, region: Region) -> f64 {
    let spheres = world.spheres();
    let is_inside: Vec<bool> =
        spheres.positions().iter().map(|&position| region.contains(position)).collect();
    let count = is_inside.iter().filter(|&&inside| inside).count();
    let mut ends = 0;
    for contact in world.contacts() {
        let ids = match contact.between {
            BodyPair::Spheres(first, second) => [Some(first), Some(second)],
            BodyPair::Collider { sphere, .. } => [Some(sphere), None],
        };
        let indices = ids.into_iter().flatten().filter_map(|id| spheres.index_of(id));
        ends += indices.filter(|&index| is_inside[index]).count();
    }
    ends as f64 / count as f64
}
