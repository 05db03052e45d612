//! The worlds that a call names.

use numpy::PyReadonlyArray1;

use crate::failure::Failure;

/// Indices of worlds from Python; `None` for all.
pub type Given<'py> = Option<PyReadonlyArray1<'py, i64>>;

/// Returns the given indices, of `count` worlds.
///
/// # Errors
/// [`Failure`] for an index without a world.
pub fn selected(worlds: &Given<'_>, count: usize) -> Result<Vec<usize>, Failure> {
    let Some(worlds) = worlds else { return Ok((0..count).collect()) };
    let known = |&world: &i64| {
        let index = usize::try_from(world).ok().filter(|&index| index < count);
        let problem = format_args!("must be below {count}, not {world}");
        index.ok_or_else(|| Failure::value("worlds", problem))
    };
    worlds.as_array().iter().map(known).collect()
}
