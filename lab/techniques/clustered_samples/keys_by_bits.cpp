#include "lab/gpu/device.h"
#include "lab/techniques/clustered_samples/unique_keys.h"
#include "lab/techniques/device/spread.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kPagesCode[] =
#include "clusters_pages.comp.inc"
    ;
constexpr std::uint32_t kMarkCode[] =
#include "clusters_mark.comp.inc"
    ;
constexpr std::uint32_t kCountCode[] =
#include "clusters_count.comp.inc"
    ;
constexpr std::uint32_t kNumberCode[] =
#include "clusters_number.comp.inc"
    ;

constexpr std::uint64_t kWord = sizeof(std::uint32_t);
constexpr std::uint32_t kWordGroup = 256, kPageBits = 10; // of the shaders
// 128 MiB of bits, the largest binding that every device has.
constexpr std::uint64_t kMostBits = std::uint64_t{1} << 30;

std::uint64_t words_of(std::uint64_t bits) { return (bits + 31) / 32; }

/// Bits, and how many of them are before each word.
struct RankedBits {
    FittedBuffer bits, places;

    void fit(std::uint64_t count) {
        bits.fit(kWord * words_of(count));
        places.fit(kWord * words_of(count));
    }
};

class KeysByBits : public UniqueKeys {
  public:
    KeysByBits(gpu::Device& device, bool is_paged)
        : UniqueKeys(device), is_paged_(is_paged),
          count_pipeline_(device, {"clusters, counts of bits", kCountCode, 2, kWord, {}}),
          mark_pipeline_(device, {"clusters, marks", kMarkCode, 6, sizeof(SamplesPush), {is_paged ? 1u : 0u}}),
          number_pipeline_(device, {"clusters, numbers", kNumberCode, 9, sizeof(SamplesPush), {is_paged ? 1u : 0u}}),
          pages_{{device, "pages of keys"}, {device, "places of pages"}}, marks_{{device, "marks of keys"},
                                                                                 {device, "places of keys"}} {
        if (is_paged)
            pages_pipeline_.emplace(device,
                                    gpu::ComputeShader{"clusters, pages", kPagesCode, 4, sizeof(SamplesPush), {}});
    }

    double find(const Frame& frame, const SampleGrid& grid) override {
        if (!is_paged_ && grid.keys() > kMostBits) refuse(grid, "bitmap", kMostBits, "");
        begin(frame, grid, "page_table");
        pages_.fit(is_paged_ ? (grid.keys() >> kPageBits) + 1 : 1);
        double milliseconds = is_paged_ ? mark(frame, grid, *pages_pipeline_, pages_, {}) : 0.0;
        marks_.fit(is_paged_ ? std::uint64_t{total()} << kPageBits : grid.keys());
        milliseconds += mark(frame, grid, mark_pipeline_, marks_, {{pages_.bits.buffer()}, {pages_.places.buffer()}});
        count_keys();
        return milliseconds + number(frame, grid);
    }

  private:
    // bindings: of the pages, where they matter; the bits come behind them.
    double mark(const Frame& frame, const SampleGrid& grid, const gpu::ComputePipeline& pipeline, RankedBits& target,
                std::vector<gpu::Binding> bindings) {
        const gpu::Buffer &bits = target.bits.buffer(), &places = target.places.buffer();
        const auto words = static_cast<std::uint32_t>(bits.bytes() / kWord);
        prefix_sum_.reserve(words);
        bindings.push_back({bits});
        gpu::Commands commands(device_);
        const std::uint32_t start = commands.timestamp();
        commands.fill(bits, 0);
        commands.barrier();
        commands.dispatch(pipeline, grid.bindings(frame, bindings), grid.push(), grid.groups_of_pixels());
        commands.barrier();
        commands.dispatch(count_pipeline_, {{bits}, {places}}, words,
                          spread_groups(gpu::group_count(words, kWordGroup)));
        prefix_sum_.record(commands, places, places, words, total_.buffer());
        const std::uint32_t end = commands.timestamp();
        commands.submit_and_wait("marking keys");
        return commands.milliseconds(start, end);
    }

    double number(const Frame& frame, const SampleGrid& grid) {
        const std::vector<gpu::Binding> bindings = grid.bindings(frame, {{pages_.bits.buffer()},
                                                                         {pages_.places.buffer()},
                                                                         {marks_.bits.buffer()},
                                                                         {marks_.places.buffer()},
                                                                         {ids()},
                                                                         {keys()}});
        gpu::Commands commands(device_);
        const std::uint32_t start = commands.timestamp();
        commands.dispatch(number_pipeline_, bindings, grid.push(), grid.groups_of_pixels());
        const std::uint32_t end = commands.timestamp();
        commands.submit_and_wait("numbering clusters");
        return commands.milliseconds(start, end);
    }

    bool is_paged_;
    gpu::ComputePipeline count_pipeline_, mark_pipeline_, number_pipeline_;
    std::optional<gpu::ComputePipeline> pages_pipeline_;
    RankedBits pages_, marks_;
};

} // namespace

std::unique_ptr<UniqueKeys> make_keys_by_bits(gpu::Device& device, bool is_paged) {
    return std::make_unique<KeysByBits>(device, is_paged);
}

} // namespace manylights::lab
