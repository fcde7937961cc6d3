#include "lab/techniques/device/spread.h"
#include "lab/techniques/octree/octree_nodes.h"

#include <algorithm>

namespace manylights::lab {

namespace {

constexpr std::uint32_t kInsertCode[] =
#include "octree_sparse_insert.comp.inc"
    ;

constexpr std::uint64_t kWord = sizeof(std::uint32_t);
constexpr std::uint32_t kGroupSize = 64; // of the shader
// Siblings begin at a multiple of their number, the root as if it had some: which lists lie side by side does then not
// depend on who came first.
constexpr std::uint32_t kSiblings = 8;

/// Of the shader: nodes that have a number, and froxels put aside.
struct Counts {
    std::uint32_t nodes, later;
};

class SparseNodes : public OctreeNodes {
  public:
    explicit SparseNodes(gpu::Device& device)
        : device_(device), pipeline_(device, {"octree, sparse nodes", kInsertCode, 6, kWord, {}}),
          pool_(device, "room for nodes"), nodes_(device, "nodes"),
          counts_(device, "counts of nodes"), later_{{device, "froxels put aside"},
                                                     {device, "froxels put aside again"}} {}

    // A froxel is put aside where another one makes children, at most once per level, and then these are there.
    double build(const FroxelGrid& grid, const OctreeLevels& levels, const OccupiedCells& cells) override {
        begin(levels, cells);
        double milliseconds = 0.0;
        Counts counts{kSiblings, cells.count()};
        const gpu::Buffer* inserted = &cells.cells();
        for (std::size_t round = 0; counts.later != 0; ++round) {
            const std::uint32_t count = counts.later;
            const gpu::Buffer& later = later_[round % 2].buffer();
            counts.later = 0;
            counts_.buffer().upload(std::span<const Counts>(&counts, 1));
            milliseconds += insert(grid, levels, *inserted, count, later);
            counts = counts_.buffer().download<Counts>(1).front();
            inserted = &later;
        }
        return milliseconds + keep(counts.nodes);
    }

    std::uint32_t count() const override { return count_; }
    const gpu::Buffer& nodes() const override { return nodes_.buffer(); }

  private:
    // Children belong to nodes above froxels, and these are no more than there are froxels, on each level.
    void begin(const OctreeLevels& levels, const OccupiedCells& cells) {
        std::uint64_t nodes = kSiblings;
        for (std::uint32_t level = 1; level < levels.count(); ++level)
            nodes += kSiblings * std::min<std::uint64_t>(cells.count(), levels.nodes_of(level));
        pool_.fit(kWord * nodes);
        pool_.buffer().fill(0);
        counts_.fit(sizeof(Counts));
        for (FittedBuffer& later : later_) later.fit(kWord * cells.count());
    }

    double insert(const FroxelGrid& grid, const OctreeLevels& levels, const gpu::Buffer& cells, std::uint32_t count,
                  const gpu::Buffer& later) {
        gpu::Commands commands(device_);
        const std::uint32_t start = commands.timestamp();
        commands.dispatch(pipeline_,
                          {{cells}, {grid.buffer()}, {levels.buffer()}, {pool_.buffer()}, {counts_.buffer()}, {later}},
                          count, spread_groups(gpu::group_count(count, kGroupSize)));
        const std::uint32_t end = commands.timestamp();
        commands.submit_and_wait("inserting froxels into the octree");
        return commands.milliseconds(start, end);
    }

    double keep(std::uint32_t count) {
        count_ = count;
        nodes_.fit(kWord * count);
        gpu::Commands commands(device_);
        const std::uint32_t start = commands.timestamp();
        commands.copy(pool_.buffer(), nodes_.buffer(), kWord * count);
        const std::uint32_t end = commands.timestamp();
        commands.submit_and_wait("keeping nodes");
        return commands.milliseconds(start, end);
    }

    gpu::Device& device_;
    gpu::ComputePipeline pipeline_;
    FittedBuffer pool_, nodes_, counts_;
    FittedBuffer later_[2];
    std::uint32_t count_ = 0;
};

} // namespace

std::unique_ptr<OctreeNodes> make_sparse_nodes(gpu::Device& device) { return std::make_unique<SparseNodes>(device); }

} // namespace manylights::lab
