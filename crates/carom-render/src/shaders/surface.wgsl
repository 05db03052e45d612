// Rectangles, boxes, half-spaces, triangles and pieces of surfaces of revolution.

struct Instance {
    // Relative to the eye; w: kind and finish. Of a triangle a corner, with the ways to the others in place of the
    // rotation and the extent.
    @location(0) center: vec4<f32>,
    @location(1) rotation: vec4<f32>,
    // Half of the lengths along the local axes; w: distance of the grid lines. Of a piece of a surface of revolution
    // y and w are the curvatures along local z and x.
    @location(2) extent: vec4<f32>,
    // Linear; w: opacity, negative if only the rims of faces are drawn.
    @location(3) color: vec4<f32>,
}

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) point: vec3<f32>,
    // In the local frame.
    @location(1) local: vec3<f32>,
    @location(2) @interpolate(flat) normal: vec3<f32>,
    @location(3) @interpolate(flat) face: vec3<f32>,
    @location(4) @interpolate(flat) extent: vec4<f32>,
    @location(5) @interpolate(flat) color: vec4<f32>,
    @location(6) @interpolate(flat) kind: f32,
    @location(7) @interpolate(flat) finish: f32,
    @location(8) smooth_normal: vec3<f32>,
}

const BOX: f32 = 1.0;
// Half-spaces: the ground goes on to the horizon, inclines go farther than walls.
const GROUND: f32 = 2.0;
const WALL: f32 = 3.0;
const INCLINE: f32 = 4.0;
const FACET: f32 = 5.0;
// A wall of a container.
const PANE: f32 = 7.0;

// How dark shadows are on upright walls of containers: at full strength they look like stains.
const PANE_SHADE: f32 = 0.25;

@vertex
fn vertex(@builtin(vertex_index) index: u32, instance: Instance) -> Varying {
    let kind = kind_of(instance.center.w);
    let corner = corner_of(index, kind);
    var local = corner.place * instance.extent.xyz;
    var local_normal = corner.normal;
    if kind == FACET {
        local.y = 0.0;
        local_normal = vec3<f32>(instance.extent.w * local.x, 1.0, instance.extent.y * local.z);
    }
    var point = instance.center.xyz + rotate(instance.rotation, local);
    var normal = rotate(instance.rotation, corner.normal);
    var smooth_normal = rotate(instance.rotation, local_normal);
    if kind == TRIANGLE {
        local = vec3<f32>();
        point = instance.center.xyz + of_triangle(index, instance.rotation.xyz, instance.extent.xyz);
        normal = cross(instance.rotation.xyz, instance.extent.xyz);
        smooth_normal = normal;
    }
    var out: Varying;
    out.clip = globals.clip_from_eye * vec4<f32>(point, 1.0);
    out.point = point;
    out.local = local;
    out.normal = normal;
    out.face = corner.normal;
    out.smooth_normal = smooth_normal;
    out.extent = instance.extent;
    out.color = instance.color;
    out.kind = kind;
    out.finish = finish_of(instance.center.w);
    return out;
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    // With one sample a pixel, translucent surfaces cover every other pixel.
    let odd = (i32(in.clip.x) + i32(in.clip.y)) % 2 != 0;
    if in.color.w >= 0.0 && in.color.w < 1.0 && globals.horizon.w < 0.5 && odd {
        discard;
    }
    let is_front = dot(in.normal, in.point) < 0.0;
    // The two coordinates on the face, and its half lengths along them.
    var place = in.local.xz;
    var reach = in.extent.xz;
    if abs(in.face.x) > 0.5 {
        place = in.local.yz;
        reach = in.extent.yz;
    } else if abs(in.face.z) > 0.5 {
        place = in.local.xy;
        reach = in.extent.xy;
    }
    let distance = length(in.point);
    let pixel = max(fwidth(place), vec2<f32>(1e-7 * distance));

    var color = in.color.rgb;
    // Pieces of a larger surface have neither a grid nor edges of their own.
    let is_piece = in.kind == TRIANGLE || in.kind == FACET;
    if is_front {
        let is_water = in.kind == GROUND && in.finish == GLASS;
        let size = select(min(reach.x, reach.y), in.extent.w, in.kind >= GROUND && in.kind <= INCLINE);
        if in.finish == WOOD && !is_piece {
            color *= wood(select(place.yx, place, reach.x > reach.y) / size, max(pixel.x, pixel.y) / size);
        } else if in.finish == CLOTH && !is_piece {
            color *= cloth(place / size, max(pixel.x, pixel.y) / size);
        } else if in.kind != BOX && !is_piece && !is_water {
            color *= 1.0 - 0.10 * grid(place, in.extent.w, pixel);
        }
    } else if !is_piece {
        color = mix(color * 0.45, vec3<f32>(0.10, 0.11, 0.14), 0.5);
        color *= 1.0 + 0.5 * stripes(place.x + place.y, in.extent.w * 0.5, pixel.x + pixel.y);
    }
    var opacity = in.color.w;
    let is_half_space = in.kind >= GROUND && in.kind <= INCLINE;
    let inside = inside_room(in.point, in.kind);
    let inside_width = max(fwidth(inside), 1e-6 * distance);
    if is_half_space {
        opacity *= clamp(inside / inside_width + 0.5, 0.0, 1.0);
        if opacity < select(0.5, 0.1, globals.horizon.w > 0.5) * in.color.w {
            discard;
        }
    } else if in.color.w < 0.0 {
        let to_edge = (reach - abs(place)) / pixel;
        opacity = 1.0 - smoothstep(1.4, 2.4, min(to_edge.x, to_edge.y));
        if opacity < 0.1 {
            discard;
        }
        color = in.color.rgb * 0.55;
    } else if !is_piece {
        let to_edge = (reach - abs(place)) / pixel;
        let edge = 1.0 - smoothstep(0.4, 1.6, min(to_edge.x, to_edge.y));
        color *= 1.0 - 0.35 * edge;
        // Glass is most visible at its edges.
        opacity = select(opacity, mix(opacity, 0.8, edge), in.finish == GLASS);
    }

    var surface: Surface;
    surface.point = in.point;
    surface.normal = normalize(select(-in.smooth_normal, in.smooth_normal, is_front));
    surface.color = color;
    surface.gloss = select(0.0, 0.3, in.finish == WOOD);
    surface.finish = in.finish;
    let is_upright = in.kind == PANE && abs(surface.normal.y) < 0.5;
    // What shines through hides a shadow on glass.
    surface.shade = select(select(1.0, PANE_SHADE, is_upright), 0.0, in.finish == GLASS);
    var shown = lit(surface);
    if in.kind == GROUND {
        // The ground fades into the haze before its edge.
        let haze = smoothstep(0.12, 0.75, distance / in.extent.x);
        shown = mix(shown, sky(in.point / max(distance, 1e-12)), haze);
    }
    return vec4<f32>(encoded(shown), opacity);
}

