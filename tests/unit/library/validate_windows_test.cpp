// validate accepts windows made by hand, and refuses each kind of damage.

#include "tests/shader/handmade_windows.h"
#include "tests/unit/library/frame.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

namespace manylights::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kLights = 3000;

// Slices of 16 codes from 100 on; reference i holds 20 codes from 100 + 2 i on, light i.
MadeTile made_tile(MlUint count, MlTileForm form) {
    MadeTile tile;
    tile.base_code = 100;
    tile.form = form;
    for (MlUint i = 0; i < count; ++i) {
        const MlUint near_end = 100 + 2 * (i % 60);
        const bool is_large = form.two_classes != 0 && i % 2 != 0;
        (is_large ? tile.large : tile.small).push_back({i, near_end, near_end + 20, 2, 9, 3, 12});
    }
    return tile;
}

// Tiles of one view: cells 0 to 13 are headers; then the entries of tile 1 (odd: cells 14 to 18, the last half empty),
// of tile 2 (cells 19 to 26), of tile 4 (27 to 30), tile 6 has 2.
const std::vector<MadeTile>& made_tiles() {
    static const std::vector<MadeTile> tiles{{},
                                             made_tile(50, {4, 0, 0, 8, 0, 0, 0}),
                                             made_tile(40, {4, 0, 1, 7, 1, 0, 0}),
                                             made_tile(6, {5, 0, 0, 0, 0, 0, 6}),
                                             made_tile(30, {4, 0, 0, 7, 0, 0, 0}),
                                             {},
                                             made_tile(30, {6, 1, 2, 1, 1, 0, 0})};
    return tiles;
}

void append_view(Frame& frame, const std::vector<MadeTile>& tiles) {
    const MlUint before = static_cast<MlUint>(frame.cells.size());
    append_tiles(tiles, frame.cells, frame.references);
    const MlUint cells = static_cast<MlUint>(frame.cells.size()) - before;
    frame.views.push_back(windows_view(static_cast<MlUint>(tiles.size()), cells, 4.0f));
    frame.views.back().cell_offset = before;
}

void set_sizes(Frame& frame) {
    frame.sizes = {frame.views.size() * sizeof(MlView), 0, frame.cells.size() * sizeof(MlCell), 0,
                   frame.references.size() * sizeof(MlUint)};
}

Frame frame_of(const std::vector<MadeTile>& tiles) {
    Frame frame;
    append_view(frame, tiles);
    set_sizes(frame);
    return frame;
}

// Two views of the tiles.
Frame make_frame() {
    Frame frame;
    append_view(frame, made_tiles());
    append_view(frame, made_tiles());
    set_sizes(frame);
    return frame;
}

ManylightsReport check(Frame& frame, std::uint32_t light_count = kLights) {
    const BuilderPtr builder = make_builder(settings_of(0));
    return validate(builder.get(), frame, light_count);
}

void expect_refusal(Frame frame, const std::string& field, const std::string& rule, std::uint64_t index,
                    std::uint32_t light_count = kLights) {
    const ManylightsReport report = check(frame, light_count);
    EXPECT_EQ(report.status, MANYLIGHTS_DAMAGED) << rule;
    EXPECT_EQ(report.field, field) << report.rule;
    EXPECT_NE(std::string(report.rule).find(rule), std::string::npos) << report.rule << " instead of: " << rule;
    EXPECT_EQ(report.index, index) << report.rule;
}

struct Damage {
    const char* field;
    const char* rule; // a part of it
    std::uint64_t index;
    std::function<void(Frame&)> spoil;
};

void expect_refusals(const std::vector<Damage>& rows) {
    const Frame good = make_frame();
    for (const Damage& row : rows) {
        Frame frame = good;
        ASSERT_EQ(check(frame).status, MANYLIGHTS_OK);
        row.spoil(frame);
        expect_refusal(frame, row.field, row.rule, row.index);
    }
}

// The first cell of a tile's header; the cell of its form and base.
MlCell& places(Frame& f, std::size_t tile) { return f.cells[2 * tile]; }
MlUint& base_code(Frame& f, std::size_t tile) { return f.cells[2 * tile + 1].first; }
MlUint& form(Frame& f, std::size_t tile) { return f.cells[2 * tile + 1].count; }

TEST(ValidateWindows, AcceptsEveryForm) {
    Frame frame = make_frame();
    const ManylightsReport report = check(frame);
    EXPECT_EQ(report.status, MANYLIGHTS_OK) << report.field << ' ' << report.rule << ' ' << report.index;
    EXPECT_EQ(check(frame, 50).status, MANYLIGHTS_OK);
    EXPECT_EQ(check(frame, 49).status, MANYLIGHTS_DAMAGED);
    Frame empty = frame_of({{}, {}});
    EXPECT_EQ(check(empty, 0).status, MANYLIGHTS_OK);
    for (const float scale : {0x1p-126f, 0x1p126f}) {
        empty.views[0].depth_scale = scale;
        EXPECT_EQ(check(empty, 0).status, MANYLIGHTS_OK);
    }
}

