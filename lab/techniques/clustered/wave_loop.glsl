// Shading of lists by waves: the lanes walk the union of their cells' lists, which ascend, and each light that any of them
// has is loaded once, for all of them. Each step takes the least of the lanes' next lights; the lanes whose next it is
// test it and go on. Where all lanes have the same list, which is most often, it is the next of any of them.
//
// Every lane goes through its own list whatever the others do: should the lists not ascend, or a wave fall apart into
// parts that walk on their own, lights are loaded more often, and none is lost. Of those that walk together, at least the
// one that the step's light comes from goes on.
//
// With MANYLIGHTS_STEPS a record's nodes are the lights that the wave loads while the lane takes part, and its references
// the lanes of a wave: for a test.
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "lab/techniques/cursor_buffers.glsl"

// A lane's place in its list.
struct Walk {
    MlCursor cursor;
    uint next;
    bool has_next;
#if defined(MANYLIGHTS_STEPS)
    uint steps; // that the lane took part in
#endif
};

// The wave's light, which is loaded by all lanes alike, and tested by those whose next it is.
void take_step(inout Pixel pixel, inout Walk walk, uint light) {
    vec4 sphere = spheres.d[light];
#if defined(MANYLIGHTS_STEPS)
    walk.steps += 1u;
#endif
    if (walk.next != light) return;
    if (ml_affects(pixel.surface.position, sphere.xyz, sphere.w)) shade_light(pixel, light, sphere);
    walk.has_next = ml_next(walk.cursor, walk.next);
}

void main() {
    Pixel pixel = begin_pixel(true);
    if (pixel.is_shaded) {
        Walk walk;
#if defined(MANYLIGHTS_STEPS)
        walk.steps = 0u;
#endif
        walk.cursor = ml_begin(views.d[0], vec2(pixel.coordinates) + 0.5, pixel.depth);
        bool is_one_list = subgroupAllEqual(walk.cursor.reference); // two that begin alike are one, or empty
        walk.has_next = ml_next(walk.cursor, walk.next);
        if (is_one_list) {
            while (walk.has_next) take_step(pixel, walk, subgroupBroadcastFirst(walk.next));
        } else {
            while (walk.has_next) take_step(pixel, walk, subgroupMin(walk.next));
        }
#if defined(MANYLIGHTS_RECORD)
        pixel.record.tested = walk.cursor.tested;
        pixel.record.nodes = walk.cursor.nodes;
        pixel.record.references = walk.cursor.references;
#endif
#if defined(MANYLIGHTS_STEPS)
        pixel.record.nodes = walk.steps;
        pixel.record.references = gl_SubgroupSize;
#endif
    }
    end_pixel(pixel);
}
