// The grid below a scene without ground: transparent but for its lines and the shadows on it.

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) point: vec3<f32>,
    // Coordinates on the grid, from one of its lines.
    @location(1) place: vec2<f32>,
    // Distance of its lines, and how far it reaches.
    @location(2) @interpolate(flat) size: vec2<f32>,
}

@vertex
fn vertex(
    @builtin(vertex_index) index: u32,
    // Relative to the eye.
    @location(0) center: vec4<f32>,
    // Distance of its lines, and how far it reaches.
    @location(1) size: vec4<f32>,
) -> Varying {
    let corner = vec2<f32>(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
    let place = corner * size.y;
    var out: Varying;
    out.point = center.xyz + vec3<f32>(place.x, 0.0, place.y);
    out.clip = globals.clip_from_eye * vec4<f32>(out.point, 1.0);
    out.place = place;
    out.size = size.xy;
    return out;
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    let pixel = fwidth(in.place);
    let fine = grid(in.place, in.size.x, pixel);
    let coarse = grid(in.place, in.size.x * 5.0, pixel);
    let haze = smoothstep(0.1, 1.0, length(in.place) / in.size.y);

    // Only shadows straight below, which show where balls are; those of the sun would repeat it.
    let shade = 0.35 * (1.0 - skylight(in.point, vec3<f32>(0.0, 1.0, 0.0), 1.0)) * (1.0 - haze);
    let line = max(0.16 * fine, 0.26 * coarse) * (1.0 - haze);
    // Lines are lighter than dark ground and darker than light ground.
    let tone = select(0.85, 0.12, dot(globals.ground.rgb, vec3<f32>(0.2126, 0.7152, 0.0722)) > 0.2);
    let opacity = line + shade - line * shade;
    return vec4<f32>(vec3<f32>(tone * line * (1.0 - shade)), opacity);
}
