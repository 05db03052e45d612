// Spheres, each a square that faces the eye, on which every pixel looks for the sphere along its
// own ray: round at any distance, with the right depth.

struct Instance {
    // Relative to the eye; w: radius.
    @location(0) center: vec4<f32>,
    // Linear; w: material.
    @location(1) color: vec4<f32>,
    @location(2) rotation: vec4<f32>,
}

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) ray: vec3<f32>,
    @location(1) @interpolate(flat) center: vec4<f32>,
    @location(2) @interpolate(flat) color: vec4<f32>,
    @location(3) @interpolate(flat) rotation: vec4<f32>,
}

const PATTERNED: f32 = 1.0;
const FIXED: f32 = 2.0;
const GLOWING: f32 = 3.0;
const BANDED: f32 = 4.0;

// Of the pattern of a banded ball, in radii from the centre: half the height of the band, and where
// its spots and the caps at its poles begin.
const BAND: f32 = 0.32;
const SPOT: f32 = 0.97;

@vertex
fn vertex(@builtin(vertex_index) index: u32, sphere: Instance) -> Varying {
    let radius = sphere.center.w;
    let distance = length(sphere.center.xyz);
    let ahead = sphere.center.xyz / max(distance, 1e-12);
    let aside = normalize(cross(ahead, select(vec3(0.0, 1.0, 0.0), vec3(1.0, 0.0, 0.0), abs(ahead.y) > 0.9)));
    let upward = cross(aside, ahead);
    // The cone of rays that touch the sphere cuts the plane through its centre in a circle a
    // little larger than it. A margin leaves place for the soft edge.
    let room = max(distance * distance - radius * radius, 1e-6 * distance * distance);
    let reach = radius * distance * inverseSqrt(room);
    let pixel = 2.0 * length(globals.up.xyz) * distance / globals.picture.y;
    let corner = vec2<f32>(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
    let ray = sphere.center.xyz + (corner.x * aside + corner.y * upward) * (reach + 1.5 * pixel);

    var out: Varying;
    out.clip = globals.clip_from_eye * vec4<f32>(ray, 1.0);
    out.ray = ray;
    out.center = sphere.center;
    out.color = sphere.color;
    out.rotation = sphere.rotation;
    return out;
}

struct Pixel {
    @location(0) color: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

@fragment
fn fragment(in: Varying) -> Pixel {
    let direction = normalize(in.ray);
    let center = in.center.xyz;
    let radius = in.center.w;
    let along = dot(direction, center);
    let miss = length(center - along * direction);
    // Part of the pixel inside the outline.
    let width = max(fwidth(miss), 1e-7 * along);
    let coverage = clamp((radius - miss) / width + 0.5, 0.0, 1.0);
    let enough = select(0.5, 0.05, globals.horizon.w > 0.5);
    if coverage < enough || along <= 0.0 {
        discard;
    }
    let depth_of_cap = sqrt(max(radius * radius - miss * miss, 0.0));
    let point = (along - depth_of_cap) * direction;
    let normal = (point - center) / radius;

    var surface: Surface;
    surface.point = point;
    surface.normal = normalize(normal);
    surface.color = in.color.rgb;
    surface.gloss = 1.0;
    let material = in.color.w;
    if material == BANDED {
        let pixel = 2.0 * length(globals.up.xyz) * along / (globals.picture.y * radius);
        let inverse = vec4<f32>(-in.rotation.xyz, in.rotation.w);
        let local = rotate(inverse, surface.normal);
        surface.color = banded(surface.color, local, rotate(inverse, -direction), pixel);
    }
    if material == PATTERNED || material == FIXED {
        let inverse = vec4<f32>(-in.rotation.xyz, in.rotation.w);
        let local = rotate(inverse, surface.normal);
        let blur = width / radius + 0.004;
        if material == PATTERNED {
            surface.color = patterned(surface.color, local, blur);
        } else {
            surface.color = ringed(surface.color, local, blur);
            surface.gloss = 0.15;
        }
    }
    var out: Pixel;
    let shown = select(lit(surface), in.color.rgb, material == GLOWING);
    out.color = vec4<f32>(encoded(shown), coverage);
    let clip = globals.clip_from_eye * vec4<f32>(point, 1.0);
    out.depth = clamp(clip.z / clip.w, 0.0, 1.0);
    return out;
}

// A lighter band and two caps: shows how a ball rolls, from every side.
fn patterned(color: vec3<f32>, local: vec3<f32>, blur: f32) -> vec3<f32> {
    let band = 1.0 - smoothstep(0.16 - blur, 0.16 + blur, abs(local.x));
    let caps = smoothstep(0.86 - blur, 0.86 + blur, abs(local.x));
    let other = 1.0 - smoothstep(0.05 - blur, 0.05 + blur, abs(local.z));
    let light = mix(color, vec3<f32>(0.92, 0.92, 0.90), 0.85);
    return mix(mix(color, color * 0.45, other), light, max(band, caps));
}

// A broad band with two spots, and small caps at its poles: whichever axis a ball turns about, one of
// them is in sight, and moves. `pixel`: size of a pixel in radii.
fn banded(color: vec3<f32>, local: vec3<f32>, to_eye: vec3<f32>, pixel: f32) -> vec3<f32> {
    // How much each coordinate changes across a pixel: without end at the outline.
    let slope = to_eye / max(dot(local, to_eye), 0.05);
    let change = sqrt(max(1.0 - 2.0 * slope * local + slope * slope, vec3<f32>(0.0)));
    let soft = clamp(1.3 * pixel * change, vec3<f32>(0.012), vec3<f32>(2.0));
    let band = inside(local.x + BAND, soft.x) - inside(local.x - BAND, soft.x);
    let caps = inside(abs(local.x) - SPOT, soft.x);
    let spots = inside(abs(local.z) - SPOT, soft.z);
    // Of a ball of a few pixels, the mean is seen; spots and caps are of the same size.
    let shown = mix(band + caps - spots, BAND, smoothstep(0.2, 0.6, pixel));
    return mix(color, other_tone(color), shown);
}

// Part of a pixel beyond an edge at a distance, where pixels are so wide.
fn inside(distance: f32, width: f32) -> f32 {
    return clamp(distance / width + 0.5, 0.0, 1.0);
}

// A lighter tone of a colour, of a light colour a darker one.
fn other_tone(color: vec3<f32>) -> vec3<f32> {
    let luminance = dot(color, vec3<f32>(0.2126, 0.7152, 0.0722));
    return select(mix(color, vec3<f32>(1.0), 0.28), color * 0.55, luminance > 0.4);
}

// Fine parallels: what is fixed looks turned on a lathe.
fn ringed(color: vec3<f32>, local: vec3<f32>, blur: f32) -> vec3<f32> {
    let latitude = local.y * 8.0;
    let line = abs(fract(latitude) - 0.5);
    let soft = 8.0 * blur;
    // From afar none are left: they would look like a flaw of the shadows.
    let visible = clamp(0.3 - 2.5 * soft, 0.0, 0.3);
    return color * (1.0 - visible * (1.0 - smoothstep(0.03, 0.06 + soft, line)));
}
