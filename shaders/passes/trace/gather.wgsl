// Every pixel gathers what the paths of its tile lend (passes/trace/reuse): the second kernel of integrator `Path` with reuse.
//
// A point y that path k lends is as good for any pixel m of the tile whose first surface x_m would have drawn it. With p_m the density by area with
// which it does, and link_mk whether it can (y is seen from x_m, and looks there as it does to k), pixel j adds
//
//   sum over k of  f_j cos cos' / d^2 * link_jk * L_k / (sum over m of p_m link_mk)
//
// the balance heuristic over the pixels of a tile as techniques (Veach 1997). Whether two points are linked is a function of the two alone and
// not of who drew, in numerator, denominator and the choice of techniques alike: that makes it right in the mean, whatever the links are.

import package::gen::{GatherPoint, LentPoint, MaterialRecord, RadianceSample, Ray, TraceParams};
import package::gen::{GATHER_POINT_STRIDE, LENT_POINT_STRIDE, unpack_gather_point, unpack_lent_point};
@if(adaptive) import package::gen::{TileSample};
import package::gen::{BAD_OVERFLOW, NO_CHANCE, NO_HIT, NO_MATERIAL, SAMPLE_BAD, TILE_BLOCK, TILE_PIXELS};
@if(normals || relief) import package::gen::{LEAST_FACING};
import package::lib::bsdf::frame::{BsdfValue, ShadingFrame};
import package::lib::bsdf::mixture::{mixture_evaluate};
import package::lib::fault::{fault_of};
import package::lib::math::{largest_of};
import package::lib::rng_pcg::{pcg4d};
@if(adaptive) import package::lib::tiles::{tile_corner};
@if(few_triangles) import package::passes::trace::few_boxes::{keep_boxes};
import package::passes::trace::materials::{load_material};
import package::passes::trace::scene::{scene_extent};
@if(!few_triangles) import package::passes::trace::traverse::{traverse};
@if(few_triangles) import package::passes::trace::traverse_few::{traverse_few};

@group(0) @binding(2) var<storage, read> params: TraceParams;
@group(0) @binding(4) var<storage, read_write> radiance: array<RadianceSample>;
@group(0) @binding(19) var<storage, read> gather_points: array<vec4<u32>>;
@group(0) @binding(20) var<storage, read> lent_points: array<vec4<u32>>;
@if(adaptive) @group(0) @binding(29) var<storage, read> tile_samples: array<TileSample>;

// How far beyond y a ray to it goes, and how near something is that hides it for certain, as part of the way.
const AROUND_LENT: f32 = 0x1p-12;

// A density above this is of a point in the corner that it is seen from, and links nothing: sums stay finite.
const GREATEST_DENSITY: f32 = 1e30;

// Sets these hashes off from those of other numbers.
const DEAL_STREAM: u32 = 0x6465616cu;

// Of each of four tiles, each point that is lent, and each pixel: the density with which the pixel would have drawn the point; 0 where the two
// are not linked.
var<workgroup> densities: array<f32, 1024>;

// Of each point that is lent, their sum; 0 where its path keeps it to itself.
var<workgroup> totals: array<f32, 64>;

// The first surface of a pixel's path.
struct Gatherer {
    origin: vec3<f32>,
    frame: ShadingFrame,
    material: MaterialRecord,
    // Index of the material.
    index: u32,
    // There is one.
    exists: bool,
}

fn load_gatherer(place: u32, exists: bool) -> Gatherer {
    let at = GATHER_POINT_STRIDE * place;
    let point = unpack_gather_point(gather_points[at], gather_points[at + 1u], gather_points[at + 2u], gather_points[at + 3u]);
    var gatherer: Gatherer;
    gatherer.exists = exists && point.material != NO_MATERIAL;
    gatherer.origin = point.origin;
    gatherer.index = point.material;
    gatherer.frame = ShadingFrame(point.wo, point.shading, point.geometric, point.back_face);
    // Where textures make each point another material, those of the points are bound.
    var material = point.material;
    @if(textures) {
        material = place;
    }
    gatherer.material = load_material(select(0u, material, gatherer.exists));
    return gatherer;
}

