//! Queries of a world between steps, many in one call.

// Python shows these comments as docstrings, with units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

use carom::{DVec3, Groups, Queries, QueryFilter, SphereId};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::engine::Engine;
use crate::failure::Failure;
use crate::inner::Inner;
use crate::stop::Watch;
use crate::tables::Table;

type Vectors<'py> = PyReadonlyArray2<'py, f64>;
type Numbers<'py> = PyReadonlyArray1<'py, f64>;
type Words<'py> = Bound<'py, PyArray1<u64>>;

/// [`QueryFilter`], read from the attributes of Python's `QueryFilter`.
#[derive(FromPyObject)]
struct Filter {
    spheres: bool,
    colliders: bool,
    triggers: bool,
    without_sphere: Option<u64>,
    groups: u32,
    collides_with: u32,
}

impl From<Filter> for QueryFilter {
    fn from(given: Filter) -> Self {
        let groups = Groups { groups: given.groups, collides_with: given.collides_with };
        let filter = Self::default()
            .with_spheres(given.spheres)
            .with_colliders(given.colliders)
            .with_triggers(given.triggers)
            .with_groups(groups);
        let sphere = given.without_sphere.map(SphereId::from_number);
        sphere.map_or(filter, |sphere| filter.without_sphere(sphere))
    }
}

/// Queries. Other threads run meanwhile, and Ctrl-C stops them.
#[pymethods]
impl Engine {
    /// Casts rays from `origins` along `ways` [m], both of shape (n, 3). Returns hits as words.
    #[pyo3(name = "_cast_rays")]
    fn cast_rays<'py>(
        &self,
        py: Python<'py>,
        origins: Vectors<'py>,
        ways: Vectors<'py>,
        filter: Filter,
    ) -> PyResult<Words<'py>> {
        let (origins, ways, filter) = (rows(&origins)?, rows(&ways)?, filter.into());
        self.query(py, ("rays", origins.len()), |queries, row, table| {
            table.push_hit(queries.cast_ray(origins[row], ways[row], &filter)?);
            Ok(())
        })
    }

    /// Casts spheres from `centers` along `ways` [m], both of shape (n, 3), with `radii` [m], shape
    /// (n,). Returns hits as words.
    #[pyo3(name = "_cast_spheres")]
    fn cast_spheres<'py>(
        &self,
        py: Python<'py>,
        centers: Vectors<'py>,
        radii: Numbers<'py>,
        ways: Vectors<'py>,
        filter: Filter,
    ) -> PyResult<Words<'py>> {
        let (centers, ways, filter) = (rows(&centers)?, rows(&ways)?, filter.into());
        let radii = radii.to_vec()?;
        self.query(py, ("spheres", centers.len()), |queries, row, table| {
            let hit = queries.cast_sphere(centers[row], radii[row], ways[row], &filter)?;
            table.push_hit(hit);
            Ok(())
        })
    }

    /// Returns the body nearest to each of `points` [m], shape (n, 3), up to `within` [m] away, as
    /// words.
    #[pyo3(name = "_nearest")]
    fn nearest<'py>(
        &self,
        py: Python<'py>,
        points: Vectors<'py>,
        within: f64,
        filter: Filter,
    ) -> PyResult<Words<'py>> {
        let (points, filter) = (rows(&points)?, filter.into());
        self.query(py, ("points", points.len()), |queries, row, table| {
            table.push_near(queries.nearest(points[row], within, &filter)?);
            Ok(())
        })
    }

    /// Returns the bodies that touch or overlap each sphere at `centers` [m], shape (n, 3), with
    /// `radii` [m], shape (n,), as words, each after the row of the sphere.
    #[pyo3(name = "_overlapping")]
    fn overlapping<'py>(
        &self,
        py: Python<'py>,
        centers: Vectors<'py>,
        radii: Numbers<'py>,
        filter: Filter,
    ) -> PyResult<Words<'py>> {
        let (centers, radii, filter) = (rows(&centers)?, radii.to_vec()?, filter.into());
        self.query(py, ("spheres", centers.len()), |queries, row, table| {
            for near in queries.overlapping(centers[row], radii[row], &filter)? {
                table.push_row(row);
                table.push_near(Some(near));
            }
            Ok(())
        })
    }
}

impl Engine {
    /// Asks as many queries as a kind has rows. Returns the table that they fill.
    fn query<'py>(
        &self,
        py: Python<'py>,
        kind: (&str, usize),
        ask: impl Fn(&Queries<'_>, usize, &mut Table) -> Result<(), carom::Error> + Send,
    ) -> PyResult<Words<'py>> {
        let mut guard = self.lock(py)?;
        let inner = &mut *guard;
        let watch = inner.heed_signals();
        let table = py.detach(|| ask_all(inner, kind, &watch, ask));
        drop(guard);
        Ok(PyArray1::from_vec(py, table?.into_words()))
    }
}

/// Asks queries one after another; an error of one of many has its row.
fn ask_all(
    inner: &Inner,
    (kind, count): (&str, usize),
    watch: &Watch,
    ask: impl Fn(&Queries<'_>, usize, &mut Table) -> Result<(), carom::Error>,
) -> Result<Table, Failure> {
    let (mut table, request) = (Table::default(), watch.request());
    let queries = inner.world.queries_for(count);
    for row in 0..count {
        if request.is_made() {
            return Err(carom::Error::Stopped { time: inner.world.time() }.into());
        }
        ask(&queries, row, &mut table).map_err(|error| match count {
            1 => Failure::from(error),
            _ => Failure::from(error).about(&format!("{kind}[{row}]")),
        })?;
    }
    Ok(table)
}

/// Returns the rows of an array of shape (n, 3).
fn rows(vectors: &Vectors<'_>) -> PyResult<Vec<DVec3>> {
    Ok(vectors.to_vec()?.chunks_exact(3).map(DVec3::from_slice).collect())
}
