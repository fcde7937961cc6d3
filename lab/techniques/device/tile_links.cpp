#include "lab/techniques/device/tile_links.h"

#include "lab/gpu/device.h"
#include "lab/scene/error.h"

#include <limits>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kLinkBuffers = 3; // of tile_links.glsl; the technique's own follow
constexpr std::uint64_t kLinkBytes = 8;
constexpr std::uint32_t kNoLink = 0xFFFFFFFF;
/// A guess for the first build.
constexpr std::uint64_t kLinksPerLight = 4;

} // namespace

TileLinks::TileLinks(gpu::Device& device, const TilePassShader& shader)
    : device_(device), name_(shader.name),
      pass_(device, {shader.name + " (links)", shader.code, kLinkBuffers + shader.buffer_count, shader.constants,
                     shader.billboards}),
      heads_(device, "heads of lists"), links_(device, "links of lists"), taken_(device, "links, their number") {}

double TileLinks::build(const TilePassInput& input, const std::vector<gpu::Binding>& buffers, std::uint32_t lists) {
    heads_.fit(std::uint64_t{lists} * sizeof(std::uint32_t));
    taken_.fit(2 * sizeof(std::uint32_t));
    if (capacity_ == 0) reserve(kLinksPerLight * input.lights.count());
    const double milliseconds = link(input, buffers);
    if (link_count_ <= capacity_) return milliseconds;
    reserve(link_count_);
    return milliseconds + link(input, buffers);
}

std::uint64_t TileLinks::bytes() const { return heads_.buffer().bytes() + link_count_ * kLinkBytes; }

void TileLinks::reserve(std::uint64_t links) {
    capacity_ = 0; // should there be no memory
    links_.fit(links * kLinkBytes);
    capacity_ = links;
}

double TileLinks::link(const TilePassInput& input, const std::vector<gpu::Binding>& buffers) {
    std::vector<gpu::Binding> bindings{{heads_.buffer()}, {links_.buffer()}, {taken_.buffer()}};
    for (const gpu::Binding& buffer : buffers) bindings.push_back(buffer);
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.fill(heads_.buffer(), kNoLink);
    commands.fill(taken_.buffer(), 0);
    commands.barrier();
    pass_.record(commands, input, bindings, static_cast<std::uint32_t>(capacity_));
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("linking lists");
    const std::vector<std::uint32_t> taken = taken_.buffer().download<std::uint32_t>();
    link_count_ = std::uint64_t{taken[1]} << 32 | taken[0];
    // The last number is the end of a list.
    if (link_count_ > std::numeric_limits<std::uint32_t>::max())
        throw InputError(name_ + ": the lists have " + std::to_string(link_count_) +
                         " links; at most 4294967295 can be numbered: fewer cells need fewer");
    return commands.milliseconds(start, end);
}

} // namespace manylights::lab
