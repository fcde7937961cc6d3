// Shading through lists and trees with what Tiled Light Trees varies in its shaders: three paths by a vote of the
// workgroup and a tree in workgroup memory (section 3.4), lights stored once per reference (figure 5). The work is that
// of the library's cursor: the same nodes are visited and the same lights tested; only where they are read differs.
#include "lab/techniques/structure_accessors.glsl"

layout(constant_id = 0) const uint kThreePaths = 0u;
layout(constant_id = 1) const uint kCopyRoom = 1u; // nodes in workgroup memory; 1: none, for a tree has three
layout(constant_id = 2) const uint kHasRecords = 0u;

// A light as light_records.h has it: in the place of the reference to it.
struct LightRecord {
    vec4 sphere;
    vec3 color;
    uint light;
};
layout(std430, set = 0, binding = 10) readonly buffer LightRecords { LightRecord d[]; } light_records;

// A cursor hands out lights, or with records the places of these.
uint reference_or_place(uint i) { return kHasRecords != 0u ? i : references.d[i]; }

#define ML_REFERENCE(i) reference_or_place(i)
#include <manylights/query.h>

const uint kLists = 1u, kTrees = 2u; // of a workgroup's pixels; both: mixed
shared uint walked_kinds;
shared uint least_first, greatest_first, least_end, greatest_end;
shared uvec4 copied_nodes[kCopyRoom];

void test_light(inout Pixel pixel, uint handed) {
    uint light = handed;
    vec4 sphere;
    if (kHasRecords != 0u) {
        light = light_records.d[handed].light;
        sphere = light_records.d[handed].sphere;
    } else {
        sphere = spheres.d[handed];
    }
    touch_light(light);
    if (!ml_affects(pixel.surface.position, sphere.xyz, sphere.w)) return;
    if (kHasRecords != 0u)
        shade_colored_light(pixel, light, sphere, light_records.d[handed].color);
    else
        shade_light(pixel, light, sphere);
}

// Of the pixels that have something to walk: lists, trees or both, and whether all have the same nodes.
void vote(MlCursor cursor) {
    if (gl_LocalInvocationIndex == 0u) {
        walked_kinds = greatest_first = greatest_end = 0u;
        least_first = least_end = 0xFFFFFFFFu;
    }
    barrier();
    if (cursor.node != cursor.node_end) {
        atomicOr(walked_kinds, ml_node_is_leaf(nodes.d[cursor.node].w) ? kLists : kTrees);
        atomicMin(least_first, cursor.node);
        atomicMax(greatest_first, cursor.node);
        atomicMin(least_end, cursor.node_end);
        atomicMax(greatest_end, cursor.node_end);
    }
    barrier();
}

// The condition is the same for the whole workgroup: memory of a workgroup is shared by it, and not by less.
bool copy_tree() {
    if (walked_kinds != kTrees || least_first != greatest_first || least_end != greatest_end) return false;
    uint count = least_end - least_first;
    if (count > kCopyRoom) return false;
    for (uint i = gl_LocalInvocationIndex; i < count; i += 64u) copied_nodes[i] = nodes.d[least_first + i];
    barrier();
    return true;
}

void visit_leaf(inout Pixel pixel, inout MlCursor cursor, MlNode leaf) {
    uint end = leaf.first + ml_node_light_count(leaf.bits);
    for (uint i = leaf.first; i < end; ++i) test_light(pixel, reference_or_place(i));
#if defined(ML_COUNTERS)
    cursor.tested += end - leaf.first;
    cursor.references += end - leaf.first;
#endif
}

bool holds(MlNode node, float depth) { return node.min_depth <= depth && depth <= node.max_depth; }

// A list is one leaf, or several in a row.
void walk_list(inout Pixel pixel, inout MlCursor cursor) {
    for (uint i = cursor.node; i < cursor.node_end; ++i) {
        MlNode leaf = touched_node(i);
        if (holds(leaf, cursor.depth)) visit_leaf(pixel, cursor, leaf);
#if defined(ML_COUNTERS)
        cursor.nodes += 1u;
#endif
    }
}

// Listing 3. A copied tree counts like another one: what is counted are the nodes that a pixel compares.
void walk_tree(inout Pixel pixel, inout MlCursor cursor, bool is_copied) {
    for (uint i = cursor.node; i < cursor.node_end;) {
        MlNode node;
        if (is_copied) {
            touch_node(2u * i);
            node = ml_node_from_words(copied_nodes[i - least_first]);
        } else {
            node = touched_node(i);
        }
        bool hit = holds(node, cursor.depth);
        if (hit && ml_node_is_leaf(node.bits)) visit_leaf(pixel, cursor, node);
        i += hit ? 1u : ml_node_skip_count(node.bits);
#if defined(ML_COUNTERS)
        cursor.nodes += 1u;
#endif
    }
}

void walk_mixed(inout Pixel pixel, inout MlCursor cursor) {
    uint handed;
    while (ml_next(cursor, handed)) test_light(pixel, handed);
}

void main() {
    Pixel pixel = begin_pixel(true);
    MlCursor cursor;
    cursor.node = cursor.node_end = cursor.reference = cursor.reference_end = 0u;
    if (pixel.is_shaded) cursor = ml_begin(views.d[0], vec2(pixel.coordinates) + 0.5, pixel.depth);
    if (kThreePaths != 0u || kCopyRoom > 1u) vote(cursor);
    bool is_copied = kCopyRoom > 1u && copy_tree();
    if (pixel.is_shaded) {
        if (is_copied || kThreePaths != 0u && walked_kinds == kTrees)
            walk_tree(pixel, cursor, is_copied);
        else if (kThreePaths != 0u && walked_kinds == kLists)
            walk_list(pixel, cursor);
        else
            walk_mixed(pixel, cursor);
#if defined(MANYLIGHTS_RECORD)
        pixel.record.tested = cursor.tested;
        pixel.record.nodes = cursor.nodes;
        pixel.record.references = cursor.references;
#endif
    }
    end_pixel(pixel);
}
