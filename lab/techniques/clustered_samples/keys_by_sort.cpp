#include "lab/gpu/device.h"
#include "lab/techniques/clustered_samples/unique_keys.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kSortCode[] =
#include "clusters_sort.comp.inc"
    ;
constexpr std::uint32_t kPlaceCode[] =
#include "clusters_place.comp.inc"
    ;

constexpr std::uint64_t kWord = sizeof(std::uint32_t);
// A key and a sample's number share a word; the key behind all others stands for sky.
constexpr std::uint32_t kSampleBits = 10;
constexpr std::uint64_t kMostKeys = (std::uint64_t{1} << (32 - kSampleBits)) - 1;

class KeysBySort : public UniqueKeys {
  public:
    explicit KeysBySort(gpu::Device& device)
        : UniqueKeys(device), sort_pipeline_(device, {"clusters, sort", kSortCode, 6, sizeof(SamplesPush), {}}),
          place_pipeline_(device, {"clusters, places", kPlaceCode, 7, sizeof(SamplesPush), {}}),
          tile_keys_(device, "keys of tiles"), places_(device, "places of tiles") {}

    double find(const Frame& frame, const SampleGrid& grid) override {
        if (grid.keys_of_tile() > kMostKeys) refuse(grid, "sort", kMostKeys, " of a tile");
        begin(frame, grid, "sort");
        const std::uint64_t samples = std::uint64_t{grid.push().tile_size} * grid.push().tile_size;
        tile_keys_.fit(kWord * grid.tiles() * samples);
        places_.fit(kWord * (std::uint64_t{grid.tiles()} + 1));
        prefix_sum_.reserve(grid.tiles() + 1);
        const double sort_ms = sort(frame, grid);
        count_keys();
        return sort_ms + place(frame, grid);
    }

  private:
    // One count more than there are tiles, 0: its place is the number of all keys.
    double sort(const Frame& frame, const SampleGrid& grid) {
        gpu::Commands commands(device_);
        const std::uint32_t start = commands.timestamp();
        commands.fill(places_.buffer(), 0);
        commands.barrier();
        commands.dispatch(sort_pipeline_, grid.bindings(frame, {{ids()}, {tile_keys_.buffer()}, {places_.buffer()}}),
                          grid.push(), grid.groups_of_tiles());
        prefix_sum_.record(commands, places_.buffer(), places_.buffer(), grid.tiles() + 1, total_.buffer());
        const std::uint32_t end = commands.timestamp();
        commands.submit_and_wait("sorting the samples of tiles");
        return commands.milliseconds(start, end);
    }

    double place(const Frame& frame, const SampleGrid& grid) {
        gpu::Commands commands(device_);
        const std::uint32_t start = commands.timestamp();
        commands.dispatch(place_pipeline_,
                          grid.bindings(frame, {{ids()}, {tile_keys_.buffer()}, {places_.buffer()}, {keys()}}),
                          grid.push(), grid.groups_of_tiles());
        const std::uint32_t end = commands.timestamp();
        commands.submit_and_wait("placing the keys of tiles");
        return commands.milliseconds(start, end);
    }

    gpu::ComputePipeline sort_pipeline_, place_pipeline_;
    FittedBuffer tile_keys_, places_;
};

} // namespace

std::unique_ptr<UniqueKeys> make_keys_by_sort(gpu::Device& device) { return std::make_unique<KeysBySort>(device); }

} // namespace manylights::lab
