// Arrows of a width in pixels that always face the eye: a shaft of two triangles, a head of one.

struct Instance {
    // Relative to the eye; w: width in pixels.
    @location(0) start: vec4<f32>,
    // w: 1 with a head, 0 without.
    @location(1) end: vec4<f32>,
    // w: 1 in front of everything, 0 at its own depth.
    @location(2) color: vec4<f32>,
}

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) color: vec4<f32>,
}

// Arrows are cut off where they are nearer to the eye than this part of the depth range.
const NEAREST: f32 = 1e-3;

@vertex
fn vertex(@builtin(vertex_index) index: u32, arrow: Instance) -> Varying {
    var start = globals.clip_from_eye * vec4<f32>(arrow.start.xyz, 1.0);
    var end = globals.clip_from_eye * vec4<f32>(arrow.end.xyz, 1.0);
    // Cuts off the part behind the eye.
    if start.w < NEAREST && end.w > NEAREST {
        start = mix(start, end, (NEAREST - start.w) / (end.w - start.w));
    } else if end.w < NEAREST && start.w > NEAREST {
        end = mix(end, start, (NEAREST - end.w) / (start.w - end.w));
    }
    var out: Varying;
    out.color = arrow.color;
    if start.w < NEAREST || end.w < NEAREST {
        out.clip = vec4<f32>(0.0, 0.0, 2.0, 1.0);
        return out;
    }
    let half_picture = 0.5 * globals.picture.xy;
    let from_px = start.xy / start.w * half_picture;
    let to_px = end.xy / end.w * half_picture;
    let length_px = max(length(to_px - from_px), 1e-3);
    let along = (to_px - from_px) / length_px;
    let across = vec2<f32>(-along.y, along.x);
    let width = arrow.start.w;
    let head = min(4.0 * width, 0.6 * length_px) * arrow.end.w;

    var at_end = 0.0;
    var offset = vec2<f32>(0.0);
    if index < 6u {
        let number = select(index, 6u - index, index > 2u);
        at_end = f32(number & 1u);
        offset = across * width * (f32(number >> 1u) - 0.5) - along * head * at_end;
    } else {
        at_end = 1.0;
        let side = f32(index) - 7.0;
        offset = across * side * head * 0.45 - along * head * abs(side);
    }
    let base = mix(start, end, at_end);
    let place = mix(from_px, to_px, at_end) + offset;
    // The nearest depth is 1.
    let depth = mix(base.z, base.w, arrow.color.w);
    out.clip = vec4<f32>(place / half_picture * base.w, depth, base.w);
    return out;
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    return vec4<f32>(encoded(in.color.rgb), 1.0);
}
