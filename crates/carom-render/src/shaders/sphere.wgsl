// Spheres. Each is a square that faces the eye; every pixel intersects its own ray with the sphere,
// so it is round at any distance and has the right depth.

struct Instance {
    // Relative to the eye; w: radius.
    @location(0) center: vec4<f32>,
    // Linear; w: pattern and finish.
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

const STRIPED: f32 = 1.0;
const FIXED: f32 = 2.0;
const GLOWING: f32 = 3.0;
const BANDED: f32 = 4.0;

// The pattern of a banded ball, in radii from the centre: half the height of the band, and where
// spots and polar caps begin.
const BAND: f32 = 0.32;
const SPOT: f32 = 0.97;

// Refractive index of glass, and opacity in the middle of a glass ball.
const GLASS_INDEX: f32 = 1.5;
const GLASS_OPACITY: f32 = 0.55;

@vertex
fn vertex(@builtin(vertex_index) index: u32, sphere: Instance) -> Varying {
    let radius = sphere.center.w;
    let distance = length(sphere.center.xyz);
    let frame = frame_of(sphere.center.xyz);
    // The cone of rays that touch the sphere cuts the plane through its centre in a circle a little
    // larger than the sphere. A margin leaves space for the soft edge.
    let room = max(distance * distance - radius * radius, 1e-6 * distance * distance);
    let reach = radius * distance * inverseSqrt(room);
    let pixel = 2.0 * length(globals.up.xyz) * distance / globals.picture.y;
    let corner = vec2<f32>(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
    let ray = sphere.center.xyz + (corner.x * frame[0] + corner.y * frame[1]) * (reach + 1.5 * pixel);

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

// The point where the ray through a pixel meets a sphere.
struct Hit {
    point: vec3<f32>,
    normal: vec3<f32>,
    // Unit vector.
    direction: vec3<f32>,
    // Distance along the ray to the point nearest to the centre, and that point's distance from the
    // centre.
    along: f32,
    miss: f32,
    // Width of a pixel there.
    width: f32,
    // Part of the pixel inside the outline.
    coverage: f32,
}

fn hit(ray: vec3<f32>, sphere: vec4<f32>) -> Hit {
    var hit: Hit;
    let center = sphere.xyz;
    let radius = sphere.w;
    hit.direction = normalize(ray);
    hit.along = dot(hit.direction, center);
    hit.miss = length(center - hit.along * hit.direction);
    hit.width = max(fwidth(hit.miss), 1e-7 * hit.along);
    hit.coverage = clamp((radius - hit.miss) / hit.width + 0.5, 0.0, 1.0);
    let depth_of_cap = sqrt(max(radius * radius - hit.miss * hit.miss, 0.0));
    hit.point = (hit.along - depth_of_cap) * hit.direction;
    hit.normal = normalize((hit.point - center) / radius);
    return hit;
}

fn depth_of(point: vec3<f32>) -> f32 {
    let clip = globals.clip_from_eye * vec4<f32>(point, 1.0);
    return clamp(clip.z / clip.w, 0.0, 1.0);
}

@fragment
fn fragment(in: Varying) -> Pixel {
    let hit = hit(in.ray, in.center);
    let enough = select(0.5, 0.05, globals.horizon.w > 0.5);
    if hit.coverage < enough || hit.along <= 0.0 {
        discard;
    }
    let radius = in.center.w;
    var surface: Surface;
    surface.point = hit.point;
    surface.normal = hit.normal;
    surface.color = in.color.rgb;
    surface.gloss = 1.0;
    surface.finish = finish_of(in.color.w);
    surface.shade = 1.0;
    let pattern = kind_of(in.color.w);
    if pattern == BANDED {
        let pixel = 2.0 * length(globals.up.xyz) * hit.along / (globals.picture.y * radius);
        let inverse = vec4<f32>(-in.rotation.xyz, in.rotation.w);
        let local = rotate(inverse, surface.normal);
        surface.color = banded(surface.color, local, rotate(inverse, -hit.direction), pixel);
    }
    if pattern == STRIPED || pattern == FIXED {
        let inverse = vec4<f32>(-in.rotation.xyz, in.rotation.w);
        let local = rotate(inverse, surface.normal);
        let blur = hit.width / radius + 0.004;
        if pattern == STRIPED {
            surface.color = striped(surface.color, local, blur);
        } else {
            surface.color = ringed(surface.color, local, blur);
            surface.gloss = 0.15;
        }
    }
    var out: Pixel;
    let shown = select(lit(surface), in.color.rgb, pattern == GLOWING);
    out.color = vec4<f32>(encoded(shown), hit.coverage);
    out.depth = depth_of(hit.point);
    return out;
}

// A ball of glass: what is behind it shows through in its tint. It refracts the sky, and reflects
// it more towards the rim.
@fragment
fn glass(in: Varying) -> Pixel {
    let hit = hit(in.ray, in.center);
    if hit.coverage < 0.05 || hit.along <= 0.0 {
        discard;
    }
    var surface: Surface;
    surface.point = hit.point;
    surface.normal = hit.normal;
    surface.color = in.color.rgb;
    surface.finish = GLASS;
    surface.shade = 1.0;
    let facing = dot(hit.normal, globals.to_sun.xyz);
    let shine = polish(surface, sunlight(hit.point, hit.normal, 1.0) * step(0.0, facing));
    // The ray bends where it enters and where it leaves.
    let inner = refract(hit.direction, hit.normal, 1.0 / GLASS_INDEX);
    let exit = hit.normal - 2.0 * dot(hit.normal, inner) * inner;
    let through = refract(inner, -exit, GLASS_INDEX);
    // Light takes more colour on a longer path through the glass.
    let outward = hit.miss / in.center.w;
    let way = sqrt(max(1.0 - outward * outward, 0.0));
    let tint = mix(vec3<f32>(1.0), in.color.rgb, 0.6 + 0.4 * way);
    let behind = sky(through) * mix(0.55, 1.15, smoothstep(-0.3, 0.5, through.y));
    let seen = tint * behind * (1.0 - shine.a) + shine.rgb;
    let opacity = mix(GLASS_OPACITY, 1.0, pow(outward, 4.0));
    let covered = hit.coverage * clamp(opacity + shine.a, 0.0, 1.0);
    var out: Pixel;
    out.color = vec4<f32>(encoded(seen) * covered, covered);
    out.depth = depth_of(hit.point);
    return out;
}

// Balls of a few pixels: octagons at their centres, of the size of the visible circles. The device
// skips hidden ones, which it cannot do for a shader that computes depth itself.
struct SmallVarying {
    @builtin(position) clip: vec4<f32>,
    // On the octagon, in radii.
    @location(0) corner: vec2<f32>,
    @location(1) @interpolate(flat) center: vec4<f32>,
    @location(2) @interpolate(flat) color: vec4<f32>,
}

// Corners of an octagon in the order of a strip, in eighths of a turn, and their distance from the
// middle: the octagon has the area of a circle of radius 1.
const STRIP = array<f32, 8>(0.0, 1.0, 7.0, 2.0, 6.0, 3.0, 5.0, 4.0);
const OCTAGON: f32 = 1.053926;

@vertex
fn small_vertex(@builtin(vertex_index) index: u32, sphere: Instance) -> SmallVarying {
    var strip = STRIP;
    let angle = (strip[index] + 0.5) * 0.785398163;
    let corner = OCTAGON * vec2<f32>(cos(angle), sin(angle));
    let frame = frame_of(sphere.center.xyz);
    let place = sphere.center.xyz + sphere.center.w * (corner.x * frame[0] + corner.y * frame[1]);
    var out: SmallVarying;
    out.clip = globals.clip_from_eye * vec4<f32>(place, 1.0);
    out.corner = corner;
    out.center = sphere.center;
    out.color = sphere.color;
    if kind_of(sphere.color.w) == BANDED {
        out.color = vec4<f32>(mix(sphere.color.rgb, other_tone(sphere.color.rgb), BAND), sphere.color.w);
    }
    return out;
}

@fragment
fn small_fragment(in: SmallVarying) -> @location(0) vec4<f32> {
    let frame = frame_of(in.center.xyz);
    let toward = sqrt(max(1.0 - dot(in.corner, in.corner), 0.0));
    let normal = in.corner.x * frame[0] + in.corner.y * frame[1] - toward * frame[2];
    var surface: Surface;
    surface.normal = normalize(normal);
    surface.point = in.center.xyz + in.center.w * surface.normal;
    surface.color = in.color.rgb;
    surface.gloss = 1.0;
    surface.finish = finish_of(in.color.w);
    surface.shade = 1.0;
    return vec4<f32>(encoded(lit_by(surface, 0.0)), 1.0);
}

// Returns directions to the right, upward and ahead for something that faces the eye.
fn frame_of(center: vec3<f32>) -> mat3x3<f32> {
    let ahead = center / max(length(center), 1e-12);
    let aside = normalize(cross(ahead, select(vec3(0.0, 1.0, 0.0), vec3(1.0, 0.0, 0.0), abs(ahead.y) > 0.9)));
    return mat3x3<f32>(aside, cross(aside, ahead), ahead);
}

// Paints a lighter band and two caps, which show from every side how a ball rolls.
fn striped(color: vec3<f32>, local: vec3<f32>, blur: f32) -> vec3<f32> {
    let band = 1.0 - smoothstep(0.16 - blur, 0.16 + blur, abs(local.x));
    let caps = smoothstep(0.86 - blur, 0.86 + blur, abs(local.x));
    let other = 1.0 - smoothstep(0.05 - blur, 0.05 + blur, abs(local.z));
    let light = mix(color, vec3<f32>(0.92, 0.92, 0.90), 0.85);
    return mix(mix(color, color * 0.45, other), light, max(band, caps));
}

// Paints a broad band with two spots and small polar caps: for a turn about any axis, one of them
// is visible and moves. `pixel`: size of a pixel in radii.
fn banded(color: vec3<f32>, local: vec3<f32>, to_eye: vec3<f32>, pixel: f32) -> vec3<f32> {
    // How much each coordinate changes across a pixel; unbounded at the outline.
    let slope = to_eye / max(dot(local, to_eye), 0.05);
    let change = sqrt(max(1.0 - 2.0 * slope * local + slope * slope, vec3<f32>(0.0)));
    let soft = clamp(1.3 * pixel * change, vec3<f32>(0.012), vec3<f32>(2.0));
    let band = inside(local.x + BAND, soft.x) - inside(local.x - BAND, soft.x);
    let caps = inside(abs(local.x) - SPOT, soft.x);
    let spots = inside(abs(local.z) - SPOT, soft.z);
    // A ball of a few pixels shows the mean; spots and caps have the same size.
    let shown = mix(band + caps - spots, BAND, smoothstep(0.2, 0.6, pixel));
    return mix(color, other_tone(color), shown);
}

// Returns the part of a pixel beyond an edge at a distance, for pixels of this width.
fn inside(distance: f32, width: f32) -> f32 {
    return clamp(distance / width + 0.5, 0.0, 1.0);
}

// Returns a lighter tone of a colour, or a darker tone of a light colour.
fn other_tone(color: vec3<f32>) -> vec3<f32> {
    let luminance = dot(color, vec3<f32>(0.2126, 0.7152, 0.0722));
    return select(mix(color, vec3<f32>(1.0), 0.28), color * 0.55, luminance > 0.4);
}

// Paints fine parallels, which make a fixed ball look turned on a lathe.
fn ringed(color: vec3<f32>, local: vec3<f32>, blur: f32) -> vec3<f32> {
    let latitude = local.y * 8.0;
    let line = abs(fract(latitude) - 0.5);
    let soft = 8.0 * blur;
    // Far away they vanish: they would look like errors of the shadows.
    let visible = clamp(0.3 - 2.5 * soft, 0.0, 0.3);
    return color * (1.0 - visible * (1.0 - smoothstep(0.03, 0.06 + soft, line)));
}
