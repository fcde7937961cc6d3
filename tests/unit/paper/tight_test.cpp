// The tight cell test: against a search for the depths at which sphere and pyramid are closest, and against the box.

#include "reference/paper/tight.h"

#include "tests/unit/paper/cases.h"
#include "tests/unit/paper/reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace manylights::paper {
namespace {

double outside(const Wedge& wedge, double side, double depth) {
    return std::max({wedge.low * depth - side, side - wedge.high * depth, 0.0});
}

/// A sphere and a pyramid, and their distance by depth: convex, so that it may be searched.
struct Meeting {
    Wedge column, row;
    CulledLight light;

    double squared_distance(double depth) const {
        const double along = depth - light.depth;
        const double x = outside(column, light.x, depth), y = outside(row, light.y, depth);
        return along * along + x * x + y * y;
    }
    bool meets(double depth) const { return squared_distance(depth) <= double(light.radius) * light.radius; }

    double closest_depth(double low, double high) const {
        for (int step = 0; step < 200; ++step) {
            const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
            (squared_distance(a) < squared_distance(b) ? high : low) =
                squared_distance(a) < squared_distance(b) ? b : a;
        }
        return 0.5 * (low + high);
    }

    /// Where meets() turns, between a depth that does and one that does not.
    double end_between(double does, double does_not) const {
        for (int step = 0; step < 200; ++step) {
            const double middle = 0.5 * (does + does_not);
            (meets(middle) ? does : does_not) = middle;
        }
        return does;
    }

