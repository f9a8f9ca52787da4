// A surface in soft light or as a striped mirror.
// In: vertices about the surface's middle in units of its radius. Out: colours of sRGB, encoded here, since egui takes textures as they are.
// Directions and places are in the view: x to the right, y up, z towards the eye.

struct Scene {
    clip_from_local: mat4x4<f32>,
    view_from_local: mat4x4<f32>,
    // Colours in proportion to light. The fourth numbers: strength of the gloss, strength of the key light, strength of the rim.
    material: vec4<f32>,
    sky: vec4<f32>,
    ground: vec4<f32>,
    // Axis of the light tunnel, and pairs of stripes; none of them means clay.
    zebra: vec4<f32>,
}

@group(0) @binding(0) var<uniform> scene: Scene;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) normal: vec3<f32>,
}

@vertex
fn place_corner(@location(0) place: vec3<f32>, @location(1) normal: vec3<f32>) -> Corner {
    var corner: Corner;
    corner.clip = scene.clip_from_local * vec4(place, 1.0);
    corner.place = (scene.view_from_local * vec4(place, 1.0)).xyz;
    corner.normal = (scene.view_from_local * vec4(normal, 0.0)).xyz;
    return corner;
}

// Towards the key light, at the upper left behind the viewer, and the fill light, at the right: both of length one.
const KEY = vec3(-0.4801, 0.6201, 0.6203);
const FILL = vec3(0.8484, 0.0998, 0.5199);
// The fill light as a part of the key light.
const FILL_PART = 0.19;
// How far the key light reaches round the edge of its shadow, as a large lamp's does.
const WRAP = 0.12;
// Sharpness of the gloss.
const SHININESS = 36.0;
// Light of the stripes, dark and bright, before the shading that keeps the shape visible.
const DARK_STRIPE = 0.003;
const BRIGHT_STRIPE = 0.80;
const PI = 3.14159265;

// Light from clay with this normal, seen along `to_eye`.
fn clay(normal: vec3<f32>, to_eye: vec3<f32>) -> vec3<f32> {
    let around = mix(scene.ground.rgb, scene.sky.rgb, 0.5 + 0.5 * normal.y);
    let key = max(dot(normal, KEY) + WRAP, 0.0) / (1.0 + WRAP);
    let fill = FILL_PART * max(dot(normal, FILL), 0.0);
    let direct = scene.sky.a * (key + fill);
    let gloss = scene.material.a * pow(max(dot(normal, normalize(KEY + to_eye)), 0.0), SHININESS);
    // Seen at a glance, every material is a mirror of the light behind it, more from above than from below.
    let glance = 1.0 - clamp(dot(normal, to_eye), 0.0, 1.0);
    let rim = scene.ground.a * glance * glance * glance * (0.35 + 0.65 * (0.5 + 0.5 * normal.y));
    return scene.material.rgb * (around + direct) + gloss + rim * scene.sky.rgb;
}

// Integral from 0 to t of a wave that is 1 in the first half of each period of length 1, and 0 in the second.
fn integrated_wave(t: f32) -> f32 {
    return 0.5 * floor(t) + min(fract(t), 0.5);
}

// Light of the mirrored tunnel. The mean of the stripes over the pixel's width makes their edges smooth, and grey of stripes too fine to be seen.
fn zebra(normal: vec3<f32>, to_eye: vec3<f32>) -> vec3<f32> {
    let mirrored = reflect(-to_eye, normal);
    let latitude = asin(clamp(dot(mirrored, scene.zebra.xyz), -1.0, 1.0));
    // A stripe lies across the middle of the tunnel, so that the pattern is the same from either end.
    let at = (latitude / PI) * scene.zebra.w + 0.25;
    let width = max(length(vec2(dpdx(at), dpdy(at))), 1e-4);
    let dark = (integrated_wave(at + 0.5 * width) - integrated_wave(at - 0.5 * width)) / width;
    let shape = 0.66 + 0.34 * dot(normal, KEY);
    return vec3(mix(BRIGHT_STRIPE, DARK_STRIPE, clamp(dark, 0.0, 1.0)) * shape);
}

// Light as screens take it (IEC 61966-2-1).
fn encoded(light: vec3<f32>) -> vec3<f32> {
    let l = clamp(light, vec3(0.0), vec3(1.0));
    return select(1.055 * pow(l, vec3(1.0 / 2.4)) - 0.055, 12.92 * l, l <= vec3(0.0031308));
}

@fragment
fn shade(corner: Corner, @builtin(front_facing) outside: bool) -> @location(0) vec4<f32> {
    // Where the eye is inside the surface, it sees it from there.
    let mean = normalize(select(-corner.normal, corner.normal, outside));
    let to_eye = normalize(-corner.place);
    // At the silhouette the mean of the corners' normals may point away, where no light could be seen to come from.
    let normal = normalize(mean - min(dot(mean, to_eye), 0.0) * to_eye);
    var light: vec3<f32>;
    if scene.zebra.w > 0.0 {
        light = zebra(normal, to_eye);
    } else {
        light = clay(normal, to_eye);
    }
    return vec4(encoded(light), 1.0);
}
