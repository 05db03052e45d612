//! The command `recover`: completes files that killed runs left unfinished.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use carom_gltf::recover_animation;
use carom_scene::recording::{self, ParticleFormat, Recovered, RecoveryError};
use carom_scene::unfinished;

use crate::args::Recover;
use crate::failure::Failure;

/// Creates the complete file of an unfinished one, and prints a line about it.
pub fn recover(args: &Recover) -> Result<(), Failure> {
    let is_table = args.file.extension().is_some_and(|it| it.eq_ignore_ascii_case("csv"));
    if is_table && args.out.is_none() && args.file.is_file() {
        return table(&args.file);
    }
    let particles = ParticleFormat::of(&args.file);
    if let Some(format) = particles.filter(|_| args.out.is_none() && args.file.is_file()) {
        let cut = recording::recover_particles(&args.file, format).map_err(refused)?;
        return tell_cut(&args.file, "frame", cut);
    }
    let (unfinished, target) = places(args)?;
    args.replacing.check([target.as_path()])?;
    let recovered = match recording::recover(&unfinished, &target) {
        Err(RecoveryError::Foreign { .. }) => match recover_animation(&unfinished, &target) {
            Err(RecoveryError::Foreign { .. }) => film(&unfinished, &target),
            recovered => recovered.map_err(refused),
        },
        recovered => recovered.map_err(refused),
    };
    Ok(tell(&unfinished, &target, recovered?)?)
}

/// Completes a film.
#[cfg(feature = "pictures")]
fn film(unfinished: &Path, target: &Path) -> Result<Recovered, Failure> {
    carom_render::recover_film(unfinished, target).map_err(refused)
}

#[cfg(not(feature = "pictures"))]
fn film(unfinished: &Path, _target: &Path) -> Result<Recovered, Failure> {
    let name = unfinished.display();
    let text = format!("{name} is no unfinished recording; films need the feature `pictures`");
    Err(Failure::Usage(text))
}

/// Returns the unfinished file and the target; refuses if they are the same file.
fn places(args: &Recover) -> Result<(PathBuf, PathBuf), Failure> {
    let (unfinished, target) = named(args)?;
    let is_same = match (unfinished.canonicalize(), target.canonicalize()) {
        (Ok(unfinished), Ok(target)) => unfinished == target,
        _ => false,
    };
    if is_same {
        let name = target.display();
        let text = format!("{name} is the unfinished file itself; name another one by --out");
        return Err(Failure::Usage(text));
    }
    Ok((unfinished, target))
}

/// Returns the unfinished file that the arguments name, and the target.
fn named(args: &Recover) -> Result<(PathBuf, PathBuf), Failure> {
    let Recover { file, out, .. } = args;
    if let Some(target) = unfinished::target_of(file) {
        return Ok((file.clone(), out.clone().unwrap_or(target)));
    }
    let name = file.display();
    match (unfinished::beside(file).as_slice(), out) {
        (_, Some(out)) if file.is_file() => Ok((file.clone(), out.clone())),
        ([one], _) => Ok((one.clone(), out.clone().unwrap_or_else(|| file.clone()))),
        ([], _) => {
            let text = format!("there is nothing to recover for {name}: no {name}.0.unfinished");
            Err(Failure::Usage(text))
        }
        (several, _) => {
            let several: Vec<_> = several.iter().map(|it| it.display().to_string()).collect();
            let text = format!("{} could become {name}: name one of them", several.join(", "));
            Err(Failure::Usage(text))
        }
    }
}

/// Removes the last line of a table if it is incomplete.
fn table(path: &Path) -> Result<(), Failure> {
    let cut = recording::recover_table(path).map_err(refused)?;
    tell_cut(path, "line", cut)
}

/// Says how many bytes of an incomplete last part of a file were removed.
fn tell_cut(path: &Path, part: &str, cut: u64) -> Result<(), Failure> {
    let name = path.display();
    let mut out = io::stdout().lock();
    match cut {
        0 => writeln!(out, "{name}: all {part}s are whole")?,
        cut => {
            writeln!(out, "{name}: the last {part} was cut short; its {cut} bytes are taken out")?;
        }
    }
    Ok(())
}

fn tell(unfinished: &Path, target: &Path, recovered: Recovered) -> io::Result<()> {
    let Recovered { frames, last, left_out, is_damaged } = recovered;
    let until = last.map(|last| format!(", up to {last} s")).unwrap_or_default();
    let rest = match (left_out, is_damaged) {
        (0, _) => String::new(),
        (bytes, false) => format!("; {bytes} bytes of a frame that was cut short are left out"),
        (bytes, true) => {
            let place = unfinished.display();
            format!("; {bytes} bytes after that are damaged, and stay in {place}")
        }
    };
    writeln!(io::stdout().lock(), "{}: {frames} frames{until}{rest}", target.display())
}

fn refused(error: RecoveryError) -> Failure {
    match error {
        RecoveryError::Unwritable { .. } => Failure::Fault(error.to_string()),
        _ => Failure::Usage(error.to_string()),
    }
}
