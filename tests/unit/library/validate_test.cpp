// validate accepts what the builder writes, and refuses each kind of damage.

#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace manylights::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kLights = 3000;

// Deep cells with trees that have inner nodes and padding leaves, and some lists.
Frame make_frame(std::uint32_t structure) {
    ManylightsSettings settings = settings_of(structure);
    settings.slice_count = 4;
    const BuilderPtr builder = make_builder(settings);
    const auto spheres = make_lights(kLights, 9, 150.0, 0.5, 4.0);
    const CameraOptions options;
    return build_frame(builder.get(), {make_view(options), make_view(options)}, spheres);
}

ManylightsReport check(Frame& frame, std::uint32_t light_count = kLights) {
    const BuilderPtr builder = make_builder(settings_of(0));
    return validate(builder.get(), frame, light_count);
}

struct Damage {
    const char* field;
    std::function<void(Frame&)> spoil;
};

void expect_refusals(std::uint32_t structure, const std::vector<Damage>& rows) {
    const Frame good = make_frame(structure);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        Frame frame = good;
        ASSERT_EQ(check(frame).status, MANYLIGHTS_OK);
        rows[i].spoil(frame);
        ASSERT_NE(frame.bytes(), good.bytes()) << "row " << i << " spoiled nothing";
        const ManylightsReport report = check(frame);
        EXPECT_EQ(report.status, MANYLIGHTS_DAMAGED) << "row " << i;
        EXPECT_STREQ(report.field, rows[i].field) << "row " << i << ": " << report.rule;
        EXPECT_STRNE(report.rule, "");
    }
}

TEST(Validate, RefusesDamagedViews) {
    expect_refusals(MANYLIGHTS_STRUCTURE_HYBRID,
                    {
                        {"views", [](Frame& f) { f.views[1].width = 0; }},
                        {"views", [](Frame& f) { f.views[1].height = 65537; }},
                        {"views", [](Frame& f) { f.views[1].tile_px = 0; }},
                        {"views", [](Frame& f) { f.views[1].tile_px = 24; }},
                        {"views", [](Frame& f) { f.views[1].tiles_x += 1; }},
                        {"views", [](Frame& f) { f.views[1].tiles_y -= 1; }},
                        {"views", [](Frame& f) { f.views[1].slice_count = 0; }},
                        {"views", [](Frame& f) { f.views[1].slice_count = 129; }},
                        {"views", [](Frame& f) { f.views[1].slice_offset -= 1; }},
                        {"views", [](Frame& f) { f.views[1].cell_offset += 1; }},
                        {"views", [](Frame& f) { f.views[1].cell_count += 1; }},
                        {"views", [](Frame& f) { f.views[0].structure = 0; }},
                        {"views", [](Frame& f) { f.views[1].structure = ML_STRUCTURE_LISTS; }},
                        {"views", [](Frame& f) { f.views[0].structure = ML_STRUCTURE_TREES; }},
                        {"views", [](Frame& f) { f.views[1].slice_scale = kNan; }},
                        {"views", [](Frame& f) { f.views[1].slice_bias = kInfinity; }},
                        {"views", [](Frame& f) { f.views[1].reserved3 = 1; }},
                    });
}

TEST(Validate, RefusesDamagedSliceEdges) {
    expect_refusals(MANYLIGHTS_STRUCTURE_LISTS,
                    {
                        {"slice_edges", [](Frame& f) { f.slice_edges[0] = 0.5f; }},
                        {"slice_edges", [](Frame& f) { f.slice_edges[2] = kNan; }},
                        {"slice_edges", [](Frame& f) { f.slice_edges[2] = 1.0f; }},
                        {"slice_edges", [](Frame& f) { f.slice_edges[4] = 1e9f; }},
                        {"slice_edges", [](Frame& f) { f.slice_edges.back() = -kInfinity; }},
                    });
}

// The first cell with at least this many references or nodes.
MlCell& cell_with(Frame& frame, MlUint count) {
    return *std::find_if(frame.cells.begin(), frame.cells.end(), [=](MlCell c) { return c.count >= count; });
}

TEST(Validate, RefusesDamagedLists) {
    expect_refusals(
        MANYLIGHTS_STRUCTURE_LISTS,
        {
            {"cells", [](Frame& f) { f.cells.back().first = 0xFFFFFFFF, f.cells.back().count = 0xFFFFFFFF; }},
            {"cells", [](Frame& f) { f.cells.back().first = static_cast<MlUint>(f.references.size()) + 1; }},
            {"cells",
             [](Frame& f) {
                 f.cells.back() = {0, static_cast<MlUint>(f.references.size()) + 1};
             }},
            {"references", [](Frame& f) { f.references[5] = kLights; }},
            {"references", [](Frame& f) { f.references.back() = 0xFFFFFFFF; }},
            {"references",
             [](Frame& f) {
                 MlCell& c = cell_with(f, 2);
                 f.references[c.first] = f.references[c.first + 1];
             }},
            {"references",
             [](Frame& f) {
                 MlCell& c = cell_with(f, 9);
                 f.references[c.first + 8] = f.references[c.first];
             }},
        });
}

