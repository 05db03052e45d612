// Reads instances: kinds, finishes, rotations, the corner of each vertex of a rectangle or box, and
// the lines of grids.

// One number holds a finish and a kind or pattern.
fn kind_of(packed: f32) -> f32 {
    return packed % KINDS;
}

fn finish_of(packed: f32) -> f32 {
    return floor(packed / KINDS);
}

fn rotate(q: vec4<f32>, v: vec3<f32>) -> vec3<f32> {
    return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v);
}

const KINDS: f32 = 8.0;

// Finishes; any number between has the surface's own gloss.
const MATTE: f32 = 1.0;
const GLOSSY: f32 = 2.0;
const METAL: f32 = 3.0;
const GLASS: f32 = 4.0;
const WOOD: f32 = 5.0;
const CLOTH: f32 = 6.0;

const TRIANGLE: f32 = 6.0;

// The way from the first corner of a triangle to that of a vertex, of six of which three are one.
fn of_triangle(index: u32, second: vec3<f32>, third: vec3<f32>) -> vec3<f32> {
    if index == 1u {
        return second;
    }
    return select(vec3<f32>(), third, index == 2u);
}

struct Corner {
    place: vec3<f32>,
    normal: vec3<f32>,
}

// `kind` 1: a box of six faces, twelve triangles; else one face with the normal +y at height 0.
fn corner_of(index: u32, kind: f32) -> Corner {
    let face = index / 6u;
    let of_face = index % 6u;
    // The triangles 0 1 2 and 3 2 1 of a square.
    let number = select(of_face, 6u - of_face, of_face > 2u);
    let a = f32(number & 1u) * 2.0 - 1.0;
    let b = f32(number >> 1u) * 2.0 - 1.0;
    let side = 1.0 - 2.0 * f32(face & 1u);
    var corner: Corner;
    if kind != 1.0 {
        corner.place = vec3<f32>(a, 0.0, b);
        corner.normal = vec3<f32>(0.0, 1.0, 0.0);
    } else if face < 2u {
        corner.place = vec3<f32>(a, side, b);
        corner.normal = vec3<f32>(0.0, side, 0.0);
    } else if face < 4u {
        corner.place = vec3<f32>(side, a, b);
        corner.normal = vec3<f32>(side, 0.0, 0.0);
    } else {
        corner.place = vec3<f32>(a, b, side);
        corner.normal = vec3<f32>(0.0, 0.0, side);
    }
    return corner;
}

// Returns the part of a pixel that lies on the lines of a square grid; 0 where lines are too close.
fn grid(place: vec2<f32>, distance: f32, pixel: vec2<f32>) -> f32 {
    let cell = abs(fract(place / distance + 0.5) - 0.5) * distance;
    let line = 1.0 - smoothstep(0.5 * pixel, 1.5 * pixel, cell);
    let fade = 1.0 - smoothstep(0.1, 0.4, max(pixel.x, pixel.y) / distance);
    return max(line.x, line.y) * fade;
}
