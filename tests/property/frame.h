#pragma once
// A planned and written frame on the CPU, read through the very text that shaders include.

#include <manylights/manylights.h>

#include <manylights/format.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace manylights::test {

/// The buffers of a frame as the shader sees them.
struct Buffers {
    const MlView* views = nullptr;
    const float* slice_edges = nullptr;
    const MlCell* cells = nullptr;
    const MlNode* nodes = nullptr;
    const std::uint32_t* references = nullptr;

#define ML_SLICE_EDGE(i) slice_edges[i]
#define ML_CELL(i) cells[i]
#define ML_NODE(i) nodes[i]
#define ML_REFERENCE(i) references[i]
#include <manylights/query.h>
#undef ML_SLICE_EDGE
#undef ML_CELL
#undef ML_NODE
#undef ML_REFERENCE
};

/// Zeroed, with the size set.
ManylightsSettings default_settings(ManylightsStructure structure = MANYLIGHTS_STRUCTURE_DEFAULT);
ManylightsLights lights_of(const std::vector<ManylightsSphere>& spheres);
const char* structure_name(std::uint32_t structure);
inline constexpr ManylightsStructure kStructures[] = {MANYLIGHTS_STRUCTURE_LISTS, MANYLIGHTS_STRUCTURE_TREES,
                                                      MANYLIGHTS_STRUCTURE_HYBRID, MANYLIGHTS_STRUCTURE_WINDOWS};

/// Owns a builder and its buffers. build() plans, writes into memory that is filled with a pattern and fenced by
/// canaries, checks the canaries and validates; false, with `failure` saying why, where any of that goes wrong.
class Frame {
  public:
    explicit Frame(const ManylightsSettings& settings);
    ~Frame();
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;

    bool build(const std::vector<ManylightsView>& views, const ManylightsLights& lights, unsigned char pattern = 0xCD);

    const Buffers& buffers() const { return buffers_; }
    const MlView& view(std::size_t index = 0) const { return buffers_.views[index]; }
    const ManylightsSizes& sizes() const { return sizes_; }
    const std::string& failure() const { return failure_; }
    ManylightsStats stats() const;
    std::size_t cell_count() const { return static_cast<std::size_t>(sizes_.cells / sizeof(MlCell)); }
    std::size_t node_count() const { return static_cast<std::size_t>(sizes_.nodes / sizeof(MlNode)); }
    /// In windows a reference has two words.
    std::size_t reference_count() const {
        bool windows = sizes_.views != 0 && view().structure == ML_STRUCTURE_WINDOWS;
        return static_cast<std::size_t>(sizes_.references / (windows ? 8 : 4));
    }

    /// Every byte of the five buffers, one after the other.
    std::vector<std::byte> bytes() const;

    /// The lights that the query hands out, in its order.
    std::vector<std::uint32_t> query(std::size_t view, float x, float y, float depth) const;
    /// How often the query hands out this light.
    int times_handed_out(std::size_t view, float x, float y, float depth, std::uint32_t light) const;

  private:
    bool fail(const char* call, const ManylightsReport& report);

    ManylightsBuilder* builder_ = nullptr;
    std::vector<std::byte> memory_[5];
    ManylightsSizes sizes_{};
    Buffers buffers_;
    std::string failure_;
};

} // namespace manylights::test
