// The paper's own CPU pipeline in the library's place: same format, same query, and the switches that the papers vary.

#include "lab/scene/error.h"
#include "lab/techniques/light_stream.h"
#include "lab/techniques/producer.h"
#include "reference/paper/pipeline.h"

#include <cstring>
#include <stdexcept>

namespace manylights::lab {

namespace {

paper::Structure structure_of(StructureKind kind) {
    switch (kind) {
    case StructureKind::lists:
        return paper::Structure::clustered;
    case StructureKind::trees:
        return paper::Structure::tree;
    case StructureKind::hybrid:
        return paper::Structure::hybrid;
    case StructureKind::windows:
        break;
    }
    throw std::invalid_argument("the paper's pipeline: no depth windows");
}

paper::Options paper_options(const StructureOptions& options, const SliceRange& slices) {
    paper::Options result;
    result.structure = structure_of(options.kind);
    result.tile_px = options.tile_size;
    result.slice_count = options.slice_count;
    result.slice_near = slices.near_edge;
    result.slice_far = slices.far_edge;
    result.leaf_size = options.leaf_size;
    result.slice_formula = options.slice_formula;
    result.heuristic = options.heuristic;
    result.sort_key = options.sort_key;
    result.sort_scope = options.sort_scope;
    result.tree_build = options.tree_build;
    result.tree_entry = options.tree_entry;
    result.list_bounds = options.list_bounds;
    result.cell_test = options.cell_test;
    result.time_stages = true;
    return result;
}

template <typename T>
void copy(std::span<const T> source, void* target) {
    if (!source.empty()) std::memcpy(target, source.data(), source.size_bytes());
}

class PaperProducer : public Producer {
  public:
    explicit PaperProducer(const StructureOptions& options) : options_(options) {}

    ManylightsSizes plan(const Frame& frame) override {
        const ManylightsView view = make_view(frame.camera, frame.width, frame.height);
        try {
            built_ = &pipeline_.build({&view, 1}, public_lights(frame),
                                      paper_options(options_, slice_range(options_, frame.scene)));
        } catch (const std::invalid_argument& error) {
            throw InputError(error.what());
        } catch (const std::length_error& error) {
            throw InputError(error.what());
        }
        return {built_->views.size_bytes(), built_->slice_edges.size_bytes(), built_->cells.size_bytes(),
                built_->nodes.size_bytes(), built_->references.size_bytes()};
    }

    void write(const ManylightsBuffers& buffers) override {
        copy(built_->views, buffers.views);
        copy(built_->slice_edges, buffers.slice_edges);
        copy(built_->cells, buffers.cells);
        copy(built_->nodes, buffers.nodes);
        copy(built_->references, buffers.references);
    }

    ProducerStats stats() const override { return {built_->visible_lights, built_->references.size()}; }

    std::vector<StageTime> stages() const override {
        const paper::StageTimes& times = built_->times;
        return {{"cull", times.cull}, {"sort", times.sort}, {"bounds", times.bounds},
                {"bin", times.bin},   {"tree", times.tree}, {"pack", times.pack}};
    }

  private:
    StructureOptions options_;
    paper::PaperPipeline pipeline_;
    const paper::Buffers* built_ = nullptr;
};

} // namespace

std::unique_ptr<Producer> make_paper_producer(const StructureOptions& options) {
    return std::make_unique<PaperProducer>(options);
}

} // namespace manylights::lab
