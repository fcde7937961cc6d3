#include "tests/property/frame.h"

#include <algorithm>

namespace manylights::test {

namespace {

constexpr std::size_t kCanaryBytes = 64;
constexpr std::byte kCanary{0xA5};

/// size bytes of the pattern, and the canaries behind them.
void fill(std::vector<std::byte>& memory, std::uint64_t size, unsigned char pattern) {
    memory.assign(static_cast<std::size_t>(size), std::byte{pattern});
    memory.insert(memory.end(), kCanaryBytes, kCanary);
}

bool canaries_are_whole(const std::vector<std::byte>& memory) {
    return std::all_of(memory.end() - kCanaryBytes, memory.end(), [](std::byte b) { return b == kCanary; });
}

} // namespace

ManylightsSettings default_settings(ManylightsStructure structure) {
    ManylightsSettings settings{};
    settings.size = sizeof settings;
    settings.structure = structure;
    return settings;
}

ManylightsLights lights_of(const std::vector<ManylightsSphere>& spheres) {
    ManylightsLights lights{};
    lights.size = sizeof lights;
    lights.spheres = spheres.data();
    lights.count = static_cast<std::uint32_t>(spheres.size());
    return lights;
}

const char* structure_name(std::uint32_t structure) {
    static constexpr const char* kNames[] = {"default", "lists", "trees", "hybrid", "windows"};
    return kNames[structure];
}

Frame::Frame(const ManylightsSettings& settings) {
    ManylightsReport report{};
    if (manylights_create(&settings, &builder_, &report) != MANYLIGHTS_OK) fail("create", report);
}

Frame::~Frame() { manylights_destroy(builder_); }

bool Frame::fail(const char* call, const ManylightsReport& report) {
    failure_ = std::string(call) + ": " + manylights_status_name(report.status) + ", " +
               (report.field ? report.field : "(no field)") + " " + (report.rule ? report.rule : "(no rule)") +
               ", index " + std::to_string(report.index);
    return false;
}

bool Frame::build(const std::vector<ManylightsView>& views, const ManylightsLights& lights, unsigned char pattern) {
    if (builder_ == nullptr) return false;
    ManylightsReport report{};
    if (manylights_plan(builder_, views.data(), static_cast<std::uint32_t>(views.size()), &lights, &sizes_, &report) !=
        MANYLIGHTS_OK)
        return fail("plan", report);
    const std::uint64_t sizes[5] = {sizes_.views, sizes_.slice_edges, sizes_.cells, sizes_.nodes, sizes_.references};
    for (int i = 0; i < 5; ++i) fill(memory_[i], sizes[i], pattern);
    ManylightsBuffers targets{memory_[0].data(), memory_[1].data(), memory_[2].data(), memory_[3].data(),
                              memory_[4].data()};
    if (manylights_write(builder_, &targets, &report) != MANYLIGHTS_OK) return fail("write", report);
    for (const std::vector<std::byte>& memory : memory_)
        if (!canaries_are_whole(memory)) {
            failure_ = "write: bytes behind the end of a buffer were changed";
            return false;
        }
    buffers_.views = reinterpret_cast<const MlView*>(memory_[0].data());
    buffers_.slice_edges = reinterpret_cast<const float*>(memory_[1].data());
    buffers_.cells = reinterpret_cast<const MlCell*>(memory_[2].data());
    buffers_.nodes = reinterpret_cast<const MlNode*>(memory_[3].data());
    buffers_.references = reinterpret_cast<const std::uint32_t*>(memory_[4].data());
    if (manylights_validate(builder_, &targets, &sizes_, lights.count, &report) != MANYLIGHTS_OK)
        return fail("validate", report);
    return true;
}

ManylightsStats Frame::stats() const {
    ManylightsStats stats{};
    manylights_stats(builder_, &stats);
    return stats;
}

std::vector<std::byte> Frame::bytes() const {
    std::vector<std::byte> all;
    for (const std::vector<std::byte>& memory : memory_)
        all.insert(all.end(), memory.begin(), memory.end() - kCanaryBytes);
    return all;
}

std::vector<std::uint32_t> Frame::query(std::size_t index, float x, float y, float depth) const {
    Buffers buffers = buffers_;
    Buffers::MlCursor cursor = buffers.ml_begin(view(index), {x, y}, depth);
    std::vector<std::uint32_t> lights;
    std::uint32_t light;
    while (buffers.ml_next(cursor, light)) lights.push_back(light);
    return lights;
}

int Frame::times_handed_out(std::size_t index, float x, float y, float depth, std::uint32_t light) const {
    std::vector<std::uint32_t> lights = query(index, x, y, depth);
    return static_cast<int>(std::count(lights.begin(), lights.end(), light));
}

} // namespace manylights::test
