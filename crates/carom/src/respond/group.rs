//! placeholder until merged
use super::ImpactLaw;
use glam::DVec3;
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TouchingContact {
    pub first: Option<usize>,
    pub second: usize,
    pub normal: DVec3,
    pub surface_velocity: DVec3,
    pub restitution: f64,
}
pub struct GroupResponse {
    pub impulses: Vec<f64>,
    pub demanded_energy_change: f64,
}
pub fn resolve(
    _law: ImpactLaw,
    contacts: &[TouchingContact],
    masses: &[f64],
    v: &mut [DVec3],
) -> GroupResponse {
    let mut impulses = vec![0.0; contacts.len()];
    for _ in 0..1000 {
        let mut any = false;
        for (k, c) in contacts.iter().enumerate() {
            let v1 = c.first.map_or(c.surface_velocity, |f| v[f]);
            let u = (v[c.second] - v1).dot(c.normal);
            if u < -1e-14 {
                any = true;
                let w = 1.0 / masses[c.second] + c.first.map_or(0.0, |f| 1.0 / masses[f]);
                let p = -(1.0 + c.restitution) * u / w;
                impulses[k] += p;
                v[c.second] += p / masses[c.second] * c.normal;
                if let Some(f) = c.first {
                    v[f] -= p / masses[f] * c.normal;
                }
            }
        }
        if !any {
            break;
        }
    }
    GroupResponse { impulses, demanded_energy_change: 0.0 }
}
pub fn contact_forces(
    contacts: &[TouchingContact],
    masses: &[f64],
    a: &[DVec3],
    bias: &[f64],
) -> Vec<f64> {
    let mut f = vec![0.0f64; contacts.len()];
    let mut a = a.to_vec();
    for _ in 0..2000 {
        for (k, c) in contacts.iter().enumerate() {
            let a1 = c.first.map_or(DVec3::ZERO, |f| a[f]);
            let w = 1.0 / masses[c.second] + c.first.map_or(0.0, |f| 1.0 / masses[f]);
            let u = (a[c.second] - a1).dot(c.normal) + bias[k];
            let new = (f[k] - u / w).max(0.0);
            let d = new - f[k];
            f[k] = new;
            a[c.second] += d / masses[c.second] * c.normal;
            if let Some(o) = c.first {
                a[o] -= d / masses[o] * c.normal;
            }
        }
    }
    f
}
