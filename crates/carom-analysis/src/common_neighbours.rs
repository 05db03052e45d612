//! Crystal structures by common neighbours.
//!
//! Sources: J. D. Honeycutt and H. C. Andersen, J. Phys. Chem. 91, 4950 (1987); D. Faken and H.
//! Jónsson, Comput. Mater. Sci. 2, 279 (1994); distances that adapt to each point: A. Stukowski,
//! Modelling Simul. Mater. Sci. Eng. 20, 045021 (2012).

use crate::neighbours::{Bond, Neighbours};

/// Structure around a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Structure {
    /// None of the others.
    Other,
    /// Face-centred cubic.
    FaceCentered,
    /// Hexagonal close-packed.
    HexagonalClosePacked,
    /// Body-centred cubic.
    BodyCentered,
    /// Icosahedral.
    Icosahedral,
}

/// Finds the structure around each point from all its neighbours, two of which are bonded if they
/// are nearer to each other than `distance` \[m\].
pub fn structures_within(neighbours: &Neighbours, distance: f64) -> Vec<Structure> {
    let squared = distance * distance;
    (0..neighbours.len()).map(|point| structure(neighbours.of(point), squared)).collect()
}

/// Finds the structure around each point from the nearest 12 or 14 neighbours, with a distance that
/// adapts to theirs. A point with fewer neighbours is [`Structure::Other`].
pub fn adaptive_structures(neighbours: &Neighbours) -> Vec<Structure> {
    (0..neighbours.len()).map(|point| adaptive(neighbours.of(point))).collect()
}

fn adaptive(bonds: &[Bond]) -> Structure {
    let mean = |bonds: &[Bond]| {
        bonds.iter().map(|bond| bond.squared_distance.sqrt()).sum::<f64>() / bonds.len() as f64
    };
    // Half way between the first and the second shell of fcc, at 1 and √2.
    let half_way = 0.5 * (1.0 + 2_f64.sqrt());
    if let Some(bonds) = bonds.get(..12) {
        let distance = half_way * mean(bonds);
        let found = structure(bonds, distance * distance);
        if found != Structure::Other {
            return found;
        }
    }
    let Some((near, far)) = bonds.get(..14).map(|bonds| bonds.split_at(8)) else {
        return Structure::Other;
    };
    // The edge of the cube, from both shells of bcc: at √3/2 and 1.
    let edge = (8.0 * mean(near) * 2.0 / 3_f64.sqrt() + 6.0 * mean(far)) / 14.0;
    let distance = half_way * edge;
    structure(&bonds[..14], distance * distance)
}

/// Names the structure of neighbours by the signatures of their bonds.
fn structure(bonds: &[Bond], squared: f64) -> Structure {
    if !matches!(bonds.len(), 12 | 14) {
        return Structure::Other;
    }
    // Bit k of mask i: the neighbours i and k are bonded.
    let masks: Vec<u32> = bonds
        .iter()
        .enumerate()
        .map(|(i, one)| {
            let is_bonded = |(k, other): (usize, &Bond)| k != i && are_near(one, other, squared);
            let all = bonds.iter().enumerate().filter(|&it| is_bonded(it));
            all.fold(0, |mask, (k, _)| mask | 1 << k)
        })
        .collect();
    let signatures: Vec<[u32; 3]> = masks.iter().map(|&common| signature(common, &masks)).collect();
    let count = |wanted: [u32; 3]| signatures.iter().filter(|it| **it == wanted).count();
    let counts = [[4, 2, 1], [4, 2, 2], [4, 4, 4], [6, 6, 6], [5, 5, 5]].map(count);
    match (bonds.len(), counts) {
        (12, [12, ..]) => Structure::FaceCentered,
        (12, [6, 6, ..]) => Structure::HexagonalClosePacked,
        (12, [.., 12]) => Structure::Icosahedral,
        (14, [_, _, 6, 8, _]) => Structure::BodyCentered,
        _ => Structure::Other,
    }
}

fn are_near(one: &Bond, other: &Bond, squared: f64) -> bool {
    let apart = [0, 1, 2].map(|axis| other.vector[axis] - one.vector[axis]);
    apart.iter().map(|it| it * it).sum::<f64>() < squared
}

/// Number of common neighbours, of bonds among them, and of bonds in the longest chain of these.
fn signature(common: u32, masks: &[u32]) -> [u32; 3] {
    let members = || (0..masks.len()).filter(move |k| common >> k & 1 == 1);
    let bonds = members().map(|k| (masks[k] & common).count_ones()).sum::<u32>() / 2;
    let (mut left, mut longest) = (common, 0);
    // As in the sources, a chain is a connected set of bonds.
    while left != 0 {
        let mut chain = 1 << left.trailing_zeros();
        loop {
            let members = (0..masks.len()).filter(|k| chain >> k & 1 == 1);
            let grown = members.fold(chain, |mask, k| mask | masks[k] & common);
            if grown == chain {
                break;
            }
            chain = grown;
        }
        let members = (0..masks.len()).filter(|k| chain >> k & 1 == 1);
        longest = longest.max(members.map(|k| (masks[k] & chain).count_ones()).sum::<u32>() / 2);
        left &= !chain;
    }
    [common.count_ones(), bonds, longest]
}
