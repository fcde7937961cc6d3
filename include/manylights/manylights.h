/*
 * manylights: light a scene with very many lights, and lose none of them.
 *
 * Each frame a renderer hands in its cameras ("views") and its lights. The library finds out which lights can reach
 * which part of the image and writes that into a few compact buffers in the renderer's own memory. The renderer's
 * shaders include <manylights/query.h>, and loop over the lights of a point:
 *
 *     manylights_create(&settings, &builder, &report);                     once
 *
 *     manylights_plan(builder, &view, 1, &lights, &sizes, &report);        every frame: exact sizes
 *     ... make sure that each buffer has sizes.* bytes, map it ...
 *     manylights_write(builder, &buffers, &report);                        every frame: fill them
 *
 *     manylights_destroy(builder);                                         once
 *
 * Units and spaces
 *   Lengths are in the scene's unit. Matrices are column-major (element [4 * column + row]) and act on column vectors.
 *   A matrix is named target first: view_from_world takes world space to view space.
 *   View depth is the distance from the camera plane along the viewing direction, positive in front of the camera.
 *   Pixel (x, y) covers [x, x + 1) x [y, y + 1); its centre is at (x + 0.5, y + 0.5). Row 0 is the row at clip y = -1
 *   (Vulkan), or at clip y = +1 where ManylightsView.clip_y_up is set (Direct3D, Metal, OpenGL with a top-left origin).
 *
 * The promise
 *   A light affects a point when the squared distance between them is less than the squared range, both positions taken
 *   relative to the camera and rounded once to float (ml_affects in the shader library). For every triple of a pixel, a
 *   view depth and a point, where the point projects within guard_px of the pixel's centre (in x and in y), lies
 * between the near and the far plane, and has that view depth within 2^-20 relative: each light that affects the point
 * is handed out by the query at (pixel, depth), exactly once. Shading in world space far from the origin is covered
 * too: the library widens each sphere by 4 units in the last place of the largest world coordinate involved.
 *
 * Errors
 *   Every function that can fail returns a ManylightsStatus and, where the caller passes a report, says which field
 * broke which rule. Nothing is printed, no exception leaves, no global state is kept. After a failed call the builder
 * is as it was before the call, except that a failed plan leaves nothing to write.
 *
 * Threads
 *   One builder serves one thread at a time; different builders are independent.
 */
#ifndef MANYLIGHTS_MANYLIGHTS_H
#define MANYLIGHTS_MANYLIGHTS_H

#include <stddef.h>
#include <stdint.h>

#define MANYLIGHTS_VERSION_MAJOR 0
#define MANYLIGHTS_VERSION_MINOR 1

#if defined(_WIN32) && defined(MANYLIGHTS_SHARED)
#if defined(MANYLIGHTS_BUILDING)
#define MANYLIGHTS_API __declspec(dllexport)
#else
#define MANYLIGHTS_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define MANYLIGHTS_API __attribute__((visibility("default")))
#else
#define MANYLIGHTS_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* What a call came to. The same values in every version. */
typedef enum ManylightsStatus {
    MANYLIGHTS_OK = 0,
    MANYLIGHTS_INVALID_ARGUMENT = 1, /* a field breaks its rule; the report names both */
    MANYLIGHTS_INVALID_CAMERA = 2,   /* a matrix is not one that the library can use; the report names it */
    MANYLIGHTS_OUT_OF_MEMORY = 3,    /* the allocator returned null */
    MANYLIGHTS_TOO_LARGE = 4,        /* the result would need more than 2^32 - 1 references, nodes or cells */
    MANYLIGHTS_NOT_PLANNED = 5,      /* write without a successful plan before it */
    MANYLIGHTS_DAMAGED = 6           /* validate: the bytes break an invariant; the report names it */
} ManylightsStatus;

/* Where a call failed. Filled on failure, and set to MANYLIGHTS_OK otherwise. */
typedef struct ManylightsReport {
    ManylightsStatus status;
    const char* field; /* static text, e.g. "view.clip_from_view"; never null */
    const char* rule;  /* static text, e.g. "must be a perspective projection"; never null */
    uint64_t index;    /* element of an array (view, light, cell, node, reference) that broke the rule; 0 where none */
} ManylightsReport;