TEST(ValidateWindows, RefusesDamagedViews) {
    const char* power = "depth_scale must be a power of two";
    expect_refusals({
        {"views", "slice_count", 1, [](Frame& f) { f.views[1].slice_count = 1; }},
        {"views", "slice_offset", 1, [](Frame& f) { f.views[1].slice_offset = 1; }},
        {"views", "cell_offset", 1, [](Frame& f) { f.views[1].cell_offset += 2; }},
        {"views", "two cells per tile", 1, [](Frame& f) { f.views[1].cell_count = 13; }},
        {"views", "fit their buffer", 1, [](Frame& f) { f.views[1].cell_count += 1; }},
        {"views", power, 1, [](Frame& f) { f.views[1].depth_scale = 3.0f; }},
        {"views", power, 1, [](Frame& f) { f.views[1].depth_scale = 0.0f; }},
        {"views", power, 1, [](Frame& f) { f.views[1].depth_scale = -4.0f; }},
        {"views", power, 1, [](Frame& f) { f.views[1].depth_scale = 0x1p-127f; }},
        {"views", power, 1, [](Frame& f) { f.views[1].depth_scale = 0x1p127f; }},
        {"views", power, 1, [](Frame& f) { f.views[1].depth_scale = kInfinity; }},
        {"views", "reserved", 1, [](Frame& f) { f.views[1].reserved1 = 1; }},
        {"views", "structure", 1, [](Frame& f) { f.views[1].structure = 5; }},
        {"views", "structure", 0, [](Frame& f) { f.views[0].structure = 5; }},
    });
}

TEST(ValidateWindows, RefusesDamagedHeaders) {
    const char* flat = "a flat tile must have one slice";
    expect_refusals({
        {"cells", "first_reference", 2, [](Frame& f) { places(f, 1).first += 1; }},
        {"cells", "first_reference", 10, [](Frame& f) { places(f, 5).first = 0; }},
        {"cells", "first_reference", 0, [](Frame& f) { places(f, 0).first = 0xFFFFFFFFu; }},
        {"cells", "first_entry", 2, [](Frame& f) { places(f, 1).count -= 1; }},
        {"cells", "first_entry", 10, [](Frame& f) { places(f, 5).count += 1; }},
        {"cells", "base_code", 4, [](Frame& f) { base_code(f, 2) = ML_DEPTH_CODE_MAX + 1; }},
        {"cells", "base_code", 0, [](Frame& f) { base_code(f, 0) = 1; }},
        {"cells", "shifts must be at most 24", 4, [](Frame& f) { form(f, 2) |= 25u; }},
        {"cells", "shifts must be at most 24", 4, [](Frame& f) { form(f, 2) |= 25u << 5; }},
        {"cells", "shifts must be at most 24", 4, [](Frame& f) { form(f, 2) |= 25u << 10; }},
        {"cells", "large_shift must be 0", 2, [](Frame& f) { form(f, 1) |= 1u << 10; }},
        {"cells", flat, 6, [](Frame& f) { form(f, 3) |= 1u << 15; }},
        {"cells", flat, 6, [](Frame& f) { form(f, 3) |= 1u << 23; }},
        {"cells", flat, 6, [](Frame& f) { form(f, 3) |= 1u << 24; }},
        {"cells", "the end of the tile before", 8, [](Frame& f) { form(f, 3) -= 1u << 25; }},
        {"cells", "the end of the tile before", 4, [](Frame& f) { form(f, 1) = 0, base_code(f, 1) = 0; }},
        {"cells", "wide from 65,536", 8,
         [](Frame& f) {
             f = frame_of({{}, {}, {}, {}, made_tile(30, {4, 0, 0, 7, 0, 1, 0})});
         }},
    });
    // What only the last tile shows.
    Frame frame = make_frame();
    const std::size_t header = frame.views[1].cell_offset + 12;
    frame.cells[header + 1] = {0, 0};
    expect_refusal(frame, "cells", "must be an entry of a tile", frame.cells[header].count);
    frame = make_frame();
    frame.cells[header + 1].count += 1u << 15;
    expect_refusal(frame, "cells", "entries must lie within the view's cells", header);
}