// Two cells may not claim the same elements: together they would claim more than there are.
TEST(Validate, RefusesSharedReferences) {
    Frame frame = make_frame(MANYLIGHTS_STRUCTURE_LISTS);
    const MlCell full = cell_with(frame, 2);
    auto empty = std::find_if(frame.cells.begin(), frame.cells.end(), [](MlCell c) { return c.count == 0; });
    ASSERT_NE(empty, frame.cells.end());
    *empty = full;
    EXPECT_EQ(check(frame).status, MANYLIGHTS_DAMAGED);
}

MlNode& root_with(Frame& frame, MlUint nodes) { return frame.nodes[cell_with(frame, nodes).first]; }
MlNode& padding_leaf(Frame& frame) {
    return *std::find_if(frame.nodes.begin(), frame.nodes.end(),
                         [](const MlNode& n) { return ml_node_is_leaf(n.bits) && ml_node_light_count(n.bits) == 0; });
}

std::vector<Damage> damages_of_nodes() {
    return {
        {"cells", [](Frame& f) { f.cells.back().first = static_cast<MlUint>(f.nodes.size()) + 1; }},
        {"cells",
         [](Frame& f) {
             f.cells.back() = {0, static_cast<MlUint>(f.nodes.size()) + 1};
         }},
        {"nodes", [](Frame& f) { cell_with(f, 7).count -= 1; }},
        {"nodes", [](Frame& f) { cell_with(f, 7).first += 1; }},
        {"nodes", [](Frame& f) { root_with(f, 7).bits &= ~ML_NODE_SKIP_MAX; }}, // skip 0 never ends
        {"nodes", [](Frame& f) { root_with(f, 7).bits -= 1; }},
        {"nodes", [](Frame& f) { root_with(f, 7).bits |= ML_NODE_SKIP_MAX; }},
        {"nodes", [](Frame& f) { root_with(f, 7).bits |= ML_NODE_LEAF; }},
        {"nodes", [](Frame& f) { (&root_with(f, 7))[1].bits |= ML_NODE_LEAF; }},
        {"nodes", [](Frame& f) { (&root_with(f, 7))[1].bits ^= 2u; }},
        {"nodes", [](Frame& f) { root_with(f, 7).bits += 1u << ML_NODE_COUNT_SHIFT; }},
        {"nodes", [](Frame& f) { root_with(f, 7).first += 1; }},
        {"nodes", [](Frame& f) { (&root_with(f, 7))[2].first += 1; }},
        {"nodes", [](Frame& f) { root_with(f, 7).max_depth = root_with(f, 7).min_depth; }},
        {"nodes", [](Frame& f) { root_with(f, 7).min_depth = kNan; }},
        {"nodes", [](Frame& f) { (&root_with(f, 7))[2].min_depth = kNan; }},
        {"nodes", [](Frame& f) { (&root_with(f, 7))[2].max_depth = 1e30f; }},
        {"nodes", [](Frame& f) { std::swap((&root_with(f, 7))[2].min_depth, (&root_with(f, 7))[2].max_depth); }},
        {"nodes", [](Frame& f) { padding_leaf(f).max_depth = 1e9f; }},
        {"nodes", [](Frame& f) { padding_leaf(f).min_depth = 0.0f; }},
        {"nodes", [](Frame& f) { padding_leaf(f).bits |= 5u << ML_NODE_COUNT_SHIFT; }},
        {"references", [](Frame& f) { f.references[0] = kLights; }},
        {"references",
         [](Frame& f) {
             MlNode& n = root_with(f, 7);
             f.references[n.first + 4] = f.references[n.first];
         }},
    };
}

TEST(Validate, RefusesDamagedTrees) { expect_refusals(MANYLIGHTS_STRUCTURE_TREES, damages_of_nodes()); }
TEST(Validate, RefusesDamagedHybrids) { expect_refusals(MANYLIGHTS_STRUCTURE_HYBRID, damages_of_nodes()); }

TEST(Validate, RefusesReferencesBeyondTheirBuffer) {
    Frame frame = make_frame(MANYLIGHTS_STRUCTURE_TREES);
    frame.sizes.references -= 4;
    EXPECT_EQ(check(frame).status, MANYLIGHTS_DAMAGED);
    frame.sizes.references = 0;
    EXPECT_EQ(check(frame).status, MANYLIGHTS_DAMAGED);
}