/* The volume of a light: world space, every point closer than range. range in [0, 1e18]; a larger range is taken as
   1e18. A light with range 0 affects nothing. */
typedef struct ManylightsSphere {
    float center[3];
    float range;
} ManylightsSphere;

/* The lights of a frame, read in place and only during manylights_plan. Light i is the ManylightsSphere at
   (const char*)spheres + i * sphere_stride. Lights with a non-finite coordinate, a NaN range or a negative range are
   ignored and counted (ManylightsStats.ignored_lights); the others are unaffected. */
typedef struct ManylightsLights {
    size_t size;          /* sizeof(ManylightsLights) */
    const void* spheres;  /* may be null when count is 0; aligned to 4 */
    size_t sphere_stride; /* bytes, a multiple of 4, at least 16; 0: sizeof(ManylightsSphere) */
    uint32_t count;       /* [0, 2^32 - 2] */
    float motion_margin;  /* [0, 1e18], added to every range: lights may move by this much between plan and shading */
} ManylightsLights;

/* A camera. Perspective projections are recognised from clip_from_view: symmetric, off-centre or jittered; looking
   down -z or +z; depth 0..1 standard, reversed, or with an infinite far plane (OpenGL's -1..1 works as well).
   view_from_world must be a rigid transform (rotation or mirrored rotation, and translation). */
typedef struct ManylightsView {
    size_t size; /* sizeof(ManylightsView) */
    float view_from_world[16];
    float clip_from_view[16];
    uint32_t width;     /* pixels, [1, 65536] */
    uint32_t height;    /* pixels, [1, 65536] */
    float guard_px;     /* [0, 64], see "The promise"; 0.5 covers the whole pixel */
    uint32_t clip_y_up; /* 0: pixel rows grow with clip y (Vulkan); 1: against it */
} ManylightsView;

/* How lights are organised. All of them answer the same shader query. */
typedef enum ManylightsStructure {
    MANYLIGHTS_STRUCTURE_DEFAULT = 0, /* windows */
    MANYLIGHTS_STRUCTURE_LISTS =
        1, /* a list per cell of a tile x slice grid: practical clustered shading, Persson 2013 */
    MANYLIGHTS_STRUCTURE_TREES =
        2, /* a light tree per tile: O'Donnell and Chajdas, Tiled Light Trees, 2017, sections 3.1-3.2 */
    MANYLIGHTS_STRUCTURE_HYBRID = 3, /* per cell a list or a light tree: the same paper, section 3.3 */
    MANYLIGHTS_STRUCTURE_WINDOWS = 4 /* depth windows: per tile a run of its depth-sorted lights for each depth slice;
                                        slice_edges and nodes are empty */
} ManylightsStructure;

typedef void* (*ManylightsAllocate)(void* user, size_t bytes, size_t alignment); /* null: out of memory */
typedef void (*ManylightsRelease)(void* user, void* memory, size_t bytes);
typedef void (*ManylightsTask)(void* context, uint32_t index);
/* Must call task(context, i) for each i in [0, count), in any order, on any threads, and return when all are done. */
typedef void (*ManylightsParallelFor)(void* user, uint32_t count, ManylightsTask task, void* context);

/* Zero in any field means "the default", so a zeroed struct with size set works. */
typedef struct ManylightsSettings {
    size_t size;                 /* sizeof(ManylightsSettings) */
    uint32_t structure;          /* a ManylightsStructure */
    uint32_t tile_px;            /* edge of a tile in pixels, [8, 65536]; default, windows: chosen for each plan, 32
                                    (24 from 500,000 visible lights), doubled while a light has more than 12
                                    references on average; the others: 48 */
    uint32_t slice_count;        /* depth slices of lists and hybrid, [1, 128]; default 16 */
    uint32_t leaf_size;          /* most lights in a tree's leaf, [1, 65535]; default 4 */
    float slice_near;            /* end of the first slice, > 0; default 5 */
    float slice_far;             /* start of the open range behind the exponential slices, > slice_near; default 500 */
    uint32_t max_workers;        /* most tasks that a parallel_for call is asked for, [1, 1024]; default 64 */
    uint64_t max_bytes;          /* budget for all buffers together; over it the tiles become coarser; default: none */
    ManylightsAllocate allocate; /* both or neither; default: malloc and free */
    ManylightsRelease release;
    void* allocator_user;
    ManylightsParallelFor parallel_for; /* default: in the calling thread */
    void* parallel_user;
} ManylightsSettings;

