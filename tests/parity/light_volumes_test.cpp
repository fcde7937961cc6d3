// Light volumes: what is special about them. That they find the lights of brute force is tested with all techniques.

#include "lab/techniques/light_volumes/proxy_mesh.h"
#include "lab/techniques/summary.h"
#include "lab/techniques/verification.h"
#include "reference/oracle/random.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>
#include <array>
#include <map>

namespace manylights::lab {
namespace {

using Corner = std::array<float, 3>;

Corner key_of(const glm::vec4& corner) { return {corner.x, corner.y, corner.z}; }

class ProxyMeshTest : public testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Levels, ProxyMeshTest, testing::Range(0u, 4u));

TEST_P(ProxyMeshTest, is_closed_and_turns_outwards) {
    const ProxyMesh mesh = make_proxy_mesh(GetParam());
    ASSERT_EQ(mesh.corners.size(), std::size_t{60} << (2 * GetParam()));
    std::map<std::pair<Corner, Corner>, int> edges;
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
        for (std::size_t j = 0; j < 3; ++j)
            ++edges[{key_of(mesh.corners[i + j]), key_of(mesh.corners[i + (j + 1) % 3])}];
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << "an edge without a neighbour";
    }
}

// Every face is beyond the unit sphere, and some as near as can be: what the mesh is scaled by is no larger than it
// must.
TEST_P(ProxyMeshTest, has_the_unit_sphere_inside) {
    const ProxyMesh mesh = make_proxy_mesh(GetParam());
    double nearest = 100.0, last = 0.0;
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
        const glm::dvec3 a(mesh.corners[i]), b(mesh.corners[i + 1]), c(mesh.corners[i + 2]);
        nearest = std::min(nearest, glm::dot(glm::normalize(glm::cross(b - a, c - a)), a));
    }
    for (const glm::vec4& corner : mesh.corners) last = std::max(last, glm::length(glm::dvec3(corner)));
    EXPECT_NEAR(nearest, 1.0, 1e-6);
    EXPECT_NEAR(last, mesh.reach, 1e-6);
}

std::vector<OptionValues> options() {
    return {{},
            {{"volume", "front"}},
            {{"volume", "all"}, {"mesh_level", "2"}},
            {{"volume", "rectangle"}},
            {{"order", "near"}, {"mesh_level", "0"}}};
}

class LightVolumesTest : public TechniquesTest {
  protected:
    std::unique_ptr<Technique> prepared(const OptionValues& values, const View& view) {
        std::unique_ptr<Technique> technique = make_technique(device(), "light_volumes", values);
        technique->prepare(view.frame());
        return technique;
    }

    WaveSummary exact_waves(const View& view) {
        const std::unique_ptr<Technique> exact = make_technique(device(), "exact", {});
        exact->prepare(view.frame());
        return exact->waves(view.frame());
    }

    WorkSummary work(const OptionValues& values, const View& view) {
        return summarize(prepared(values, view)->record(view.frame()));
    }

    void expect_exact(const View& view, const char* what) {
        const std::vector<PixelRecord> truth = records_of(device(), kBruteForce, view.frame());
        for (const OptionValues& values : options()) {
            const VerifyResult result = compare(truth, prepared(values, view)->record(view.frame()), view.width);
            EXPECT_EQ(result.wrong_pixels, 0u) << what << ", " << ::testing::PrintToString(values);
        }
    }
};

// A sphere's edge on the image within a thousandth of a pixel of where a point is, from all directions.
TEST_F(LightVolumesTest, hold_lights_whose_edge_is_at_a_point) {
    View view = made_view(device(), 97, 60, 0);
    oracle::Random random(6);
    for (const PointPosition& point : view.positions) {
        if (point.depth == 0.0f) continue;
        const oracle::Double3 direction = random.direction();
        const glm::vec3 side =
            glm::normalize(glm::cross(point.position, glm::vec3(direction.x, direction.y, direction.z)));
        const auto range = static_cast<float>(point.depth * random.octaves(-9, 2));
        const glm::vec3 center = view.camera.position + point.position + side * (range * 0.99999f);
        view.lights.push_back({{{center.x, center.y, center.z}, range}, {1, 1, 1}});
    }
    ASSERT_GT(view.lights.size(), 4000u);
    expect_exact(view, "lights that touch the rays of points");
}

// Nearest and farthest points of spheres at the points, where only depths could leave the lights out.
TEST_F(LightVolumesTest, hold_lights_that_end_at_a_point) {
    View view = made_view(device(), 97, 60, 0);
    const glm::vec3 forward = camera_basis(view.camera, view.width, view.height).forward;
    oracle::Random random(4);
    for (const PointPosition& point : view.positions) {
        if (point.depth == 0.0f || !random.chance(0.5)) continue;
        const auto range = static_cast<float>(point.depth * random.octaves(-6, 2));
        const float side = random.chance(0.5) ? 1.0f : -1.0f;
        const glm::vec3 center = view.camera.position + point.position + forward * (side * range * 0.9999999f);
        view.lights.push_back({{{center.x, center.y, center.z}, range}, {1, 1, 1}});
    }
    ASSERT_GT(view.lights.size(), 2000u);
    expect_exact(view, "lights that end at points");
}