TEST(Validate, RefusesBuffersThatDoNotMatchTheViews) {
    Frame frame = make_frame(MANYLIGHTS_STRUCTURE_LISTS);
    Frame fewer_cells = frame;
    fewer_cells.sizes.cells -= 8;
    EXPECT_EQ(check(fewer_cells).status, MANYLIGHTS_DAMAGED);
    Frame fewer_edges = frame;
    fewer_edges.sizes.slice_edges -= 4;
    EXPECT_EQ(check(fewer_edges).status, MANYLIGHTS_DAMAGED);
    Frame fewer_views = frame;
    fewer_views.sizes.views -= 64;
    EXPECT_EQ(check(fewer_views).status, MANYLIGHTS_DAMAGED);
}

TEST(Validate, RefusesBadSizesByName) {
    const std::pair<const char*, std::function<void(ManylightsSizes&)>> rows[] = {
        {"sizes.views", [](ManylightsSizes& s) { s.views = 0; }},
        {"sizes.views", [](ManylightsSizes& s) { s.views += 1; }},
        {"sizes.views", [](ManylightsSizes& s) { s.views = 64 * 9; }},
        {"sizes.slice_edges", [](ManylightsSizes& s) { s.slice_edges += 2; }},
        {"sizes.cells", [](ManylightsSizes& s) { s.cells += 4; }},
        {"sizes.nodes", [](ManylightsSizes& s) { s.nodes += 8; }},
        {"sizes.references", [](ManylightsSizes& s) { s.references += 1; }},
        {"sizes.references", [](ManylightsSizes& s) { s.references = std::uint64_t{1} << 40; }},
    };
    const Frame good = make_frame(MANYLIGHTS_STRUCTURE_HYBRID);
    for (const auto& [field, spoil] : rows) {
        Frame frame = good;
        spoil(frame.sizes);
        const ManylightsReport report = check(frame);
        EXPECT_EQ(report.status, MANYLIGHTS_INVALID_ARGUMENT) << field;
        EXPECT_STREQ(report.field, field);
    }
    ManylightsReport report{};
    Frame frame = good;
    const BuilderPtr builder = make_builder(settings_of(0));
    const ManylightsBuffers buffers = frame.buffers();
    EXPECT_EQ(manylights_validate(nullptr, &buffers, &frame.sizes, 1, &report), MANYLIGHTS_INVALID_ARGUMENT);
    EXPECT_STREQ(report.field, "builder");
    EXPECT_EQ(manylights_validate(builder.get(), nullptr, &frame.sizes, 1, &report), MANYLIGHTS_INVALID_ARGUMENT);
    EXPECT_STREQ(report.field, "buffers");
    EXPECT_EQ(manylights_validate(builder.get(), &buffers, nullptr, 1, &report), MANYLIGHTS_INVALID_ARGUMENT);
    EXPECT_STREQ(report.field, "sizes");
    ManylightsBuffers missing = buffers;
    missing.nodes = nullptr;
    EXPECT_EQ(manylights_validate(builder.get(), &missing, &frame.sizes, 1, &report), MANYLIGHTS_INVALID_ARGUMENT);
    EXPECT_STREQ(report.field, "buffers.nodes");
}

// One bit anywhere: validate may accept it where it changes no rule, but walking what it accepts stays in bounds (the
// query's accessors throw otherwise) and ends.
TEST(Validate, WhatItAcceptsCanBeWalked) {
    for (const std::uint32_t structure : {MANYLIGHTS_STRUCTURE_LISTS, MANYLIGHTS_STRUCTURE_TREES,
                                          MANYLIGHTS_STRUCTURE_HYBRID, MANYLIGHTS_STRUCTURE_WINDOWS}) {
        const Frame good = make_frame(structure);
        const BuilderPtr builder = make_builder(settings_of(0));
        Random random(structure);
        int refused = 0;
        for (int i = 0; i < 300; ++i) {
            Frame frame = good;
            const std::uint32_t bit = 1u << (random.bits() % 32);
            const auto flip = [&](auto& elements) {
                if (elements.empty()) return;
                auto* words = reinterpret_cast<std::uint32_t*>(elements.data());
                words[random.bits() % (elements.size() * sizeof(elements[0]) / 4)] ^= bit;
            };
            switch (random.bits() % 5) {
            case 0:
                flip(frame.views);
                break;
            case 1:
                flip(frame.slice_edges);
                break;
            case 2:
                flip(frame.cells);
                break;
            case 3:
                flip(frame.references);
                break;
            default:
                flip(frame.nodes);
            }
            if (validate(builder.get(), frame, kLights).status != MANYLIGHTS_OK) {
                ++refused;
                continue;
            }
            for (int k = 0; k < 20; ++k) {
                const float x = random.between(-10, 400);
                const float y = random.between(-10, 300);
                for (const MlUint light : lights_at(frame, 0, x, y, random.between(-1, 600))) ASSERT_LT(light, kLights);
            }
        }
        EXPECT_GT(refused, 50);
    }
}

} // namespace
} // namespace manylights::test