fn load_lent(place: u32) -> LentPoint {
    let at = LENT_POINT_STRIDE * place;
    return unpack_lent_point(lent_points[at], lent_points[at + 1u], lent_points[at + 2u], lent_points[at + 3u], lent_points[at + 4u]);
}

// How a pixel sees a point that is lent, if nothing is in between.
struct Link {
    // f * cos of the pixel's surface, and its density, both by area at the point; 0 where it does not look there as it does to its own path.
    value: vec3<f32>,
    pdf: f32,
    ray: Ray,
    distance: f32,
}

fn link_to(gatherer: Gatherer, point: LentPoint) -> Link {
    let offset = point.position - gatherer.origin;
    let distance = length(offset);
    var link = Link(vec3<f32>(0.0), 0.0, Ray(gatherer.origin, 0.0, offset / max(distance, 0x1p-100), distance * (1.0 + AROUND_LENT)), distance);
    let cos_lent = -dot(point.geometric, link.ray.direction);
    var alike = cos_lent > 0.0 && distance > 0x1p-60;
    @if(normals || relief) {
        // Not bent to be seen (lib/normals).
        alike = alike && -dot(point.normal, link.ray.direction) >= min(LEAST_FACING, cos_lent);
    }
    if (alike) {
        let at = mixture_evaluate(gatherer.material, gatherer.frame, link.ray.direction);
        let by_area = cos_lent / (distance * distance);
        // Where nothing is carried a path ends, and so never comes to draw the point, whatever its density.
        if (at.pdf * by_area < GREATEST_DENSITY && largest_of(at.value) > 0.0) {
            link.value = at.value * by_area;
            link.pdf = at.pdf * by_area;
        }
    }
    return link;
}

// Whether the point is what a ray to it meets first.
fn is_seen(link: Link, point: LentPoint, extent: f32, chance: u32) -> bool {
    let enough = link.distance * (1.0 - AROUND_LENT);
    @if(few_triangles) {
        return traverse_few(link.ray, params.root, extent, enough, chance).triangle == point.triangle;
    } @else {
        return traverse(link.ray, params.root, extent, enough, chance).triangle == point.triangle;
    }
}

// How the quads of a block, of 2 by 2 pixels, are dealt to its four tiles: two bits of x and one of y a quad.
fn deal_quads(block: vec2<u32>) -> vec2<u32> {
    return pcg4d(vec4<u32>(block, params.seed, DEAL_STREAM)).xy;
}

// Where a pixel of the block is, from its first one: by tile and place in it, which is its quad. Pixels of a tile share most of their noise; dealt
// at random, it looks like noise, and a quad still has a pixel of each.
fn pixel_of(tile: u32, slot: u32, dealt: vec2<u32>) -> vec2<u32> {
    let at = tile ^ ((dealt.x >> (2u * slot)) & 3u);
    let inner = select(vec2<u32>(at & 1u, at >> 1u), vec2<u32>(at >> 1u, at & 1u), ((dealt.y >> slot) & 1u) != 0u);
    return 2u * vec2<u32>(slot & 3u, slot >> 2u) + inner;
}

// What a good sample and what it gathered come to.
fn gathered(sample: RadianceSample, light: vec3<f32>, rays: u32, material: u32) -> RadianceSample {
    let sum = sample.rgb + light;
    if (all(bitcast<vec3<u32>>(sum) <= vec3<u32>(bitcast<u32>(params.largest)))) {
        return RadianceSample(sum, sample.info + rays);
    }
    let kind = fault_of(sum);
    return RadianceSample(vec3<f32>(vec3<u32>(select(kind, BAD_OVERFLOW, kind == 0u), 0u, material)), (sample.info + rays) | SAMPLE_BAD);
}

// A block of 8 by 8 pixels, and where it is in a batch.
struct Block {
    // Its first pixel in the whole film.
    corner: vec2<u32>,
    // Columns and rows of it that exist, and more.
    extent: vec2<u32>,
    // Place of its first pixel in the batch.
    first: u32,
    // Places from one of its rows to the next.
    row: u32,
}

