//! Reads triangles of mesh files: .glb, .gltf, .obj and .stl.

use std::fs;
use std::io::Cursor;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use carom::DVec3;

/// Vertices and triangles, three numbers of vertices each.
pub(crate) type Triangles = (Vec<DVec3>, Vec<[u32; 3]>);

/// Reads all triangles of a file, whose ending says what it is.
///
/// # Errors
/// What is wrong with the file, in words.
pub(crate) fn read(path: &Path) -> Result<Triangles, String> {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if !["glb", "gltf", "obj", "stl"].contains(&&*ending) {
        return Err("a mesh is in a file that ends in .glb, .gltf, .obj or .stl".to_owned());
    }
    let bytes = fs::read(path).map_err(|error| error.to_string())?;
    let (vertices, triangles) = match &*ending {
        "obj" => of_obj(&bytes)?,
        "stl" => of_stl(&bytes)?,
        _ => of_gltf(&bytes, path.parent().unwrap_or(Path::new("")))?,
    };
    if triangles.is_empty() {
        Err("it has no triangles".to_owned())
    } else {
        Ok((vertices, triangles))
    }
}

/// Reads the only object of a Wavefront file (.obj).
///
/// # Errors
/// What is wrong with the file, in words; several objects, too.
pub(crate) fn read_one_object(path: &Path) -> Result<Triangles, String> {
    let models = models_of_obj(&fs::read(path).map_err(|error| error.to_string())?)?;
    // An object of several materials is several models of one name.
    if models.windows(2).any(|pair| pair[0].name != pair[1].name) {
        return Err("it holds several objects".to_owned());
    }
    Ok(joined(&models))
}

/// All models of a Wavefront file.
fn of_obj(bytes: &[u8]) -> Result<Triangles, String> {
    Ok(joined(&models_of_obj(bytes)?))
}

/// The models of a Wavefront file; polygons are cut into triangles.
fn models_of_obj(bytes: &[u8]) -> Result<Vec<tobj::Model>, String> {
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    // Materials are not read.
    let materials = |_: &Path| Ok(Default::default());
    let loaded = tobj::load_obj_buf(&mut Cursor::new(bytes), &options, materials);
    Ok(loaded.map_err(|error| error.to_string())?.0)
}

fn joined(models: &[tobj::Model]) -> Triangles {
    let mut all = (Vec::new(), Vec::new());
    for model in models {
        let places = model.mesh.positions.as_chunks::<3>().0;
        append(&mut all, places.iter().map(|&it| DVec3::from_array(it)), &model.mesh.indices);
    }
    all
}

/// The triangles of an STL file, in text or binary.
fn of_stl(bytes: &[u8]) -> Result<Triangles, String> {
    let mesh = stl_io::read_stl(&mut Cursor::new(bytes)).map_err(|error| error.to_string())?;
    let place = |it: &stl_io::Vertex| DVec3::from_array(it.0.map(f64::from));
    let triangle = |it: &stl_io::IndexedTriangle| it.vertices.map(|number| number as u32);
    Ok((mesh.vertices.iter().map(place).collect(), mesh.faces.iter().map(triangle).collect()))
}

/// The triangles of the first scene of a glTF file, where its nodes put them.
fn of_gltf(bytes: &[u8], folder: &Path) -> Result<Triangles, String> {
    let gltf::Gltf { document, blob } =
        gltf::Gltf::from_slice(bytes).map_err(|error| error.to_string())?;
    let mut buffers: Vec<Vec<u8>> = Vec::new();
    for buffer in document.buffers() {
        let data = match buffer.source() {
            gltf::buffer::Source::Bin => blob.clone().unwrap_or_default(),
            gltf::buffer::Source::Uri(uri) if uri.starts_with("data:") => {
                let text = uri.split_once("base64,").map_or("", |it| it.1);
                STANDARD.decode(text).map_err(|error| format!("a buffer of it: {error}"))?
            }
            gltf::buffer::Source::Uri(uri) => {
                fs::read(folder.join(uri)).map_err(|error| format!("\"{uri}\": {error}"))?
            }
        };
        if data.len() < buffer.length() {
            return Err("a buffer is shorter than the file says".to_owned());
        }
        buffers.push(data);
    }
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let mut all = (Vec::new(), Vec::new());
    let mut left: Vec<(gltf::Node, [[f64; 4]; 4])> =
        scene.into_iter().flat_map(|scene| scene.nodes()).map(|node| (node, UNMOVED)).collect();
    while let Some((node, parent)) = left.pop() {
        let placed = product(&parent, &node.transform().matrix().map(|it| it.map(f64::from)));
        for primitive in node.mesh().into_iter().flat_map(|mesh| mesh.primitives()) {
            if primitive.mode() != gltf::mesh::Mode::Triangles {
                return Err("a mesh of it has strips, lines or points".to_owned());
            }
            let reader = primitive.reader(|buffer| buffers.get(buffer.index()).map(|it| &it[..]));
            let places = reader.read_positions().ok_or("a mesh of it has no vertices")?;
            let places: Vec<DVec3> = places.map(|it| moved(&placed, it.map(f64::from))).collect();
            let indices = match reader.read_indices() {
                Some(indices) => indices.into_u32().collect(),
                None => (0..places.len() as u32).collect::<Vec<u32>>(),
            };
            append(&mut all, places.into_iter(), &indices);
        }
        left.extend(node.children().map(|child| (child, placed)));
    }
    Ok(all)
}

fn append(all: &mut Triangles, places: impl Iterator<Item = DVec3>, indices: &[u32]) {
    let first = all.0.len() as u32;
    all.0.extend(places);
    let triangles = indices.as_chunks::<3>().0;
    // Numbers that are beyond the vertices are refused where the mesh is made.
    all.1.extend(triangles.iter().map(|it| it.map(|number| first.saturating_add(number))));
}

/// Columns of the matrix that moves nothing.
const UNMOVED: [[f64; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// Columns of the product of two matrices.
fn product(first: &[[f64; 4]; 4], second: &[[f64; 4]; 4]) -> [[f64; 4]; 4] {
    let entry = |column: usize, row: usize| (0..4).map(|i| first[i][row] * second[column][i]).sum();
    std::array::from_fn(|column| std::array::from_fn(|row| entry(column, row)))
}

fn moved(matrix: &[[f64; 4]; 4], [x, y, z]: [f64; 3]) -> DVec3 {
    let part =
        |row: usize| matrix[0][row] * x + matrix[1][row] * y + matrix[2][row] * z + matrix[3][row];
    DVec3::new(part(0), part(1), part(2))
}
