// A producer on the CPU, whose structure is written into memory of the device.

#include "lab/techniques/light_records.h"
#include "lab/techniques/structure_build.h"

#include <chrono>
#include <numeric>

namespace manylights::lab {

namespace {

std::unique_ptr<Producer> make_producer(const StructureOptions& options) {
    return options.producer == ProducerKind::paper ? make_paper_producer(options) : make_library_producer(options);
}

template <typename Work>
double milliseconds_of(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

class HostBuild : public StructureBuild {
  public:
    HostBuild(gpu::Device& device, const StructureOptions& options)
        : producer_(make_producer(options)), buffers_(device), has_records_(options.has_records) {}

    // The time is the producer's alone: the lab's own allocation and its patterns are left out.
    BuiltStructure build(const Frame& frame, const FrameLights& lights) override {
        ManylightsSizes sizes{};
        const double plan_ms = milliseconds_of([&] { sizes = producer_->plan(frame); });
        stages_ = producer_->stages();
        if (stages_.empty()) stages_.push_back({"plan", plan_ms});
        milliseconds_ = plan_ms;
        reserve(sizes);
        add_stage("write", milliseconds_of([&] { write(); }));
        if (has_records_) add_stage("duplicate", milliseconds_of([&] { write_records(lights.stream); }));
        buffers_.finish();
        visible_lights_ = producer_->stats().visible_lights;
        return {buffers_.bindings(), producer_->stats().references};
    }

  private:
    void reserve(ManylightsSizes sizes) {
        if (has_records_) {
            references_.resize(sizes.references / sizeof(std::uint32_t));
            sizes.references = references_.size() * sizeof(LightRecord);
        }
        buffers_.reserve(sizes);
    }

    void write() {
        ManylightsBuffers targets = buffers_.targets();
        if (has_records_) targets.references = references_.data();
        producer_->write(targets);
    }

    void write_records(const LightStream& lights) {
        write_light_records(lights, references_, static_cast<LightRecord*>(buffers_.targets().references));
    }

    void add_stage(const char* name, double ms) {
        stages_.push_back({name, ms});
        milliseconds_ += ms;
    }

    std::unique_ptr<Producer> producer_;
    StructureBuffers buffers_;
    bool has_records_;
    std::vector<std::uint32_t> references_; ///< whose places records take
};

} // namespace

std::uint64_t BuiltStructure::bytes() const {
    return std::accumulate(buffers.begin(), buffers.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const gpu::Buffer* buffer) { return sum + buffer->bytes(); });
}

std::unique_ptr<StructureBuild> make_host_build(gpu::Device& device, const StructureOptions& options) {
    return std::make_unique<HostBuild>(device, options);
}

} // namespace manylights::lab
