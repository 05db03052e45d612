// Sun, sky and shadows: the light on what is drawn. Positions are relative to the eye.

const MOST_CUTS: i32 = 8;

struct Globals {
    clip_from_eye: mat4x4<f32>,
    // Shadow maps of the sun, and of the sky straight above.
    sun_from_eye: mat4x4<f32>,
    sky_from_eye: mat4x4<f32>,
    // To the sun; w: size of a texel of the sun's map, in m.
    to_sun: vec4<f32>,
    // Linear colours. Sun, w: 1 if shadows are softened by several samples.
    sun: vec4<f32>,
    // Sky straight above, w: size of a texel of the sky's map, in m.
    zenith: vec4<f32>,
    // Sky above the horizon, w: 1 if a pixel has several samples.
    horizon: vec4<f32>,
    // Light reflected by the ground; w: used part of an edge of the sky's shadow map.
    ground: vec4<f32>,
    // The view: ahead (w: used part of an edge of the sun's shadow map), and vectors to the right
    // and upper edge of the picture at distance 1.
    ahead: vec4<f32>,
    right: vec4<f32>,
    up: vec4<f32>,
    // Width and height of the picture in pixels, size of a texel as a part of a shadow map; w:
    // white light from all sides besides that of the sky.
    picture: vec4<f32>,
    // The box in which half-spaces other than the ground are drawn; w: how much farther inclines
    // go.
    room_min: vec4<f32>,
    room_max: vec4<f32>,
    // Planes that cut other half-spaces off: normal, distance from the eye along it.
    cuts: array<vec4<f32>, MOST_CUTS>,
}

@group(0) @binding(0) var<uniform> globals: Globals;
@group(0) @binding(1) var shadow_maps: texture_depth_2d_array;
@group(0) @binding(2) var shadow_sampler: sampler_comparison;

fn tap(place: vec2<f32>, layer: i32, depth: f32) -> f32 {
    return textureSampleCompareLevel(shadow_maps, shadow_sampler, place, layer, depth);
}

// Returns the part of the light that arrives, from 0 to 1. `part`: used part of an edge of the map;
// `spread`: distance of the samples, in texels; 0 for a single one.
fn light_through(map: vec4<f32>, layer: i32, part: f32, spread: f32) -> f32 {
    let of_whole = map.xy * vec2<f32>(0.5, -0.5) + 0.5;
    if any(of_whole < vec2<f32>(0.0)) || any(of_whole > vec2<f32>(1.0)) {
        return 1.0;
    }
    let place = of_whole * part;
    // Points behind everything that casts shadows get the largest depth.
    let depth = min(map.z, 1.0);
    if globals.sun.w < 0.5 || spread == 0.0 {
        // Two samples a texel apart: glass shades every other texel, so one sample falls on each
        // kind.
        let half_texel = vec2<f32>(0.5 * globals.picture.z, 0.0);
        return 0.5 * (tap(place - half_texel, layer, depth) + tap(place + half_texel, layer, depth));
    }
    // Three by three samples, rotated by atan(1/2), so that no two share a row or column.
    let aside = vec2<f32>(1.0, -0.5) * globals.picture.z * spread;
    let up = vec2<f32>(0.5, 1.0) * globals.picture.z * spread;
    var sum = tap(place, layer, depth);
    sum += tap(place - aside - up, layer, depth) + tap(place + aside - up, layer, depth);
    sum += tap(place - aside + up, layer, depth) + tap(place + aside + up, layer, depth);
    // Where the middle and the corners agree, so do the samples between them: most points are far
    // from the edge of a shadow.
    if sum == 0.0 || sum == 5.0 {
        return 0.2 * sum;
    }
    sum += tap(place - aside, layer, depth) + tap(place + aside, layer, depth);
    sum += tap(place - up, layer, depth) + tap(place + up, layer, depth);
    return sum / 9.0;
}

// Returns the colour of the sky in a direction.
fn sky(direction: vec3<f32>) -> vec3<f32> {
    let height = direction.y;
    let above = mix(globals.horizon.rgb, globals.zenith.rgb, sqrt(max(height, 0.0)));
    // Below the horizon is the tone of the ground, with haze in between.
    return mix(above, globals.ground.rgb, smoothstep(0.0, 0.35, -height));
}

// Converts a linear colour to sRGB (IEC 61966-2-1).
fn encoded(linear: vec3<f32>) -> vec3<f32> {
    let color = clamp(linear, vec3<f32>(0.0), vec3<f32>(1.0));
    let dark = color * 12.92;
    let light = 1.055 * pow(color, vec3<f32>(1.0 / 2.4)) - 0.055;
    return select(light, dark, color <= vec3<f32>(0.0031308));
}

struct Surface {
    point: vec3<f32>,
    normal: vec3<f32>,
    color: vec3<f32>,
    // From 0 to 1; used if the finish does not set it.
    gloss: f32,
    finish: f32,
    // How dark shadows of the sun are, from 0 to 1.
    shade: f32,
}