// The camera in the middle of a sphere, at its edge, and just outside: what it cuts is drawn all the same.
TEST_F(LightVolumesTest, hold_lights_around_and_beside_the_camera) {
    View view = made_view(device(), 97, 60, 0);
    oracle::Random random(5);
    for (int i = 0; i < 1000; ++i) {
        const oracle::Double3 direction = random.direction();
        const double range = random.octaves(-4, 10),
                     distance = range * (i % 2 == 0 ? random.between(0, 1.5) : random.between(0.999, 1.001));
        const glm::vec3 center =
            view.camera.position + glm::vec3(direction.x, direction.y, direction.z) * float(distance);
        view.lights.push_back({{{center.x, center.y, center.z}, static_cast<float>(range)}, {1, 1, 1}});
    }
    expect_exact(view, "lights around the camera");
}

TEST_F(LightVolumesTest, hold_lights_that_are_everywhere) {
    View view = made_view(device(), 97, 60, 300);
    for (Light& light : view.lights) light.sphere.range = 1e18f;
    expect_exact(view, "lights everywhere");
    view.positions.assign(view.positions.size(), {glm::vec3(0.0f), 0.0f});
    view.points.positions().upload(view.positions);
    expect_exact(view, "sky everywhere");
}

// Sums beyond 32 bits, to which fragments add in two halves.
TEST_F(LightVolumesTest, add_radiance_beyond_32_bits) {
    View view = made_view(device(), 47, 33, 900);
    for (Light& light : view.lights) {
        light.sphere.range *= 30.0f;
        for (float& channel : light.color) channel *= 1e4f;
    }
    std::int64_t most = 0;
    for (const PixelRecord& record : records_of(device(), kBruteForce, view.frame()))
        most = std::max(most, record.radiance[0]);
    EXPECT_GT(most, std::int64_t{1} << 34);
    expect_exact(view, "bright lights");
}

// Blending adds in the order of primitives: in that of the lights the picture is brute force's, bit for bit.
TEST_F(LightVolumesTest, make_the_picture_of_brute_force_in_the_order_of_lights) {
    const View view = made_view(device(), 97, 60, 3000);
    const std::unique_ptr<Technique> brute_force = make_technique(device(), "brute_force", {});
    brute_force->prepare(view.frame());
    const std::vector<float> truth = brute_force->shade(view.frame());
    for (const char* volume : {"back", "all", "rectangle"}) {
        const std::unique_ptr<Technique> technique = prepared({{"volume", volume}}, view);
        EXPECT_EQ(technique->shade(view.frame()), truth) << volume;
        EXPECT_EQ(technique->shade(view.frame()), truth) << volume << ", once more";
        EXPECT_EQ(technique->stats().shade_ms.size(), 2u);
    }
    EXPECT_NE(prepared({{"order", "near"}}, view)->shade(view.frame()), truth) << "the order is that of the lights";
}

TEST_F(LightVolumesTest, shade_fewer_points_where_depths_are_compared_and_meshes_are_finer) {
    const View view = made_view(device(), 48, 33, 1000);
    const double all = work({{"volume", "all"}}, view).tested_mean;
    EXPECT_LT(work({}, view).tested_mean, 0.9 * all);
    EXPECT_LT(work({{"volume", "front"}}, view).tested_mean, 0.9 * all);
    EXPECT_LT(all, work({{"volume", "rectangle"}}, view).tested_mean);
    for (const char* volume : {"back", "front", "all"}) {
        double coarser = 1e9;
        for (const char* level : {"0", "1", "2", "3"}) {
            const double tested = work({{"volume", volume}, {"mesh_level", level}}, view).tested_mean;
            EXPECT_LT(tested, coarser) << volume << " " << level;
            coarser = tested;
        }
    }
}

// A wave of one lane touches what its pixel is said to test; larger ones touch no light twice.
TEST_F(LightVolumesTest, log_what_they_record) {
    View view = made_view(device(), 1, 1, 5000);
    view.positions = {{camera_basis(view.camera, 1, 1).forward * 20.0f, 20.0f}};
    view.points.positions().upload(view.positions);
    const View large = made_view(device(), 48, 33, 1000);
    const WaveSummary exact = exact_waves(large);
    for (const OptionValues& values : options()) {
        const std::unique_ptr<Technique> technique = prepared(values, view);
        const PixelRecord record = technique->record(view.frame()).front();
        EXPECT_GT(record.affecting, 0u);
        const WaveSummary waves = technique->waves(view.frame());
        for (const WaveWork& work : {waves.lanes_64, waves.lanes_32}) {
            EXPECT_EQ(work.waves, 1u);
            EXPECT_EQ(work.tested, record.tested) << ::testing::PrintToString(values);
            EXPECT_EQ(work.affecting, record.affecting) << ::testing::PrintToString(values);
        }
        const WaveSummary drawn = prepared(values, large)->waves(large.frame());
        EXPECT_EQ(drawn.lanes_64.affecting, exact.lanes_64.affecting);
        EXPECT_EQ(drawn.lanes_64.waves, exact.lanes_64.waves);
    }
}

TEST_F(LightVolumesTest, say_what_they_hold_and_what_they_serve) {
    const View view = made_view(device(), 97, 60, 3000);
    const TechniqueStats stats = prepared({}, view)->stats();
    EXPECT_EQ(stats.structure_bytes, 240 * 16 + stats.visible_lights * 36);
    EXPECT_EQ(stats.references, 0u);
    EXPECT_TRUE(prepared({}, view)->info().needs_depth);
    EXPECT_FALSE(prepared({{"volume", "all"}}, view)->info().needs_depth);
    EXPECT_FALSE(prepared({{"volume", "all"}}, view)->info().serves_air);
}

} // namespace
} // namespace manylights::lab
