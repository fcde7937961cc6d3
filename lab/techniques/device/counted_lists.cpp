#include "lab/techniques/device/counted_lists.h"

#include "lab/scene/error.h"

#include <manylights/format.h>

#include <limits>
#include <numeric>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kCellsCode[] =
#include "tile_lists_cells.comp.inc"
    ;

constexpr std::uint32_t kGroupSize = 64;
constexpr std::uint64_t kWord = sizeof(std::uint32_t);

} // namespace

CountedLists::CountedLists(gpu::Device& device, std::string name)
    : device_(device), name_(std::move(name)), prefix_sum_(device),
      cells_pipeline_(device, {"cells of lists", kCellsCode, 3, sizeof(std::uint32_t), {}}),
      counts_(device, "lengths of lists"), places_(device, "places of lists"),
      total_(device, "references, their number"), cells_(device, "lists"), references_(device, "references") {}

double CountedLists::build(std::uint32_t list_count, std::uint32_t words_per_reference, const CountedListsPass& pass) {
    const double milliseconds = count(list_count, pass);
    check_total(words_per_reference);
    return milliseconds + fill(list_count, words_per_reference, pass);
}

double CountedLists::count(std::uint32_t list_count, const CountedListsPass& pass) {
    counts_.fit(list_count * kWord);
    places_.fit(list_count * kWord);
    total_.fit(kWord);
    prefix_sum_.reserve(list_count);
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.fill(counts_.buffer(), 0);
    commands.barrier();
    pass(commands, counts_.buffer(), counts_.buffer(), false);
    prefix_sum_.record(commands, counts_.buffer(), places_.buffer(), list_count, total_.buffer());
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("lengths of lists");
    const std::vector<std::uint32_t> counts = counts_.buffer().download<std::uint32_t>();
    reference_count_ = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    return commands.milliseconds(start, end);
}

// The device's own sum is modulo 2^32, so the host's decides.
void CountedLists::check_total(std::uint32_t words_per_reference) const {
    const std::uint64_t most = std::numeric_limits<std::uint32_t>::max() / words_per_reference;
    if (reference_count_ > most)
        throw InputError(name_ + ": the lists have " + std::to_string(reference_count_) + " references; at most " +
                         std::to_string(most) + " can be numbered: larger tiles need fewer");
}

// A place is where a list begins until its references are written, and then where it ends.
double CountedLists::fill(std::uint32_t list_count, std::uint32_t words_per_reference, const CountedListsPass& pass) {
    cells_.fit(std::uint64_t{list_count} * sizeof(MlCell));
    references_.fit(reference_count_ * words_per_reference * kWord);
    gpu::Commands commands(device_);
    const std::uint32_t start = commands.timestamp();
    commands.dispatch(cells_pipeline_, {{counts_.buffer()}, {places_.buffer()}, {cells_.buffer()}}, list_count,
                      {gpu::group_count(list_count, kGroupSize * kGroupSize), 1, 1});
    commands.barrier();
    pass(commands, places_.buffer(), references_.buffer(), true);
    const std::uint32_t end = commands.timestamp();
    commands.submit_and_wait("writing lists");
    return commands.milliseconds(start, end);
}

} // namespace manylights::lab
