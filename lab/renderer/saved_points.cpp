#include "lab/renderer/saved_points.h"

#include "lab/renderer/point_buffer.h"

namespace manylights::lab {

SavedPoints save_points(const std::string& scene, const Camera& camera, const PointBuffer& points) {
    SavedPoints saved{scene, camera, points.width(), points.height(), {}};
    const std::vector<PointPosition> positions = points.download_positions();
    const std::vector<PointNormal> normals = points.download_normals();
    for (std::size_t i = 0; i < positions.size(); ++i)
        if (positions[i].depth > 0.0f)
            saved.points.push_back(
                {std::uint32_t(i), positions[i].position, positions[i].depth, normals[i].normal, normals[i].material});
    return saved;
}

PointBuffer restore_points(gpu::Device& device, const SavedPoints& saved,
                           const std::vector<MaterialRecord>& materials) {
    PointBuffer buffer(device, saved.width, saved.height, materials);
    std::vector<PointPosition> positions(std::size_t(saved.width) * saved.height, {glm::vec3(0.0f), 0.0f});
    std::vector<PointNormal> normals(positions.size(), {glm::vec3(0.0f), 0});
    for (const SavedPoint& point : saved.points) {
        positions[point.pixel] = {point.position, point.depth};
        normals[point.pixel] = {point.normal, point.material};
    }
    buffer.positions().upload(positions);
    buffer.normals().upload(normals);
    return buffer;
}

} // namespace manylights::lab
