#pragma once
// Who builds a structure of the library's format on the CPU: the library itself, or the paper's pipeline.

#include "lab/techniques/structure_options.h"

#include <manylights/manylights.h>

namespace manylights::lab {

struct ProducerStats {
    std::uint64_t visible_lights = 0;
    std::uint64_t references = 0;
};

/// One stage of a build.
struct StageTime {
    std::string name;
    double ms = 0;
};

class Producer {
  public:
    virtual ~Producer() = default;
    /// Up to exact sizes. Throws InputError where the frame cannot be built.
    virtual ManylightsSizes plan(const Frame& frame) = 0;
    /// Fills the buffers, which may be mapped device memory.
    virtual void write(const ManylightsBuffers& buffers) = 0;
    virtual ProducerStats stats() const = 0;
    /// The parts of the last plan, in the order of the work; empty where the producer does not tell.
    virtual std::vector<StageTime> stages() const { return {}; }
};

std::unique_ptr<Producer> make_library_producer(const StructureOptions& options);
std::unique_ptr<Producer> make_paper_producer(const StructureOptions& options);

} // namespace manylights::lab
