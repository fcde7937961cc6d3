#include "lab/renderer/scene_buffers.h"

#include "lab/gpu/device.h"

namespace manylights::lab {

std::vector<MaterialRecord> material_records(const Scene& scene) {
    std::vector<MaterialRecord> records;
    for (const Material& material : scene.materials)
        records.push_back({material.base_color, material.roughness, material.emissive, material.metallic});
    if (records.empty()) records.push_back({glm::vec3(0.8f), 0.8f, glm::vec3(0.0f), 0.0f});
    return records;
}

SceneBuffers::SceneBuffers(gpu::Device& device, const Scene& scene)
    : vertices(device, "vertices", std::span<const Vertex>(scene.vertices)),
      indices(device, "indices", std::span<const std::uint32_t>(scene.indices)),
      index_count(std::uint32_t(scene.indices.size())), materials(material_records(scene)) {}

} // namespace manylights::lab
