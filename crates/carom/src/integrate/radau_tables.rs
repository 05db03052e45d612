//! Constant tables of the Gauss-Radau quadrature of order 15, made by the compiler.

use crate::polynomial_flight::TERMS;

/// Nodes of the Gauss-Radau quadrature of order 15 on `[0, 1]`.
pub(crate) const NODES: [f64; TERMS] = [
    0.0,
    0.056_262_560_536_922_15,
    0.180_240_691_736_892_36,
    0.352_624_717_113_169_6,
    0.547_153_626_330_555_4,
    0.734_210_177_215_410_5,
    0.885_320_946_839_095_8,
    0.977_520_613_561_287_5,
];

/// Nodes that include the end of a step: [`NODES`] as seen from there.
pub(crate) const END_NODES: [f64; TERMS] = reversed(NODES);

/// Powers of s in `s (s - h_1) ... (s - h_(n-1))`, by n.
pub(super) const NEWTON: Table = newton_basis(NODES);
/// [`NEWTON`] of the nodes that include the end.
pub(super) const END_NEWTON: Table = newton_basis(END_NODES);

/// Gains by node: the way, divided by the square of the time, and the velocity, divided by the
/// time, that a unit of each term of the acceleration adds.
pub(super) const GAINS: [Gains; TERMS] = gains_at_nodes(NODES);
/// [`GAINS`] at the nodes that include the end.
pub(super) const END_GAINS: [Gains; TERMS] = gains_at_nodes(END_NODES);
/// [`GAINS`] at the end of a step.
pub(super) const GAINS_AT_END: Gains = gains_at(1.0);
/// `1/(h_n - h_k)` by n and k < n.
pub(super) const RECIPROCALS: Table = reciprocals();
/// Way, divided by the square of the time of the step, that a unit of the acceleration at each node
/// adds at each of the [`END_NODES`]; `END_VELOCITIES` has the velocity, divided by that time.
pub(crate) const END_WAYS: Table = integrals_of_nodes(0);
pub(crate) const END_VELOCITIES: Table = integrals_of_nodes(1);

pub(crate) type Table = [[f64; TERMS]; TERMS];

/// `s^k/((k + 1)(k + 2))` and `s^k/(k + 1)`, by k.
pub(super) type Gains = [[f64; 2]; TERMS];

const fn gains_at(s: f64) -> Gains {
    let mut gains = [[0.0; 2]; TERMS];
    let (mut power, mut k) = (1.0, 0);
    while k < TERMS {
        let order = k as f64;
        gains[k] = [power / ((order + 1.0) * (order + 2.0)), power / (order + 1.0)];
        power *= s;
        k += 1;
    }
    gains
}

const fn gains_at_nodes(nodes: [f64; TERMS]) -> [Gains; TERMS] {
    let mut gains = [[[0.0; 2]; TERMS]; TERMS];
    let mut node = 0;
    while node < TERMS {
        gains[node] = gains_at(nodes[node]);
        node += 1;
    }
    gains
}

const fn reciprocals() -> Table {
    let mut table = [[0.0; TERMS]; TERMS];
    let mut n = 1;
    while n < TERMS {
        let mut k = 0;
        while k < n {
            table[n][k] = 1.0 / (NODES[n] - NODES[k]);
            k += 1;
        }
        n += 1;
    }
    table
}

const fn newton_basis(nodes: [f64; TERMS]) -> Table {
    let mut basis = [[0.0; TERMS]; TERMS];
    basis[0][0] = 1.0;
    let mut n = 1;
    while n < TERMS {
        let mut k = 0;
        while k < TERMS {
            let raised = if k > 0 { basis[n - 1][k - 1] } else { 0.0 };
            basis[n][k] = raised - nodes[n - 1] * basis[n - 1][k];
            k += 1;
        }
        n += 1;
    }
    basis
}

const fn reversed(nodes: [f64; TERMS]) -> [f64; TERMS] {
    let mut others = [0.0; TERMS];
    let mut node = 0;
    while node < TERMS {
        others[node] = 1.0 - nodes[TERMS - 1 - node];
        node += 1;
    }
    others
}

/// The integrals of the acceleration that is 1 at one of [`END_NODES`] and 0 at the others, up to each of them: the
/// way for `which` = 0, the velocity for 1.
const fn integrals_of_nodes(which: usize) -> Table {
    let mut table = [[0.0; TERMS]; TERMS];
    let mut other = 0;
    while other < TERMS {
        let powers = lagrange_basis(other);
        let mut node = 0;
        while node < TERMS {
            let (mut sum, mut k) = (0.0, 0);
            while k < TERMS {
                sum += END_GAINS[node][k][which] * powers[k];
                k += 1;
            }
            let s = END_NODES[node];
            table[node][other] = if which == 0 { s * s * sum } else { s * sum };
            node += 1;
        }
        other += 1;
    }
    table
}

/// Powers of s in the polynomial that is 1 at one of [`END_NODES`] and 0 at the others.
const fn lagrange_basis(own: usize) -> [f64; TERMS] {
    let mut powers = [0.0; TERMS];
    powers[0] = 1.0;
    let mut other = 0;
    while other < TERMS {
        if other != own {
            let distance = END_NODES[own] - END_NODES[other];
            let mut k = TERMS;
            while k > 0 {
                k -= 1;
                let raised = if k > 0 { powers[k - 1] } else { 0.0 };
                powers[k] = (raised - END_NODES[other] * powers[k]) / distance;
            }
        }
        other += 1;
    }
    powers
}
