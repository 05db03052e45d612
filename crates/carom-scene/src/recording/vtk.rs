//! Trajectories for ParaView: a `.vtp` file per frame, and a `.pvd` file that lists them with
//! their times.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use carom::{Boundary, DVec3, World};
use vtkio::model::{
    Attribute, Attributes, ByteOrder, DataSet, PolyDataPiece, Version, VertexNumbers, Vtk,
};

use super::each_second::EachSecond;
use super::format::Format;
use super::rotation::{angular_velocity, orientation};
use super::slide::slide;
use crate::unfinished::create_folders_of;

/// Writes `NAME.pvd`, and `000000.vtp`, `000001.vtp`, ... in the folder `NAME_frames` beside it.
pub(super) struct Series {
    path: PathBuf,
    times: Vec<f64>,
    /// Limits how often the list is written.
    clock: EachSecond,
    /// Whether frames have rotations; the first frame decides.
    has_rotation: bool,
}

impl Series {
    pub fn create(path: &Path) -> io::Result<Self> {
        let series = Self {
            path: path.with_extension("pvd"),
            times: Vec::new(),
            clock: EachSecond::new(),
            has_rotation: false,
        };
        create_folders_of(&series.path)?;
        series.write_list()?;
        std::fs::create_dir_all(series.path.with_file_name(series.folder()))?;
        Ok(series)
    }

    /// Name of the folder of the frames.
    fn folder(&self) -> String {
        format!("{}_frames", self.path.file_stem().unwrap_or_default().to_string_lossy())
    }

    /// Path of the file of a frame, relative to the list.
    fn frame_file(&self, frame: usize) -> String {
        format!("{}/{frame:06}.vtp", self.folder())
    }

    /// Writes the list of all frames so far. The previous list stays complete until the new one
    /// replaces it.
    fn write_list(&self) -> io::Result<()> {
        // A link or a device is written in place, not replaced.
        let replaces = self.path.symlink_metadata().is_ok_and(|it| it.is_file());
        let target =
            if replaces { self.path.with_extension("pvd.unfinished") } else { self.path.clone() };
        let written = self.write_list_to(&target);
        if !replaces {
            return written;
        }
        written
            .and_then(|()| std::fs::rename(&target, &self.path))
            .inspect_err(|_| remove_part(&target))
    }

    fn write_list_to(&self, target: &Path) -> io::Result<()> {
        let mut list = BufWriter::new(File::create(target)?);
        writeln!(list, r#"<?xml version="1.0"?>"#)?;
        writeln!(list, r#"<VTKFile type="Collection" version="0.1">"#)?;
        writeln!(list, "  <Collection>")?;
        for (frame, time) in self.times.iter().enumerate() {
            let file = self.frame_file(frame);
            let file = file.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
            writeln!(list, r#"    <DataSet timestep="{time}" file="{file}"/>"#)?;
        }
        writeln!(list, "  </Collection>\n</VTKFile>")?;
        list.flush()
    }
}

impl Format for Series {
    fn write(&mut self, world: &World) -> io::Result<()> {
        if self.times.is_empty() {
            self.has_rotation = world.has_spin();
        }
        let name = self.frame_file(self.times.len());
        let path = self.path.with_file_name(&name);
        let mut text = Vec::new();
        frame(world, self.has_rotation).write_xml(&mut text).map_err(io::Error::other)?;
        let text = with_box(text, world)?;
        std::fs::write(&path, text).map_err(|error| {
            remove_part(&path);
            io::Error::new(error.kind(), format!("{name}: {error}"))
        })?;
        self.times.push(world.time());
        if self.clock.strikes() { self.write_list() } else { Ok(()) }
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        self.write_list()?;
        // Removes later frames of an earlier, longer series.
        let later = (self.times.len()..).map(|frame| self.frame_file(frame));
        let mut later = later.map(|name| self.path.with_file_name(name));
        while std::fs::remove_file(later.next().unwrap_or_default()).is_ok() {}
        Ok(())
    }
}

/// Adds the periodic box of a world to a frame, as field data with the sides \[m\], 0 along open
/// axes, and under shear how far the box above has slid \[m\]. vtkio writes no field data beside points.
fn with_box(frame: Vec<u8>, world: &World) -> io::Result<Vec<u8>> {
    let Boundary::Periodic { size } = world.settings().boundary else { return Ok(frame) };
    let text = String::from_utf8(frame).map_err(io::Error::other)?;
    let place = text.find("<Piece").ok_or_else(|| io::Error::other("the frame has no piece"))?;
    let sides = size.to_array().map(|side| if side.is_finite() { side } else { 0.0 });
    let [x, y, z] = sides;
    let (before, after) = text.split_at(place);
    let slide = slide(world.settings(), world.time()).map_or(String::new(), |slide| {
        format!("<DataArray type=\"Float64\" Name=\"slide\" NumberOfTuples=\"1\" format=\"ascii\">{slide}</DataArray>")
    });
    Ok(format!(
        "{before}<FieldData><DataArray type=\"Float64\" Name=\"box\" NumberOfTuples=\"1\" \
         NumberOfComponents=\"3\" format=\"ascii\">{x} {y} {z}</DataArray>{slide}</FieldData>{after}"
    )
    .into_bytes())
}

/// Removes a partly written file. Errors are ignored, because an earlier error is being reported.
fn remove_part(path: &Path) {
    if path.symlink_metadata().is_ok_and(|it| it.is_file()) {
        drop(std::fs::remove_file(path));
    }
}

/// Converts the spheres to points with attributes; in ParaView, glyphs of the `diameter` show them.
/// Orientations are quaternions in the order w, x, y, z, as in VTK.
fn frame(world: &World, has_rotation: bool) -> Vtk {
    let spheres = world.spheres();
    let count = spheres.len() as u64;
    let vectors = |values: &[DVec3]| values.iter().flat_map(DVec3::to_array).collect::<Vec<_>>();
    let balls: Vec<u64> = spheres.ids().iter().map(|id| id.number()).collect();
    let diameters: Vec<f64> = spheres.radii().iter().map(|radius| 2.0 * radius).collect();
    let mut point = vec![
        Attribute::scalars("ball", 1).with_data(balls),
        Attribute::scalars("diameter", 1).with_data(diameters),
        Attribute::scalars("mass", 1).with_data(spheres.masses().to_vec()),
        Attribute::vectors("velocity").with_data(vectors(spheres.velocities())),
    ];
    if has_rotation {
        let quaternions = (0..spheres.len()).flat_map(|i| {
            let [x, y, z, w] = orientation(world, i);
            [w, x, y, z]
        });
        let velocities = (0..spheres.len()).flat_map(|i| angular_velocity(world, i));
        let orientations = Attribute::generic("orientation", 4);
        point.push(orientations.with_data(quaternions.collect::<Vec<f64>>()));
        let angular = Attribute::vectors("angular_velocity");
        point.push(angular.with_data(velocities.collect::<Vec<f64>>()));
    }
    let verts =
        VertexNumbers::XML { connectivity: (0..count).collect(), offsets: (1..=count).collect() };
    Vtk {
        version: Version::new(),
        title: String::new(),
        byte_order: ByteOrder::LittleEndian,
        data: DataSet::inline(PolyDataPiece {
            points: vectors(spheres.positions()).into(),
            verts: Some(verts),
            data: Attributes { point, cell: Vec::new() },
            ..PolyDataPiece::default()
        }),
        file_path: None,
    }
}
