//! Scenes built in code: the same scene with several restitutions, and the energy that remains.

use carom_scene::{Library, Override};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let library = Library::new();
    println!("{:>12} {:>9} {:>12}", "restitution", "impacts", "energy [J]");
    for restitution in [0.2, 0.4, 0.6, 0.8, 1.0] {
        let change: Override = format!("colliders.1.restitution={restitution}").parse()?;
        let (scene, _) = library.find("simtest1", &[change])?;
        let mut world = scene.world()?;
        let mut impacts = 0;
        while world.time() < 5.0 {
            impacts += world.step(scene.simulation.frame_time)?.impacts.len();
        }
        println!("{restitution:12.1} {impacts:9} {:12.3}", world.total_energy());
    }
    Ok(())
}
