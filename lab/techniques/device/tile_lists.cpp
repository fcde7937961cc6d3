#include "lab/techniques/device/tile_lists.h"

#include "lab/scene/error.h"

#include <manylights/format.h>

#include <limits>
#include <numeric>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kCellsCode[] =
#include "tile_lists_cells.comp.inc"
    ;

constexpr std::uint32_t kGroupSize = 64;  // of tile_lists_cells.comp
constexpr std::uint32_t kListBuffers = 2; // of tile_lists.glsl; the technique's own follow
constexpr std::uint64_t kWord = sizeof(std::uint32_t);

} // namespace

TileLists::TileLists(gpu::Device& device, const TilePassShader& shader)
    : device_(device), name_(shader.name), prefix_sum_(device),
      pass_(device, {shader.name + " (lists)", shader.code, kListBuffers + shader.buffer_count, shader.constants,
                     shader.billboards}),
      cells_pipeline_(device, {"cells of lists", kCellsCode, 3, sizeof(std::uint32_t), {}}),
      counts_(device, "lengths of lists"), places_(device, "places of lists"),
      total_(device, "references, their number"), cells_(device, "lists"), references_(device, "references") {}

double TileLists::build(const TileListsInput& input) {
    const std::uint32_t lists = input.pass.grid.tile_count() * input.lists_per_tile;
    const double milliseconds = count(input, lists);
    check_total(input.words_per_reference);
    return milliseconds + fill(input, lists);
}

double TileLists::count(const TileListsInput& input, std::uint32_t lists) {
    counts_.fit(lists * kWord);
    places_.fit(lists * kWord);
    total_.fit(kWord);
    prefix_sum_.reserve(lists);
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.fill(counts_.buffer(), 0);
    commands.barrier();
    record_pass(commands, input, counts_.buffer(), counts_.buffer(), false);
    prefix_sum_.record(commands, counts_.buffer(), places_.buffer(), lists, total_.buffer());
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("lengths of lists");
    const std::vector<std::uint32_t> counts = counts_.buffer().download<std::uint32_t>();
    reference_count_ = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    return commands.milliseconds(start, end);
}

// The device's own sum is modulo 2^32, so the host's decides.
void TileLists::check_total(std::uint32_t words_per_reference) const {
    const std::uint64_t most = std::numeric_limits<std::uint32_t>::max() / words_per_reference;
    if (reference_count_ > most)
        throw InputError(name_ + ": the lists of the tiles have " + std::to_string(reference_count_) +
                         " references; at most " + std::to_string(most) + " can be numbered: larger tiles need fewer");
}

// A place is where a list begins until its references are written, and then where it ends.
double TileLists::fill(const TileListsInput& input, std::uint32_t lists) {
    cells_.fit(std::uint64_t{lists} * sizeof(MlCell));
    references_.fit(reference_count_ * input.words_per_reference * kWord);
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.dispatch(cells_pipeline_, {{counts_.buffer()}, {places_.buffer()}, {cells_.buffer()}}, lists,
                      {gpu::group_count(lists, kGroupSize * kGroupSize), 1, 1});
    commands.barrier();
    record_pass(commands, input, places_.buffer(), references_.buffer(), true);
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("writing lists");
    return commands.milliseconds(start, end);
}

void TileLists::record_pass(gpu::Commands& commands, const TileListsInput& input, const gpu::Buffer& counters,
                            const gpu::Buffer& references, bool is_fill) const {
    std::vector<gpu::Binding> bindings{{counters}, {references}};
    for (const gpu::Binding& buffer : input.buffers) bindings.push_back(buffer);
    pass_.record(commands, input.pass, bindings, is_fill ? 1 : 0);
}

} // namespace manylights::lab
