// The library and the paper's pipeline, written apart from each other, build structures of the same size.

#include "reference/paper/pipeline.h"
#include "tests/unit/paper/cases.h"

#include <manylights/manylights.h>

#include <gtest/gtest.h>

namespace manylights::paper {
namespace {

ManylightsStats plan_with_library(const ManylightsView& view, const ManylightsLights& lights, std::uint32_t structure) {
    ManylightsSettings settings{};
    settings.size = sizeof(settings);
    settings.structure = structure;
    ManylightsBuilder* builder = nullptr;
    EXPECT_EQ(manylights_create(&settings, &builder, nullptr), MANYLIGHTS_OK);
    ManylightsSizes sizes{};
    EXPECT_EQ(manylights_plan(builder, &view, 1, &lights, &sizes, nullptr), MANYLIGHTS_OK);
    ManylightsStats stats{};
    manylights_stats(builder, &stats);
    manylights_destroy(builder);
    return stats;
}

// Two floats' worth of freedom at cell edges, and no more: 1%.
void expect_close(std::uint64_t ours, std::uint64_t theirs, const char* what) {
    EXPECT_NEAR(double(ours), double(theirs), 0.01 * double(theirs)) << what;
}

TEST(Library, AgreesOnReferencesAndNodes) {
    const auto spheres = random_lights(20000, 21);
    const ManylightsLights lights = lights_of(spheres);
    CameraCase camera;
    camera.width = 1920;
    camera.height = 1080;
    const ManylightsView view = make_view(camera);
    const std::pair<Structure, std::uint32_t> structures[] = {{Structure::clustered, MANYLIGHTS_STRUCTURE_LISTS},
                                                              {Structure::tree, MANYLIGHTS_STRUCTURE_TREES},
                                                              {Structure::hybrid, MANYLIGHTS_STRUCTURE_HYBRID}};
    PaperPipeline pipeline;
    for (const auto& [structure, code] : structures) {
        SCOPED_TRACE(code);
        const Buffers& ours = pipeline.build({&view, 1}, lights, {.structure = structure});
        const ManylightsStats theirs = plan_with_library(view, lights, code);
        EXPECT_EQ(ours.cells.size(), theirs.cells);
        EXPECT_GT(ours.references.size(), 50000u);
        expect_close(ours.references.size(), theirs.references, "references");
        expect_close(ours.nodes.size(), theirs.nodes, "nodes");
        expect_close(ours.visible_lights, theirs.visible_lights, "visible lights");
        expect_close(ours.list_cells, theirs.list_cells, "list cells");
        expect_close(ours.tree_cells, theirs.tree_cells, "tree cells");
    }
}

} // namespace
} // namespace manylights::paper
