//! Integrals over time by the quadrature of Gauss and Legendre.

/// Nodes in `[-1, 1]` and weights of the Gauss-Legendre quadrature of order 16, each for both signs of the node.
///
/// Source: Abramowitz and Stegun, *Handbook of Mathematical Functions*, table 25.4.
const QUADRATURE: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_48],
    [0.960_289_856_497_536_3, 0.101_228_536_290_376_26],
];

/// Integrates a function of time over a range.
pub(crate) fn integral([from, to]: [f64; 2], function: impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let terms = QUADRATURE.iter().map(|&[node, weight]| {
        weight * (function(middle - half * node) + function(middle + half * node))
    });
    half * terms.sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quadrature_integrates_polynomials_up_to_the_fifteenth_degree() {
        for degree in 0..16 {
            let found = integral([0.5, 2.0], |t| libm::pow(t, f64::from(degree)));
            let power = f64::from(degree + 1);
            let exact = (libm::pow(2.0, power) - libm::pow(0.5, power)) / power;
            // Rounding of eight terms.
            assert!((found - exact).abs() < 1e-14 * exact, "{degree}: {found} {exact}");
        }
    }
}
