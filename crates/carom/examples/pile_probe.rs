use carom::*;
fn arg(k: &str, d: f64) -> f64 {
    std::env::args().find_map(|a| a.strip_prefix(&format!("{k}=")).map(|v| v.parse().unwrap())).unwrap_or(d)
}
fn main() -> Result<(), Error> {
    let n = arg("n", 2000.0) as usize;
    let (mu, e, frames) = (arg("mu", 0.0), arg("e", 0.0), arg("frames", 600.0) as usize);
    let contact = Contact::default().with_sub_steps(arg("s", 8.0) as u32).with_sweeps(arg("k", 2.0) as u32).with_converged(arg("conv", 0.0) > 0.0);
    let mut world = World::new(Settings::default().with_rule(contact))?;
    world.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0)))?;
    let side = (n as f64).cbrt() * 0.8 - 1e-9;
    let side = side.ceil() as usize;
    let l = side as f64 * 1.05;
    let planes = [(DVec3::Y, DVec3::ZERO), (DVec3::X, DVec3::ZERO), (DVec3::NEG_X, DVec3::X * l), (DVec3::Z, DVec3::ZERO), (DVec3::NEG_Z, DVec3::Z * l)];
    for (normal, point) in planes {
        let pose = Pose::at(point).rotated(DQuat::from_rotation_arc(DVec3::Y, normal));
        let mut c = Collider::new(Shape::HalfSpace, pose).with_restitution(1.0);
        if mu > 0.0 { c = c.with_friction(mu); }
        world.add_collider(c)?;
    }
    for i in 0..n {
        let (k, r) = (i / (side * side), i % (side * side));
        let s = 0.05 * (k % 2) as f64;
        let p = DVec3::new(0.5 + (r % side) as f64 * 1.05 + s, 0.6 + k as f64 * 1.05, 0.5 + (r / side) as f64 * 1.05 + s);
        let mut sphere = Sphere::new(p, 0.5).with_restitution(e);
        if mu > 0.0 { sphere = sphere.with_friction(mu); }
        world.add_sphere(sphere)?;
    }
    let (mut worst, mut searches, mut gain, mut corr, mut imp, mut limited) = (0.0f64, 0, 0.0f64, 0.0, 0.0, 0);
    let mut times = vec![];
    let mut energy = world.total_energy();
    let (mut residual, mut contacts) = (0.0, 0);
    for f in 0..frames {
        let t = std::time::Instant::now();
        let report = world.step(1.0 / 60.0)?;
        times.push(t.elapsed().as_secs_f64() * 1e3);
        let a = report.contact_account;
        worst = worst.max(2.0 * a.largest_overlap);
        searches += report.work.searches; corr += a.correction_work; imp += a.impulse_work; limited += a.limited_sub_steps;
        (residual, contacts) = (a.residual, report.work.contacts);
        let e2 = world.total_energy();
        gain = gain.max(e2 - energy);
        energy = e2;
        if arg("trace", 0.0) > 0.0 && (f + 1) % arg("trace", 0.0) as usize == 0 {
            let rms = (world.spheres().velocities().iter().map(|v| v.length_squared()).sum::<f64>() / n as f64).sqrt();
            println!("{} rms {rms:.2e} E {energy:.2} overlap {:.4} worst {worst:.4} gain {gain:.3e} searches {searches} residual {residual:.1e} contacts {} limited {limited}", f + 1, 2.0 * a.largest_overlap, contacts as f64 / n as f64);
        }
    }
    let rms = (world.spheres().velocities().iter().map(|v| v.length_squared()).sum::<f64>() / n as f64).sqrt();
    let overlap = world.overlaps(0.0).iter().map(|o| o.depth).fold(0.0, f64::max) / 0.5;
    let total: f64 = times.iter().sum();
    let last: f64 = times[frames - 100.min(frames)..].iter().sum::<f64>() / 100.min(frames) as f64;
    println!("n {n} mean {:.3} last100 {last:.3} ms | overlap/r end {overlap:.5} worst {worst:.4} | rms {rms:.2e} | searches {searches} contacts {:.2} | max frame gain {gain:.3e} impulses {imp:.2} corrections {corr:.3} limited {limited} residual {residual:.1e} | hash {}", total / frames as f64, contacts as f64 / n as f64, world.state_hash());
    Ok(())
}
