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

/// Powers of s in `s (s - h_1) ... (s - h_(n-1))`, by n.
pub(super) const NEWTON: [[f64; TERMS]; TERMS] = newton_basis();

/// Gains by node: the way, divided by the square of the time, and the velocity, divided by the
/// time, that a unit of each term of the acceleration adds.
pub(super) const GAINS: [Gains; TERMS] = gains_at_nodes();
/// [`GAINS`] at the end of a step.
pub(super) const GAINS_AT_END: Gains = gains_at(1.0);
/// `1/(h_n - h_k)` by n and k < n.
pub(super) const RECIPROCALS: [[f64; TERMS]; TERMS] = reciprocals();

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

const fn gains_at_nodes() -> [Gains; TERMS] {
    let mut gains = [[[0.0; 2]; TERMS]; TERMS];
    let mut node = 0;
    while node < TERMS {
        gains[node] = gains_at(NODES[node]);
        node += 1;
    }
    gains
}

const fn reciprocals() -> [[f64; TERMS]; TERMS] {
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

const fn newton_basis() -> [[f64; TERMS]; TERMS] {
    let mut basis = [[0.0; TERMS]; TERMS];
    basis[0][0] = 1.0;
    let mut n = 1;
    while n < TERMS {
        let mut k = 0;
        while k < TERMS {
            let raised = if k > 0 { basis[n - 1][k - 1] } else { 0.0 };
            basis[n][k] = raised - NODES[n - 1] * basis[n - 1][k];
            k += 1;
        }
        n += 1;
    }
    basis
}
