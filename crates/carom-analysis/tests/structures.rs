//! Crystals have the orders and structures that are known of them.
#![allow(missing_docs)]

use carom_analysis::{
    Neighbours, Structure, adaptive_structures, bond_order, cluster_labels, structures_within,
};

/// Points of `cells` cubic cells of side 1 along each axis.
fn lattice(cells: usize, basis: &[[f64; 3]]) -> (Vec<[f64; 3]>, [f64; 3]) {
    let mut points = Vec::new();
    for cell in 0..cells.pow(3) {
        let corner = [cell % cells, cell / cells % cells, cell / cells / cells].map(|it| it as f64);
        points.extend(basis.iter().map(|it| [0, 1, 2].map(|axis| corner[axis] + it[axis])));
    }
    (points, [cells as f64; 3])
}

fn face_centered() -> (Vec<[f64; 3]>, [f64; 3]) {
    lattice(4, &[[0.0, 0.0, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [0.5, 0.5, 0.0]])
}

fn body_centered() -> (Vec<[f64; 3]>, [f64; 3]) {
    lattice(5, &[[0.0; 3], [0.5; 3]])
}

#[test]
fn the_order_of_fcc_is_that_of_steinhardt_nelson_and_ronchetti() {
    let (points, sides) = face_centered();
    let neighbours = Neighbours::nearest(&points, sides, 12).unwrap();
    // From the sums of Legendre polynomials over the cuboctahedron.
    for (degree, expected) in [(4, 0.190_940_654), (6, 0.574_524_259)] {
        for is_averaged in [false, true] {
            let found = bond_order(&neighbours, degree, is_averaged);
            for q in found.local.iter().chain([&found.total]) {
                assert!((q - expected).abs() < 1e-9, "degree {degree}: {q}");
            }
        }
    }
}

#[test]
fn every_degree_of_one_bond_is_1() {
    // The harmonics of a direction have the sum of squares 1, by the addition theorem.
    let points = [[0.0; 3], [0.3, -0.7, 0.2]];
    let neighbours = Neighbours::within(&points, [f64::INFINITY; 3], 1.0);
    for degree in 0..=20 {
        let found = bond_order(&neighbours, degree, false);
        assert!((found.local[0] - 1.0).abs() < 1e-12, "degree {degree}: {}", found.local[0]);
    }
}

#[test]
fn common_neighbours_name_fcc_and_bcc_whatever_the_method() {
    let (points, sides) = face_centered();
    let all = Neighbours::within(&points, sides, 0.85);
    assert!(structures_within(&all, 0.85).iter().all(|it| *it == Structure::FaceCentered));
    let nearest = Neighbours::nearest(&points, sides, 14).unwrap();
    assert!(adaptive_structures(&nearest).iter().all(|it| *it == Structure::FaceCentered));
    let (points, sides) = body_centered();
    let all = Neighbours::within(&points, sides, 1.2);
    assert!(structures_within(&all, 1.2).iter().all(|it| *it == Structure::BodyCentered));
    let nearest = Neighbours::nearest(&points, sides, 14).unwrap();
    assert!(adaptive_structures(&nearest).iter().all(|it| *it == Structure::BodyCentered));
}

#[test]
fn nearest_neighbours_that_do_not_exist_are_none() {
    let points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(Neighbours::nearest(&points, [f64::INFINITY; 3], 3), None);
    let found = Neighbours::nearest(&points, [f64::INFINITY; 3], 2).unwrap();
    assert_eq!(found.of(0).iter().map(|bond| bond.to).collect::<Vec<_>>(), [1, 2]);
}

#[test]
fn clusters_are_labelled_by_their_first_points() {
    assert_eq!(cluster_labels(6, &[[5, 2], [4, 1], [2, 4]]), [0, 1, 1, 2, 1, 1]);
    assert_eq!(cluster_labels(0, &[]), [0_usize; 0]);
}
