#include "lab/techniques/device/spread.h"
#include "lab/techniques/octree/octree_nodes.h"

namespace manylights::lab {

namespace {

constexpr std::uint32_t kMarkCode[] =
#include "octree_dense_mark.comp.inc"
    ;

constexpr std::uint64_t kWord = sizeof(std::uint32_t);
constexpr std::uint32_t kGroupSize = 64; // of the shader

class DenseNodes : public OctreeNodes {
  public:
    explicit DenseNodes(gpu::Device& device)
        : device_(device), pipeline_(device, {"octree, dense nodes", kMarkCode, 4, kWord, {}}),
          nodes_(device, "bits of nodes") {}

    double build(const FroxelGrid& grid, const OctreeLevels& levels, const OccupiedCells& cells) override {
        count_ = static_cast<std::uint32_t>(levels.all_nodes());
        nodes_.fit(kWord * gpu::group_count(count_, 32));
        gpu::Commands commands(device_);
        const std::uint32_t start = commands.timestamp();
        commands.fill(nodes_.buffer(), 0);
        commands.barrier();
        commands.dispatch(pipeline_, {{cells.cells()}, {grid.buffer()}, {levels.buffer()}, {nodes_.buffer()}},
                          cells.count(), spread_groups(gpu::group_count(cells.count(), kGroupSize)));
        const std::uint32_t end = commands.timestamp();
        commands.submit_and_wait("marking nodes with samples");
        return commands.milliseconds(start, end);
    }

    std::uint32_t count() const override { return count_; }
    const gpu::Buffer& nodes() const override { return nodes_.buffer(); }

  private:
    gpu::Device& device_;
    gpu::ComputePipeline pipeline_;
    FittedBuffer nodes_;
    std::uint32_t count_ = 0;
};

} // namespace

std::unique_ptr<OctreeNodes> make_dense_nodes(gpu::Device& device) { return std::make_unique<DenseNodes>(device); }

} // namespace manylights::lab