// Of a batch of layers of a rectangle.
fn block_of(group: vec3<u32>) -> Block {
    let size = vec2<u32>(params.window_width, params.window_height);
    let begin = group.xy * TILE_BLOCK;
    let first = (group.z * size.y + begin.y) * size.x + begin.x;
    return Block(begin + vec2<u32>(params.window_x, params.window_y), size - begin, first, size.x);
}

// Of a batch of tiles.
@if(adaptive)
fn block_of_tile(number: u32) -> Block {
    let corner = tile_corner(tile_samples[min(number, params.tile_samples - 1u)].tile);
    let extent = select(vec2<u32>(0u), vec2<u32>(params.film_width, params.film_height) - corner, number < params.tile_samples);
    return Block(corner, extent, number * TILE_BLOCK * TILE_BLOCK, TILE_BLOCK);
}

fn place_in(block: Block, pixel: vec2<u32>) -> u32 {
    return block.first + pixel.y * block.row + pixel.x;
}

@compute @workgroup_size(8, 8)
fn gather(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
    @if(adaptive) @builtin(num_workgroups) groups: vec3<u32>,
) {
    @if(few_triangles) keep_boxes(params.root, local, TILE_BLOCK * TILE_BLOCK);
    let tile = local / TILE_PIXELS;
    let slot = local % TILE_PIXELS;
    var block = block_of(group);
    @if(adaptive) {
        if (params.tile_samples > 0u) {
            block = block_of_tile(group.x + group.y * groups.x);
        }
    }
    let dealt = deal_quads(block.corner / TILE_BLOCK);
    let pixel = pixel_of(tile, slot, dealt);
    let exists = all(pixel < block.extent);
    let place = select(0u, place_in(block, pixel), exists);
    let gatherer = load_gatherer(place, exists);
    let extent = scene_extent(params.root);
    var rays = 0u;
    for (var k = 0u; k < TILE_PIXELS; k++) {
        let lender = pixel_of(tile, k, dealt);
        var density = 0.0;
        if (gatherer.exists && all(lender < block.extent)) {
            let point = load_lent(place_in(block, lender));
            if (point.triangle != NO_HIT) {
                let link = link_to(gatherer, point);
                if (link.pdf > 0.0) {
                    var chance = NO_CHANCE;
                    @if(cutout) {
                        // The path's own way is the one that it went; all others are drawn anew.
                        chance = select(pcg4d(vec4<u32>(point.chance, slot, k, 0u)).x | 1u, point.chance, k == slot);
                    }
                    rays += 1u;
                    density = select(0.0, link.pdf, is_seen(link, point, extent, chance));
                }
            }
        }
        densities[(tile * TILE_PIXELS + k) * TILE_PIXELS + slot] = density;
    }
    workgroupBarrier();
    var total = 0.0;
    for (var m = 0u; m < TILE_PIXELS; m++) {
        total += densities[local * TILE_PIXELS + m];
    }
    // A path that is not linked to its own point, by a rounding or because that looks otherwise from there, keeps it to itself.
    totals[local] = select(0.0, total, densities[local * TILE_PIXELS + slot] > 0.0);
    workgroupBarrier();
    if (!gatherer.exists) {
        return;
    }
    var light = vec3<f32>(0.0);
    for (var k = 0u; k < TILE_PIXELS; k++) {
        let lender = pixel_of(tile, k, dealt);
        let sum = totals[tile * TILE_PIXELS + k];
        let linked = sum > 0.0 && densities[(tile * TILE_PIXELS + k) * TILE_PIXELS + slot] > 0.0;
        if (linked || (k == slot && sum == 0.0)) {
            let point = load_lent(place_in(block, lender));
            if (linked) {
                light += link_to(gatherer, point).value / sum * point.radiance;
            } else if (point.triangle != NO_HIT) {
                light += point.weight * point.radiance;
            }
        }
    }
    let index = params.first_layer * params.window_height * params.window_width + place;
    let sample = radiance[index];
    if ((sample.info & SAMPLE_BAD) == 0u) {
        radiance[index] = gathered(sample, light, rays, gatherer.index);
    }
}
