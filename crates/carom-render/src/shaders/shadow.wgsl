// Shadow maps: depth seen from a light of one direction.

struct Light {
    map_from_eye: mat4x4<f32>,
    // Unit vectors: the direction in which light travels, and two across it.
    ahead: vec4<f32>,
    right: vec4<f32>,
    up: vec4<f32>,
}

@group(0) @binding(0) var<uniform> light: Light;

struct SphereVarying {
    @builtin(position) clip: vec4<f32>,
    @location(0) corner: vec2<f32>,
    @location(1) @interpolate(flat) finish: f32,
}

@vertex
fn sphere_vertex(
    @builtin(vertex_index) index: u32,
    @location(0) center: vec4<f32>,
    @location(1) color: vec4<f32>,
) -> SphereVarying {
    let corner = vec2<f32>(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
    let across = corner.x * light.right.xyz + corner.y * light.up.xyz;
    var out: SphereVarying;
    out.clip = light.map_from_eye * vec4<f32>(center.xyz + center.w * across, 1.0);
    out.corner = corner;
    out.finish = finish_of(color.w);
    return out;
}

// A disc across the light casts the same shadow as its sphere: the space between the disc and the
// cap in front of it is inside the sphere.
@fragment
fn sphere_fragment(in: SphereVarying) {
    let outside = dot(in.corner, in.corner);
    // Glass lets half of the light through: it covers every other texel.
    let odd = (i32(in.clip.x) + i32(in.clip.y)) % 2 != 0;
    if outside > 1.0 || (in.finish == GLASS && odd) {
        discard;
    }
}

@vertex
fn surface_vertex(
    @builtin(vertex_index) index: u32,
    @location(0) center: vec4<f32>,
    @location(1) rotation: vec4<f32>,
    @location(2) extent: vec4<f32>,
) -> @builtin(position) vec4<f32> {
    let kind = kind_of(center.w);
    if kind == TRIANGLE {
        let point = center.xyz + of_triangle(index, rotation.xyz, extent.xyz);
        return light.map_from_eye * vec4<f32>(point, 1.0);
    }
    let local = corner_of(index, kind).place * extent.xyz;
    return light.map_from_eye * vec4<f32>(center.xyz + rotate(rotation, local), 1.0);
}