// Returns the distance of a point of a half-space from where other half-spaces or the room cut it
// off; negative beyond.
fn inside_room(point: vec3<f32>, kind: f32) -> f32 {
    // Half-spaces do not cut themselves off.
    let slack = 1e-3 * length(point);
    var inside = 1e30;
    for (var i = 0; i < MOST_CUTS; i++) {
        let cut = globals.cuts[i];
        inside = min(inside, dot(cut.xyz, point) - cut.w + slack);
    }
    if kind != GROUND {
        let farther = select(0.0, globals.room_min.w, kind == INCLINE);
        let room = min(point - globals.room_min.xyz, globals.room_max.xyz - point) + farther;
        inside = min(inside, min(room.x, min(room.y, room.z)));
    }
    return inside;
}

// Returns the tone of wood at a place whose first coordinate runs along the grain; the board reaches from
// -1 to 1 across it. Growth rings that are cut lengthwise waver, and fibres run beside them.
fn wood(place: vec2<f32>, pixel: f32) -> f32 {
    let waver = noise(place * vec2<f32>(0.4, 1.5)) + 0.3 * noise(place * vec2<f32>(1.3, 5.0));
    let ring = fract(2.5 * place.y + 2.0 * waver);
    // Late wood is dark, and ends abruptly.
    let late = ring * ring * (1.0 - smoothstep(0.9, 1.0, ring));
    let fibre = noise(place * vec2<f32>(4.0, 70.0)) - 0.5;
    let rings_seen = 1.0 - smoothstep(0.1, 0.3, pixel);
    let fibres_seen = 1.0 - smoothstep(0.008, 0.03, pixel);
    return 1.08 - 0.45 * late * rings_seen + 0.16 * fibre * fibres_seen;
}

// Returns the tone of cloth at a place in half widths of its face: a fine weave, and nap that lies in patches.
fn cloth(place: vec2<f32>, pixel: f32) -> f32 {
    let nap = noise(5.0 * place) + 0.5 * noise(17.0 * place) - 0.75;
    let weave = noise(place * vec2<f32>(160.0, 320.0)) + noise(place * vec2<f32>(320.0, 160.0)) - 1.0;
    return 1.0 + 0.07 * nap + 0.16 * weave * (1.0 - smoothstep(0.002, 0.012, pixel));
}

// Returns a number from 0 to 1 that varies smoothly over a plane, by about half of that within one unit.
fn noise(place: vec2<f32>) -> f32 {
    let cell = vec2<i32>(floor(place));
    let part = fract(place);
    let smoothed = part * part * (3.0 - 2.0 * part);
    let below = mix(chance(cell), chance(cell + vec2<i32>(1, 0)), smoothed.x);
    let above = mix(chance(cell + vec2<i32>(0, 1)), chance(cell + vec2<i32>(1, 1)), smoothed.x);
    return mix(below, above, smoothed.y);
}

// Returns a number from 0 to 1 that looks random, the same for a cell on every device.
fn chance(cell: vec2<i32>) -> f32 {
    var bits = u32(cell.x) * 0x8da6b343u + u32(cell.y) * 0xd8163841u;
    bits = (bits ^ (bits >> 13u)) * 0x5bd1e995u;
    bits = (bits ^ (bits >> 15u)) & 0xffffu;
    return f32(bits) / 65535.0;
}

fn stripes(along: f32, distance: f32, pixel: f32) -> f32 {
    let wave = abs(fract(along / distance) - 0.5);
    let soft = clamp(pixel / distance, 0.01, 0.5);
    return smoothstep(0.25 - soft, 0.25 + soft, wave) * (1.0 - smoothstep(0.2, 0.5, pixel / distance));
}
