#include "lab/techniques/truth.h"

#include "lab/techniques/light_stream.h"
#include "lab/techniques/shared_work.h"
#include "reference/oracle/light_hash.h"

#include <manylights/format.h>

#include <algorithm>

namespace manylights::lab {

namespace {

// Whether N.L > 0 as shade_light of shading_pass.glsl decides it: the stored normal, the direction as it is, summed in
// this order.
bool is_front(const PointPosition& point, const PointNormal& surface, const glm::vec4& sphere) {
    const float x = sphere.x - point.position.x;
    const float y = sphere.y - point.position.y;
    const float z = sphere.z - point.position.z;
    const glm::vec3& normal = surface.normal;
    return normal.x * x + normal.y * y + normal.z * z > 0.0f;
}

void add_light(PixelRecord& record, std::uint32_t light, bool front) {
    const std::uint32_t hash_a = light_hash_a(light), hash_b = light_hash_b(light);
    record.affecting += 1;
    record.hash_a += hash_a;
    record.hash_b += hash_b;
    if (!front) return;
    record.front += 1;
    record.front_hash_a += hash_a;
    record.front_hash_b += hash_b;
}

/// The membership stream apart by coordinate, so that a compiler can test several lights at once.
struct LightColumns {
    explicit LightColumns(const LightStream& stream) {
        for (std::uint32_t i = 0; i < stream.light_count(); ++i) {
            const glm::vec4& sphere = stream.spheres[i];
            x.push_back(sphere.x);
            y.push_back(sphere.y);
            z.push_back(sphere.z);
            range.push_back(sphere.w);
        }
    }
    std::size_t size() const { return range.size(); }
    bool affects(MlFloat3 point, std::size_t light) const {
        return ml_affects(point, {x[light], y[light], z[light]}, range[light]);
    }

    std::vector<float> x, y, z, range;
};

// How many of the lights [first, end) affect the point. The columns are named apart from their vectors and the loop has
// no branch: so it is vectorised.
std::uint32_t count_affecting(const LightColumns& lights, MlFloat3 point, std::size_t first, std::size_t end) {
    const float *x = lights.x.data(), *y = lights.y.data(), *z = lights.z.data(), *range = lights.range.data();
    std::uint32_t count = 0;
    for (std::size_t i = first; i < end; ++i) count += ml_affects(point, {x[i], y[i], z[i]}, range[i]) ? 1u : 0u;
    return count;
}

MlFloat3 point_of(const PointPosition& point) { return {point.position.x, point.position.y, point.position.z}; }

// Blocks of lights stay in the processor's nearest cache while all points of a group pass them.
std::vector<std::uint32_t> count_affecting(const LightColumns& lights, std::span<const PointPosition> positions,
                                           std::span<const std::size_t> pixels) {
    constexpr std::size_t kBlock = 1024;
    std::vector<std::uint32_t> counts(pixels.size(), 0);
    for (std::size_t first = 0; first < lights.size(); first += kBlock)
        for (std::size_t i = 0; i < pixels.size(); ++i)
            counts[i] +=
                count_affecting(lights, point_of(positions[pixels[i]]), first, std::min(first + kBlock, lights.size()));
    return counts;
}

// As many different lights as affect the point, each of which affects it: those are the lights that affect it.
bool is_right(std::span<const std::uint32_t> list, const LightColumns& lights, MlFloat3 point, std::uint32_t count) {
    if (list.size() != count) return false;
    if (std::ranges::adjacent_find(list, std::ranges::greater_equal()) != list.end()) return false;
    return std::ranges::all_of(
        list, [&](std::uint32_t light) { return light < lights.size() && lights.affects(point, light); });
}

} // namespace

std::vector<PixelRecord> light_set_records(const Frame& frame, const PointLists& lists,
                                           std::span<const PointPosition> positions,
                                           std::span<const PointNormal> normals) {
    const LightStream stream = make_light_stream(frame);
    std::vector<PixelRecord> records(positions.size());
    for (std::size_t pixel = 0; pixel < positions.size(); ++pixel) {
        if (!(positions[pixel].depth > 0.0f)) continue;
        records[pixel].shaded = 1;
        for (const std::uint32_t light : lists.of(pixel))
            add_light(records[pixel], light, is_front(positions[pixel], normals[pixel], stream.spheres[light]));
    }
    return records;
}

std::vector<std::size_t> checked_pixels(std::span<const PointPosition> positions) {
    std::vector<std::size_t> pixels;
    for (std::size_t pixel = 0; pixel < positions.size(); ++pixel)
        if (positions[pixel].depth > 0.0f) pixels.push_back(pixel);
    if (pixels.size() <= kCheckedPoints) return pixels;
    const auto by_hash = [](std::size_t pixel) { return light_hash_a(static_cast<std::uint32_t>(pixel)); };
    std::ranges::nth_element(pixels, pixels.begin() + kCheckedPoints, {}, by_hash);
    pixels.resize(kCheckedPoints);
    std::ranges::sort(pixels);
    return pixels;
}

ListCheck check_lists(const Frame& frame, const PointLists& lists, std::span<const PointPosition> positions) {
    constexpr std::size_t kGroup = 64;
    const LightColumns lights(make_light_stream(frame));
    const std::vector<std::size_t> pixels = checked_pixels(positions);
    std::vector<std::uint8_t> right(pixels.size());
    share_work((pixels.size() + kGroup - 1) / kGroup, 0, [&](std::size_t group) {
        const std::size_t first = group * kGroup, size = std::min(kGroup, pixels.size() - first);
        const std::span<const std::size_t> of_group = std::span(pixels).subspan(first, size);
        const std::vector<std::uint32_t> counts = count_affecting(lights, positions, of_group);
        for (std::size_t i = 0; i < size; ++i)
            right[first + i] =
                is_right(lists.of(of_group[i]), lights, point_of(positions[of_group[i]]), counts[i]) ? 1 : 0;
    });
    ListCheck check{pixels.size(), std::nullopt};
    const auto wrong = std::ranges::find(right, std::uint8_t{0});
    if (wrong != right.end()) check.first_wrong = pixels[static_cast<std::size_t>(wrong - right.begin())];
    return check;
}

bool remove_one_light(PointLists& lists, std::span<const PointPosition> positions) {
    for (const std::size_t pixel : checked_pixels(positions)) {
        if (lists.of(pixel).empty()) continue;
        lists.lights.erase(lists.lights.begin() + static_cast<std::ptrdiff_t>(lists.first[pixel]));
        for (std::size_t i = pixel + 1; i < lists.first.size(); ++i) --lists.first[i];
        return true;
    }
    return false;
}

} // namespace manylights::lab