/* Exact byte sizes, an output of plan. Each is a multiple of 4, and may be 0. */
typedef struct ManylightsSizes {
    uint64_t views;       /* MlView per view */
    uint64_t slice_edges; /* float, slice_count + 1 per view */
    uint64_t cells;       /* MlCell */
    uint64_t nodes;       /* MlNode */
    uint64_t references;  /* uint32 light index; windows: two words per reference */
} ManylightsSizes;

/* Where to write. Each pointer must hold the planned size, aligned to 16; null only where that size is 0. The memory
   may be mapped, write-combined memory: it is written once, ascending within a task, and never read. */
typedef struct ManylightsBuffers {
    void* views;
    void* slice_edges;
    void* cells;
    void* nodes;
    void* references;
} ManylightsBuffers;

/* What the last plan found, over all views together unless said otherwise. */
typedef struct ManylightsStats {
    uint64_t bytes;      /* sum of ManylightsSizes */
    uint64_t references; /* (light, cell) pairs */
    uint64_t nodes;      /* tree nodes, padding included; none in windows */
    uint64_t cells;      /* windows: tiles */
    uint64_t empty_cells;
    uint64_t list_cells;     /* not empty, and a plain list (or a tree of one leaf); windows: tiles without a table */
    uint64_t tree_cells;     /* windows: tiles with a table */
    uint64_t visible_lights; /* sum over the views */
    uint64_t ignored_lights; /* non-finite or negative */
    uint64_t first_ignored;  /* index of the first of them; 0 where none */
    uint32_t tile_px;        /* in use; larger than the setting when the budget demanded it */
    uint32_t
        over_budget; /* 1: even one tile for the whole image exceeds max_bytes; the result is complete all the same */
} ManylightsStats;

typedef struct ManylightsBuilder ManylightsBuilder;

/* Makes a builder. settings may be null: all defaults. *builder is null on failure. report may be null in every call.
 */
MANYLIGHTS_API ManylightsStatus manylights_create(const ManylightsSettings* settings, ManylightsBuilder** builder,
                                                  ManylightsReport* report);

/* Releases the builder and all of its memory; null is allowed. */
MANYLIGHTS_API void manylights_destroy(ManylightsBuilder* builder);

/* Culls, sorts, bins and counts: everything up to exact sizes. Reads the lights once. Serves 1 to 8 views. */
MANYLIGHTS_API ManylightsStatus manylights_plan(ManylightsBuilder* builder, const ManylightsView* views,
                                                uint32_t view_count, const ManylightsLights* lights,
                                                ManylightsSizes* sizes, ManylightsReport* report);

/* Writes what was planned. May be called several times after one plan; the bytes are the same. */
MANYLIGHTS_API ManylightsStatus manylights_write(ManylightsBuilder* builder, const ManylightsBuffers* buffers,
                                                 ManylightsReport* report);

/* The lights in view, ascending, of one view of the last plan: what a renderer needs to upload, or to give a shadow
 *map. indices belongs to the builder and is valid until its next plan or destroy. */
MANYLIGHTS_API ManylightsStatus manylights_visible(const ManylightsBuilder* builder, uint32_t view,
                                                   const uint32_t** indices, uint32_t* count, ManylightsReport* report);

/* Statistics of the last plan; all zero before the first. */
MANYLIGHTS_API void manylights_stats(const ManylightsBuilder* builder, ManylightsStats* stats);

/* Checks buffers from any producer, read back from wherever they were: every offset in range, every tree complete,
   every light below light_count, no light twice in a cell. A shader that walks valid buffers stays in bounds and ends.
   builder lends its memory; the buffers need not come from it. */
MANYLIGHTS_API ManylightsStatus manylights_validate(ManylightsBuilder* builder, const ManylightsBuffers* buffers,
                                                    const ManylightsSizes* sizes, uint32_t light_count,
                                                    ManylightsReport* report);

/* The name of a status, e.g. "MANYLIGHTS_OK"; never null. */
MANYLIGHTS_API const char* manylights_status_name(ManylightsStatus status);

#ifdef __cplusplus
}
#endif

#endif
