// The truth by the grid oracle: equal to what brute force finds on the device, and checked by one that sees every
// damage.

#include "lab/renderer/renderer.h"
#include "lab/scene/error.h"
#include "lab/scene/scene.h"
#include "lab/techniques/light_stream.h"
#include "lab/techniques/shared_work.h"
#include "lab/techniques/truth.h"
#include "lab/techniques/verification.h"
#include "reference/oracle/random.h"
#include "tests/parity/techniques_fixture.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <limits>
#include <stdexcept>
#include <thread>

namespace manylights::lab {

namespace {

class TruthTest : public TechniquesTest {};

PointLists lists_of(const View& view) { return find_point_lists(view.frame(), view.positions); }

ListCheck check(const View& view, const PointLists& lists) { return check_lists(view.frame(), lists, view.positions); }

// The truth knows sets, no radiance and no work. Returns how many lights affect the points.
std::uint64_t expect_sets_of_brute_force(gpu::Device& device, const Frame& frame) {
    const std::vector<PointPosition> positions = frame.points.download_positions();
    const PointLists lists = find_point_lists(frame, positions);
    const auto truth = light_set_records(frame, lists, positions, frame.points.download_normals());
    std::vector<PixelRecord> got = records_of(device, kBruteForce, frame);
    for (PixelRecord& record : got) std::ranges::fill(record.radiance, 0);
    const VerifyResult result = compare(truth, got, frame.width);
    EXPECT_EQ(result.wrong_pixels, 0u) << "first at " << result.first_x << ", " << result.first_y;
    EXPECT_EQ(light_set_hash(truth), light_set_hash(got));
    return lists.lights.size();
}

// The pixel among the checked ones, from the first on, whose list has at least so many lights.
std::size_t checked_pixel_with(const View& view, const PointLists& lists, std::size_t lights) {
    for (const std::size_t pixel : checked_pixels(view.positions))
        if (lists.of(pixel).size() >= lights) return pixel;
    throw std::logic_error("no list is that long");
}

void insert(PointLists& lists, std::size_t pixel, std::size_t place, std::uint32_t light) {
    lists.lights.insert(lists.lights.begin() + static_cast<std::ptrdiff_t>(lists.first[pixel] + place), light);
    for (std::size_t i = pixel + 1; i < lists.first.size(); ++i) ++lists.first[i];
}

void remove(PointLists& lists, std::size_t pixel, std::size_t place) {
    lists.lights.erase(lists.lights.begin() + static_cast<std::ptrdiff_t>(lists.first[pixel] + place));
    for (std::size_t i = pixel + 1; i < lists.first.size(); ++i) --lists.first[i];
}

/// A vector at a right angle to the normal, up to rounding.
glm::vec3 sideways(const glm::vec3& normal, oracle::Random& random) {
    const oracle::Double3 n{normal.x, normal.y, normal.z}, d = random.direction();
    const oracle::Double3 side = d - n * (oracle::dot(n, d) / oracle::dot(n, n));
    return glm::vec3(side.x, side.y, side.z);
}

} // namespace

TEST_F(TruthTest, records_are_those_of_brute_force) {
    const std::pair<std::uint32_t, std::uint32_t> sizes[] = {{1, 1}, {47, 33}, {97, 60}, {33, 200}};
    for (const auto& [width, height] : sizes)
        for (const std::uint32_t count : {0u, 1u, 1234u}) {
            const View view = made_view(device(), width, height, count);
            const std::uint64_t affecting = expect_sets_of_brute_force(device(), view.frame());
            if (count == 1234 && width > 1) {
                EXPECT_GT(affecting, 1234u);
            }
        }
}

TEST_F(TruthTest, records_are_those_of_brute_force_in_a_built_in_scene) {
    const Scene scene = load_scene("canyon", Detail::low);
    const Camera camera = find_camera(scene, "");
    const PointBuffer points = Renderer(device(), scene).render_points(camera, 96, 54);
    LightOptions options;
    options.count = 20000;
    const LightSet set = make_lights(scene, camera, options);
    EXPECT_GT(expect_sets_of_brute_force(device(), {scene, camera, 96, 54, set.lights, points}), 5000u);
}

TEST_F(TruthTest, unusable_lights_are_in_no_list) {
    View view = made_view(device(), 47, 33, 200);
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    view.lights[3].sphere.range = -50.0f;
    view.lights[7].sphere.range = nan;
    view.lights[40].sphere.center[0] = nan;
    view.lights[41].sphere.center[1] = inf;
    view.lights[90].sphere.range = inf;
    expect_sets_of_brute_force(device(), view.frame());
    const PointLists lists = lists_of(view);
    for (const std::uint32_t light : {3u, 7u, 40u, 41u})
        EXPECT_EQ(std::ranges::count(lists.lights, light), 0) << "light " << light;
    EXPECT_FALSE(check(view, lists).first_wrong);
}

// Lights at a right angle to the normal: rounding alone decides on which side they are, so the sum must be the
// device's.
TEST_F(TruthTest, front_sets_are_decided_by_the_bits_of_the_device) {
    View view = made_view(device(), 47, 33, 4000);
    oracle::Random random(4);
    view.camera.position = glm::vec3(0.0f);
    for (PointPosition& point : view.positions) point.position *= 1.0f / 1024.0f;
    view.points.positions().upload(view.positions);
    for (Light& light : view.lights) {
        const std::size_t pixel = random.below(47 * 33);
        const glm::vec3 center = view.positions[pixel].position + sideways(view.normals[pixel].normal, random);
        light.sphere = {{center.x, center.y, center.z}, 1.25f};
    }
    EXPECT_GT(expect_sets_of_brute_force(device(), view.frame()), 4000u);
}

TEST_F(TruthTest, lists_are_ascending_and_empty_for_sky) {
    const View view = made_view(device(), 47, 33, 1234);
    const PointLists lists = lists_of(view);
    ASSERT_EQ(lists.first.size(), 47u * 33u + 1u);
    EXPECT_EQ(lists.first.front(), 0u);
    EXPECT_EQ(lists.first.back(), lists.lights.size());
    const LightStream stream = make_light_stream(view.frame());
    for (std::size_t pixel = 0; pixel < view.positions.size(); ++pixel) {
        const PointPosition& point = view.positions[pixel];
        std::vector<std::uint32_t> wanted;
        if (point.depth > 0.0f) wanted = affecting_lights(stream, point.position);
        ASSERT_TRUE(std::ranges::equal(lists.of(pixel), wanted)) << "pixel " << pixel;
    }
}

TEST_F(TruthTest, lists_are_the_same_for_any_number_of_threads) {
    const View view = made_view(device(), 97, 60, 1234);
    const PointLists one = find_point_lists(view.frame(), view.positions, 1);
    for (const unsigned threads : {0u, 2u, 3u, 64u}) {
        const PointLists several = find_point_lists(view.frame(), view.positions, threads);
        EXPECT_EQ(several.first, one.first);
        EXPECT_EQ(several.lights, one.lights);
    }
}

TEST_F(TruthTest, lists_that_hold_too_much_are_refused) {
    const View view = made_view(device(), 47, 33, 1234);
    const std::uint64_t listed = lists_of(view).lights.size();
    EXPECT_EQ(find_point_lists(view.frame(), view.positions, 0, listed).lights.size(), listed);
    EXPECT_THROW((void)find_point_lists(view.frame(), view.positions, 0, listed - 1), InputError);
}

TEST_F(TruthTest, check_takes_all_points_of_a_small_view_and_enough_of_a_large_one) {
    const View small = made_view(device(), 47, 33, 100), large = made_view(device(), 97, 60, 100);
    const auto shaded = std::ranges::count_if(small.positions, [](const PointPosition& p) { return p.depth > 0.0f; });
    EXPECT_EQ(check(small, lists_of(small)).points, static_cast<std::size_t>(shaded));
    EXPECT_EQ(check(large, lists_of(large)).points, kCheckedPoints);

    const std::vector<std::size_t> pixels = checked_pixels(large.positions);
    EXPECT_EQ(std::ranges::adjacent_find(pixels, std::ranges::greater_equal()), pixels.end()); // each once
    std::size_t per_quarter[4] = {};
    for (const std::size_t pixel : pixels) {
        EXPECT_GT(large.positions[pixel].depth, 0.0f);
        ++per_quarter[pixel * 4 / large.positions.size()];
    }
    for (const std::size_t count : per_quarter) EXPECT_GT(count, kCheckedPoints / 5);
}

TEST_F(TruthTest, check_sees_every_damage_to_a_list) {
    for (const auto& [width, height] : {std::pair{47u, 33u}, std::pair{97u, 60u}}) {
        const View view = made_view(device(), width, height, 1500);
        const PointLists right = lists_of(view);
        EXPECT_FALSE(check(view, right).first_wrong);
        const std::size_t pixel = checked_pixel_with(view, right, 3);
        const std::span<const std::uint32_t> list = right.of(pixel);
        std::uint32_t stranger = 0;
        while (std::ranges::binary_search(list, stranger)) ++stranger;

        const std::function<void(PointLists&)> damages[] = {
            [&](PointLists& lists) { remove(lists, pixel, 0); },
            [&](PointLists& lists) { remove(lists, pixel, list.size() - 1); },
            [&](PointLists& lists) { insert(lists, pixel, 1, list[0]); },
            [&](PointLists& lists) {
                insert(lists, pixel, std::ranges::lower_bound(list, stranger) - list.begin(), stranger);
            },
            [&](PointLists& lists) { lists.lights[lists.first[pixel] + 1] = list[0]; }, // as many, but one twice
            [&](PointLists& lists) {
                std::swap(lists.lights[lists.first[pixel]], lists.lights[lists.first[pixel] + 1]);
            },
            [&](PointLists& lists) { lists.lights[lists.first[pixel + 1] - 1] = 1500; }, // there is no such light
            [&](PointLists& lists) { // as many, in order, but one of them from elsewhere
                remove(lists, pixel, 0);
                const auto rest = lists.of(pixel);
                insert(lists, pixel, std::ranges::lower_bound(rest, stranger) - rest.begin(), stranger);
            },
        };
        for (const auto& damage : damages) {
            PointLists lists = right;
            damage(lists);
            EXPECT_EQ(check(view, lists).first_wrong, pixel) << "damage " << &damage - damages;
        }
    }
}

// More lights than a block, and a number that no block divides.
TEST_F(TruthTest, check_asks_the_first_light_and_the_last) {
    View view = made_view(device(), 47, 33, 5001);
    for (const std::size_t light : {std::size_t{0}, std::size_t{1023}, std::size_t{1024}, std::size_t{5000}})
        view.lights[light].sphere.range = 1e6f;
    const PointLists right = lists_of(view);
    EXPECT_FALSE(check(view, right).first_wrong);
    for (const std::uint32_t light : {0u, 1023u, 1024u, 5000u}) {
        PointLists lists = right;
        const std::size_t pixel = checked_pixels(view.positions).back();
        const auto list = right.of(pixel);
        remove(lists, pixel, static_cast<std::size_t>(std::ranges::lower_bound(list, light) - list.begin()));
        EXPECT_EQ(check(view, lists).first_wrong, pixel) << "light " << light;
    }
}

TEST(SharedWork, does_each_part_once) {
    for (const unsigned threads : {0u, 1u, 2u, 7u})
        for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{100}}) {
            std::vector<std::atomic<int>> calls(count);
            share_work(count, threads, [&](std::size_t i) { ++calls[i]; });
            for (const std::atomic<int>& call : calls) EXPECT_EQ(call, 1);
        }
}

TEST(SharedWork, throws_what_a_part_throws) {
    const auto throw_at_40 = [](std::size_t i) {
        if (i == 40) throw std::runtime_error("part 40");
    };
    for (const unsigned threads : {1u, 3u}) EXPECT_THROW(share_work(50, threads, throw_at_40), std::runtime_error);
}

// The calling thread holds its part until another one has thrown.
TEST(SharedWork, throws_what_a_part_of_another_thread_throws) {
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<bool> has_thrown = false;
    const auto work = [&](std::size_t) {
        if (std::this_thread::get_id() == caller) {
            has_thrown.wait(false);
            return;
        }
        has_thrown = true;
        has_thrown.notify_all();
        throw std::runtime_error("not the caller");
    };
    EXPECT_THROW(share_work(50, 2, work), std::runtime_error);
}

} // namespace manylights::lab