TEST(ValidateWindows, RefusesDamagedEntries) {
    const char* order = "windows must begin with their class, neither go back nor leave a gap";
    expect_refusals({
        {"cells", order, 14, [](Frame& f) { f.cells[14].first += 1; }},         // slice 0 begins late
        {"cells", order, 15, [](Frame& f) { f.cells[15].first = 50; }},         // ends before it begins
        {"cells", order, 15, [](Frame& f) { f.cells[14].count += 49u << 16; }}, // the next ends earlier
        {"cells", order, 15, [](Frame& f) { f.cells[15].count &= ~0xFFFFu; }},  // begins before the one before
        {"cells", order, 17, [](Frame& f) { f.cells[17].first |= 49u; }},       // a gap
        {"cells", order, 19, [](Frame& f) { f.cells[19].count -= 1; }},         // large ones begin among small ones
        {"cells", order, 22, [](Frame& f) { f.cells[22].count = 39u | 39u << 16; }}, // a gap among large ones
        {"cells", "the word behind an odd number of entries must be 0", 18, [](Frame& f) { f.cells[18].count = 1; }},
        {"references", "light twice", 50, [](Frame& f) { f.cells[18].first += 1u << 16; }},
        {"references", "light twice", 90, [](Frame& f) { f.cells[26].count += 1u << 16; }},
    });
    Frame empty = frame_of({made_tile(1, {4, 0, 0, 1, 0, 0, 0})});
    empty.cells[2] = {0, 0};
    expect_refusal(empty, "cells", "the form must be 0 in a tile without references", 0);
}

TEST(ValidateWindows, RefusesDamagedReferences) {
    expect_refusals({
        {"references", "less than light_count", 7, [](Frame& f) { f.references[14] = kLights; }},
        {"references", "less than light_count", 251, [](Frame& f) { f.references[502] = 0xFFFFFFFFu; }},
        {"references", "light twice", 1, [](Frame& f) { f.references[2] = f.references[0]; }},
        {"references", "light twice", 89, [](Frame& f) { f.references[178] = f.references[100]; }},
        {"references", "x0 must not exceed x1", 3, [](Frame& f) { f.references[7] |= 15u << 16; }},
        {"references", "nor y0 y1", 3, [](Frame& f) { f.references[7] &= 0x0FFFFFFFu; }},
    });
    Frame frame = make_frame();
    frame.sizes.references -= 8;
    expect_refusal(frame, "cells", "must lie within the references", frame.views[1].cell_offset + 12);
    frame = make_frame();
    frame.references.resize(frame.references.size() + 2);
    set_sizes(frame);
    expect_refusal(frame, "references", "must belong to a tile", frame.references.size() / 2 - 1);
    frame = make_frame();
    frame.sizes.references -= 4;
    expect_refusal(frame, "references", "two words each", frame.references.size() - 1);
}

TEST(ValidateWindows, RefusesWhatWindowsDoWithout) {
    Frame frame = make_frame();
    frame.nodes.resize(1);
    frame.sizes.nodes = sizeof(MlNode);
    expect_refusal(frame, "nodes", "windows must have none", 0);
    frame = make_frame();
    frame.slice_edges = {0.0f};
    frame.sizes.slice_edges = sizeof(float);
    expect_refusal(frame, "slice_edges", "as many as the views describe", 0);
}

TEST(ValidateWindows, WideTilesAreThoseOfMoreThan65535References) {
    for (const MlUint two_classes : {0u, 1u})
        for (const MlUint count : {65535u, 65536u, 70000u}) {
            const MlUint wide = count > 65535 ? 1 : 0;
            Frame frame = frame_of({{}, made_tile(count, {4, 0, 0, 8, two_classes, wide, 0}), made_tiles()[2]});
            const ManylightsReport report = check(frame, count);
            EXPECT_EQ(report.status, MANYLIGHTS_OK) << report.rule << ", " << report.index;
            frame.references[2 * 65000] = frame.references[2 * 3];
            expect_refusal(frame, "references", "light twice", 65000, count);
        }
}

// One bit anywhere: what validate accepts is walked in bounds (the query's accessors throw otherwise) and ends.
TEST(ValidateWindows, WhatItAcceptsCanBeWalked) {
    const Frame good = make_frame();
    const BuilderPtr builder = make_builder(settings_of(0));
    Random random(4);
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
        Frame frame = good;
        const std::uint32_t bit = 1u << (random.bits() % 32);
        const auto flip = [&](auto& elements) {
            auto* words = reinterpret_cast<std::uint32_t*>(elements.data());
            words[random.bits() % (elements.size() * sizeof(elements[0]) / 4)] ^= bit;
        };
        if (i % 8 == 0)
            flip(frame.views);
        else if (i % 8 == 1)
            flip(frame.references);
        else
            flip(frame.cells);
        if (validate(builder.get(), frame, kLights).status != MANYLIGHTS_OK) {
            ++refused;
            continue;
        }
        for (int k = 0; k < 20; ++k) {
            const float x = random.between(-10, 130), y = random.between(-10, 30);
            for (const MlUint light : lights_at(frame, i % 2, x, y, random.between(20, 60))) ASSERT_LT(light, kLights);
        }
    }
    EXPECT_GT(refused, 2000);
}

} // namespace
} // namespace manylights::test