    /// Empty where they do not meet behind the near plane.
    DepthInterval search(double near_depth) const {
        const double low = std::max(double(light.depth) - light.radius, near_depth);
        const double high = double(light.depth) + light.radius;
        const DepthInterval none{1.0, -1.0};
        if (low > high) return none;
        const double closest = closest_depth(low, high);
        if (!meets(closest)) return none;
        return {meets(low) ? low : end_between(closest, low), meets(high) ? high : end_between(closest, high)};
    }
};

Wedge random_wedge(Random& random) {
    const double low = random.between(-1.5, 1.5);
    return {low, low + random.between(0.0, 1.0) * random.between(0.01, 1.0)};
}

// Small and large spheres beside, in front of, across and around the pyramid, and ones that hold the camera.
Meeting random_meeting(Random& random) {
    Meeting meeting{random_wedge(random), random_wedge(random), {}};
    const double depth = random.between(-5.0, 60.0);
    const double spread = random.unit() < 0.5 ? 0.3 : 1.5;
    const auto side = [&](const Wedge& wedge) {
        return float(depth * (0.5 * (wedge.low + wedge.high) + random.between(-spread, spread)));
    };
    const double radius = random.unit() < 0.1 ? random.between(20.0, 200.0) : random.between(0.01, 10.0);
    meeting.light = {side(meeting.column), side(meeting.row), float(depth), float(radius), 0};
    return meeting;
}

DepthInterval depths_of(const Meeting& meeting, float near_depth) {
    const CulledLight& light = meeting.light;
    return meeting_depths(wedge_pieces(meeting.column, light.x), wedge_pieces(meeting.row, light.y), light, near_depth);
}

TEST(Tight, DepthsAreThoseOfASearch) {
    constexpr float kNear = 0.25f;
    Random random(1);
    int met = 0, missed = 0;
    for (int i = 0; i < 200000; ++i) {
        const Meeting meeting = random_meeting(random);
        const DepthInterval found = depths_of(meeting, kNear), expected = meeting.search(kNear);
        SCOPED_TRACE(i);
        if (expected.is_empty()) {
            // Spheres that only touch may count as meeting.
            ASSERT_TRUE(found.is_empty() || found.high - found.low < 1e-4) << found.low << ' ' << found.high;
            ++missed;
            continue;
        }
        // A search among doubles finds an end to about a root of their last place.
        ASSERT_LE(found.low, expected.low + 1e-9);
        ASSERT_GE(found.high, expected.high - 1e-9);
        ASSERT_NEAR(found.low, expected.low, 1e-4);
        ASSERT_NEAR(found.high, expected.high, 1e-4);
        ++met;
    }
    EXPECT_GT(met, 40000);
    EXPECT_GT(missed, 40000);
}

// The wedge's slope is that of the sphere's tangent, rounded. Where more digits say that they meet after all, the test
// must not deny it.
TEST(Tight, SpheresThatTouchMeet) {
    Random random(4);
    const Wedge all{-1e3, 1e3};
    int touching = 0;
    for (int i = 0; i < 100000; ++i) {
        const CulledLight light{float(random.between(0.0, 100.0)), 0.0f, float(random.between(5.0, 1000.0)),
                                float(random.between(0.001, 4.0)), 0};
        const long double x = light.x, depth = light.depth, radius = light.radius;
        const long double t = std::sqrt(x * x + depth * depth - radius * radius);
        const Wedge wedge{-1.0, double((x * t - depth * radius) / (depth * t + x * radius))};
        const long double slope = wedge.high, cross = x - slope * depth,
                          reach = radius * std::sqrt(1.0L + slope * slope);
        if (!(reach - cross > 0x1p-58L * (reach + depth))) continue;
        ++touching;
        ASSERT_FALSE(depths_of({wedge, all, light}, 0.1f).is_empty()) << i;
        ASSERT_FALSE(depths_of({all, wedge, {0.0f, light.x, light.depth, light.radius, 0}}, 0.1f).is_empty()) << i;
    }
    EXPECT_GT(touching, 20000);
}

// All signs of the slopes and of the side, and the borders between them.
TEST(Tight, PiecesFollowTheDistanceFromTheWedge) {
    for (double low : {-2.0, -0.5, 0.0, 0.5})
        for (double width : {0.0, 0.5, 1.0})
            for (double side : {-3.0, -1.0, 0.0, 1.0, 3.0}) {
                const Wedge wedge{low, low + width};
                const WedgePieces pieces = wedge_pieces(wedge, side);
                EXPECT_EQ(pieces.pieces[2].end, std::numeric_limits<double>::infinity());
                EXPECT_LE(pieces.pieces[0].end, pieces.pieces[1].end);
                for (double depth = 0.0625; depth < 16.0; depth += 0.125) {
                    int i = 0;
                    while (depth > pieces.pieces[i].end) ++i;
                    const WedgePieces::Piece& piece = pieces.pieces[i];
                    EXPECT_EQ(std::abs(piece.slope * depth - piece.side), outside(wedge, side, depth))
                        << low << ' ' << width << ' ' << side << ' ' << depth;
                }
            }
}

TEST(Tight, LightsWithoutEndMeetEverything) {
    const CulledLight everywhere{0.0f, 0.0f, 0.0f, INFINITY, 0};
    for (const Wedge& wedge : {Wedge{-2.0, -1.0}, Wedge{-1.0, 1.0}, Wedge{0.0, 0.5}, Wedge{1.0, 1.5}}) {
        const DepthInterval depths = depths_of({wedge, {0.5, 0.75}, everywhere}, 0.1f);
        EXPECT_LE(depths.low, 0.1);
        EXPECT_EQ(depths.high, std::numeric_limits<double>::infinity());
    }
}

// Wedges hold the pixels of their tiles, with the guard and the grid's widening, and the image's last ones no more.
TEST(Tight, WedgesHoldTheirPixels) {
    for (const CameraCase& camera_case : camera_cases()) {
        SCOPED_TRACE(camera_case.name);
        const Camera camera = read_camera(make_view(camera_case));
        const Grid grid = make_grid(camera, 32);
        TightTest test;
        test.set_view(camera, grid);
        for (std::uint32_t pixel = 0; pixel < camera.width; ++pixel) {
            const Wedge& wedge = test.column(pixel / 32);
            const double position = pixel + 0.5;
            const double reach = double(camera.guard_px) + 0.999 * grid.widening_px;
            EXPECT_LT(wedge.low * camera.scale_x + camera.center_x, position - reach);
            EXPECT_GT(wedge.high * camera.scale_x + camera.center_x, position + reach);
        }
        const double last = test.row(grid.tiles_y - 1).high * camera.scale_y + camera.center_y;
        EXPECT_NEAR(last, camera.height - 0.5 + camera.guard_px, 0.1);
    }
}

// A light that ends so close to a slice's edge that the promise lets its last points be asked for in the next slice.
TEST(Tight, SlicesAreThoseOfWidenedDepths) {
    const Camera camera = read_camera(make_view({}));
    const Grid grid = make_grid(camera, 48);
    SliceTable slices;
    slices.update({}, 64);
    TightTest test;
    test.set_view(camera, grid);
    for (std::uint32_t edge = 1; edge < 64; ++edge) {
        for (float side : {-1.0f, 1.0f}) { // which end of the light
            const float depth = slices.edges()[edge], end = depth * (1.0f - side * 0.9f * 0x1p-20f);
            const float center = end * (1.0f - side * 0.125f);
            const CulledLight light{0.0f, 0.0f, center, std::abs(end - center), 0};
            CellBox box;
            CellLight cell_light;
            ASSERT_TRUE(bound(camera, grid, slices, light, box, cell_light));
            std::vector<Scatter> scatter(box.cell_count());
            scatter.resize(test.write_scatter(light, box, slices, 0, scatter.data()));
            const std::uint32_t beyond = side < 0.0f ? edge - 1 : edge, tiles = grid.tiles_x * grid.tiles_y;
            EXPECT_TRUE(
                std::any_of(scatter.begin(), scatter.end(), [&](const Scatter& s) { return s.cell / tiles == beyond; }))
                << "edge " << edge << ", side " << side;
        }
    }
}

/// The cells of a light, in a set.
std::vector<std::set<std::uint32_t>> cells_of_lights(const Buffers& frame, std::size_t lights) {
    std::vector<std::set<std::uint32_t>> cells(lights);
    for (std::uint32_t cell = 0; cell < frame.cells.size(); ++cell)
        for (std::uint32_t i = 0; i < frame.cells[cell].count; ++i)
            cells[frame.references[frame.cells[cell].first + i]].insert(cell);
    return cells;
}

TEST(Tight, CellsAreAPartOfTheBox) {
    const auto lights = random_lights(3000, 2);
    PaperPipeline boxes, tight;
    for (const CameraCase& camera : camera_cases()) {
        SCOPED_TRACE(camera.name);
        const ManylightsView view = make_view(camera);
        Options options{.structure = Structure::clustered, .tile_px = 16, .slice_count = 128};
        const Buffers& whole = boxes.build({&view, 1}, lights_of(lights), options);
        options.cell_test = CellTest::tight;
        const Buffers& part = tight.build({&view, 1}, lights_of(lights), options);
        const auto whole_cells = cells_of_lights(whole, lights.size()),
                   part_cells = cells_of_lights(part, lights.size());
        for (std::size_t i = 0; i < lights.size(); ++i)
            EXPECT_TRUE(std::includes(whole_cells[i].begin(), whole_cells[i].end(), part_cells[i].begin(),
                                      part_cells[i].end()));
    }
}

TEST(Tight, FewerCellsPassThanAreInTheBox) {
    const auto lights = random_lights(3000, 2);
    const ManylightsView view = make_view({});
    PaperPipeline pipeline;
    const auto references = [&](CellTest cell_test) {
        const Options options{
            .structure = Structure::clustered, .tile_px = 16, .slice_count = 128, .cell_test = cell_test};
        return pipeline.build({&view, 1}, lights_of(lights), options).references.size();
    };
    EXPECT_LT(3 * references(CellTest::tight), 2 * references(CellTest::box));
}

// What a wave that walks several lists at once needs: the least next light of its lanes is the next of them all.
TEST(Tight, ListsAscend) {
    const auto lights = random_lights(5000, 3);
    const ManylightsView view = make_view({});
    PaperPipeline pipeline;
    for (CellTest cell_test : {CellTest::box, CellTest::tight}) {
        const Buffers& frame =
            pipeline.build({&view, 1}, lights_of(lights), {.structure = Structure::clustered, .cell_test = cell_test});
        std::size_t longest = 0;
        for (const MlCell& cell : frame.cells) {
            const auto list = frame.references.subspan(cell.first, cell.count);
            EXPECT_EQ(std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()), list.end());
            longest = std::max(longest, list.size());
        }
        EXPECT_GT(longest, 10u);
    }
}

} // namespace
} // namespace manylights::paper