// Returns the part of the sun's light that arrives at a surface point, with shadows of others.
// `spread`: 1 for soft shadows, 0 for hard ones.
fn sunlight(point: vec3<f32>, normal: vec3<f32>, spread: f32) -> f32 {
    if dot(normal, globals.to_sun.xyz) <= 0.0 {
        return 0.0;
    }
    let off = off_surface(point, normal, globals.to_sun.xyz, globals.to_sun.w, 0.6, 2.4);
    return light_through(globals.sun_from_eye * vec4<f32>(off, 1.0), 0, globals.ahead.w, 1.2 * spread);
}

// Returns the part of the light of the sky straight above that arrives at a surface point.
fn skylight(point: vec3<f32>, normal: vec3<f32>, spread: f32) -> f32 {
    let off = off_surface(point, normal, vec3<f32>(0.0, 1.0, 0.0), globals.zenith.w, 1.0, 3.5);
    let map = globals.sky_from_eye * vec4<f32>(off, 1.0);
    // Far below, light of the sky comes from around what hides its zenith.
    if map.z > 1.0 {
        return 1.0;
    }
    return light_through(map, 1, globals.ground.w, 1.5 * spread);
}

// Moves a point off a surface so that the surface does not shade itself: by `straight` texels, and
// by `grazing` texels more where light grazes, because neighbouring samples lie deeper there.
fn off_surface(
    point: vec3<f32>,
    normal: vec3<f32>,
    to_light: vec3<f32>,
    texel: f32,
    straight: f32,
    grazing: f32,
) -> vec3<f32> {
    let facing = dot(normal, to_light);
    let slope = sqrt(max(1.0 - facing * facing, 0.0));
    return point + normal * texel * (straight + grazing * slope);
}

fn lit(surface: Surface) -> vec3<f32> {
    return lit_by(surface, 1.0);
}

fn lit_by(surface: Surface, spread: f32) -> vec3<f32> {
    let n = surface.normal;
    let facing = dot(n, globals.to_sun.xyz);
    let sunlit = mix(1.0, sunlight(surface.point, n, spread), surface.shade);

    let upward = 0.5 + 0.5 * n.y;
    let open = 0.58 + 0.42 * skylight(surface.point, n, spread);
    let fill = globals.picture.w;
    let from_sky = (mix(globals.horizon.rgb, globals.zenith.rgb, 0.5) + fill) * open;
    let ambient = mix((globals.ground.rgb + fill) * 0.55, from_sky, upward);
    let direct = globals.sun.rgb * max(facing, 0.0) * sunlit;
    let diffuse = surface.color * (0.66 * ambient + 0.95 * direct);
    if surface.finish >= GLOSSY && surface.finish <= GLASS {
        let shine = polish(surface, sunlit * step(0.0, facing));
        let mirrors_all = surface.finish == METAL;
        return select(diffuse * (1.0 - shine.a) + shine.rgb, shine.rgb + 0.25 * diffuse, mirrors_all);
    }
    if surface.finish == MATTE || surface.finish == CLOTH || surface.gloss == 0.0 {
        return diffuse;
    }
    let to_eye = -normalize(surface.point);
    let half_way = normalize(to_eye + globals.to_sun.xyz);
    let highlight = pow(max(dot(n, half_way), 0.0), 60.0) * sunlit * step(0.0, facing);
    let grazing = pow(1.0 - max(dot(n, to_eye), 0.0), 4.0);
    let mirrored = sky(reflect(-to_eye, n));
    return diffuse + surface.gloss * (0.35 * highlight * globals.sun.rgb + 0.28 * grazing * mirrored);
}

// Returns what a polished surface reflects of sky and sun; a: the part of the light that it
// reflects.
fn polish(surface: Surface, sunlit: f32) -> vec4<f32> {
    let n = surface.normal;
    let to_eye = -normalize(surface.point);
    // Schlick's approximation of Fresnel's equations, An Inexpensive BRDF Model (1994), with the
    // part that glass mirrors head-on.
    let grazing = pow(1.0 - max(dot(n, to_eye), 0.0), 5.0);
    let head_on = select(vec3<f32>(0.04), surface.color, surface.finish == METAL);
    let part = head_on + (1.0 - head_on) * grazing;
    let half_way = normalize(to_eye + globals.to_sun.xyz);
    let highlight = pow(max(dot(n, half_way), 0.0), 500.0) * sunlit;
    let sun = min(select(20.0, 2.0, surface.finish == METAL) * part, vec3<f32>(1.5)) * highlight;
    return vec4<f32>(part * room(reflect(-to_eye, n)) + sun * globals.sun.rgb, part.g);
}

// Returns what a polished surface reflects in a direction: the sky, but brighter above and darker
// around the horizon, like a room with a lamp. The plain sky would hardly show the surface's curve.
fn room(direction: vec3<f32>) -> vec3<f32> {
    let lamp = smoothstep(0.55, 0.75, direction.y);
    let band = smoothstep(-0.12, 0.1, direction.y);
    return sky(direction) * (mix(0.3, 0.85, band) + 0.55 * lamp);
}
