#pragma once
// A scene's geometry and materials on the device.

#include "lab/gpu/buffer.h"
#include "lab/renderer/point_buffer.h"
#include "lab/scene/scene.h"

#include <vector>

namespace manylights::lab {

/// The scene's materials as shading reads them; a plain grey one where it has none.
std::vector<MaterialRecord> material_records(const Scene& scene);

struct SceneBuffers {
    SceneBuffers(gpu::Device& device, const Scene& scene);

    gpu::Buffer vertices; ///< Vertex each
    gpu::Buffer indices;
    std::uint32_t index_count;
    std::vector<MaterialRecord> materials; ///< at least one
};

} // namespace manylights::lab
