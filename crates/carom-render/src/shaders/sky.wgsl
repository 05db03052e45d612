// The sky behind everything: one triangle over the whole picture, at infinity.

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) direction: vec3<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    let corner = vec2<f32>(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0);
    var out: Varying;
    out.clip = vec4<f32>(corner, 0.0, 1.0);
    out.direction = globals.ahead.xyz + corner.x * globals.right.xyz + corner.y * globals.up.xyz;
    return out;
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    return vec4<f32>(encoded(sky(normalize(in.direction))), 1.0);
}
