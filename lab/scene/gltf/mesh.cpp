#include "lab/scene/gltf/mesh.h"

#include "lab/scene/gltf/accessor.h"
#include "lab/scene/gltf/error.h"

#include <array>
#include <cmath>

namespace manylights::lab::gltf {
namespace {

constexpr std::size_t kMostVertices = 100'000'000; // 2.8 GB of them; also what instancing may add up to
constexpr float kLargestCoordinate = 1e9f;         // areas and squared distances stay far from overflow

struct Primitive {
    std::string name; ///< for messages
    int mode;
    std::vector<glm::vec3> positions, normals; ///< normals: empty, or one per position
    std::vector<std::uint32_t> indices;        ///< as in the file; 0, 1, 2, ... where it has none
};

int attribute(const tinygltf::Primitive& primitive, const char* name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
}

Primitive read_primitive(const std::string& path, const tinygltf::Model& model, const tinygltf::Primitive& source,
                         std::string name) {
    Primitive primitive{std::move(name), source.mode == -1 ? TINYGLTF_MODE_TRIANGLES : source.mode, {}, {}, {}};
    primitive.positions = read_vectors(path, model, attribute(source, "POSITION"));
    if (attribute(source, "NORMAL") >= 0) primitive.normals = read_vectors(path, model, attribute(source, "NORMAL"));
    if (!primitive.normals.empty() && primitive.normals.size() != primitive.positions.size())
        fail(path, primitive.name + " must have as many normals as positions");
    if (source.indices >= 0) {
        primitive.indices = read_indices(path, model, source.indices);
    } else {
        primitive.indices.resize(primitive.positions.size());
        for (std::size_t i = 0; i < primitive.indices.size(); ++i) primitive.indices[i] = std::uint32_t(i);
    }
    for (const std::uint32_t index : primitive.indices) {
        if (index >= primitive.positions.size())
            fail(path, primitive.name + " has vertex index " + std::to_string(index) + ", but only " +
                           std::to_string(primitive.positions.size()) + " vertices");
    }
    return primitive;
}

std::size_t triangle_count(const Primitive& primitive) {
    const std::size_t count = primitive.indices.size();
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES) return count / 3;
    return count < 3 ? 0 : count - 2;
}

/// Corners of triangle i; every second one of a strip is turned, so that all keep the same side in front.
std::array<std::uint32_t, 3> corners(const Primitive& primitive, std::size_t i) {
    const std::vector<std::uint32_t>& index = primitive.indices;
    switch (primitive.mode) {
    case TINYGLTF_MODE_TRIANGLE_STRIP:
        return {index[i], index[i + 1 + i % 2], index[i + 2 - i % 2]};
    case TINYGLTF_MODE_TRIANGLE_FAN:
        return {index[i + 1], index[i + 2], index[0]};
    default:
        return {index[3 * i], index[3 * i + 1], index[3 * i + 2]};
    }
}

bool is_finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Unit length, or zero where the vector has no direction.
glm::vec3 unit_or_zero(const glm::dvec3& v) {
    const double length = std::sqrt(glm::dot(v, v));
    if (!(length > 1e-300) || !std::isfinite(length)) return glm::vec3(0.0f);
    return glm::vec3(v / length);
}

/// The transform for points and, for normals, its cofactor matrix: determinant times inverse transpose, which exists
/// for every matrix. Mirroring turns triangles round, and the sign keeps normals on the outside.
struct Transform {
    glm::dmat3 linear, cofactor;
    glm::dvec3 offset;
    bool mirrored;

    explicit Transform(const glm::dmat4& m)
        : linear(m), cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                              glm::cross(linear[0], linear[1])),
          offset(m[3]), mirrored(glm::determinant(linear) < 0.0) {}

    glm::vec3 point(const glm::vec3& p) const { return glm::vec3(linear * glm::dvec3(p) + offset); }
    glm::vec3 normal(const glm::vec3& n) const {
        return is_finite(n) ? unit_or_zero(cofactor * glm::dvec3(n) * (mirrored ? -1.0 : 1.0)) : glm::vec3(0.0f);
    }
};

glm::vec3 checked_point(const std::string& path, const Primitive& primitive, const Transform& transform,
                        std::size_t i) {
    const glm::vec3 p = transform.point(primitive.positions[i]);
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::fabs(p[axis]) <= kLargestCoordinate))
            fail(path, primitive.name + ", vertex " + std::to_string(i) +
                           ": the position must be finite and within 1e9 of the origin");
    }
    return p;
}

/// Shared vertices with the file's normals, or three per triangle with the triangle's own.
class Appender {
  public:
    Appender(const Primitive& primitive, const Transform& transform, std::uint32_t material, Scene& scene)
        : primitive_(primitive), transform_(transform), material_(material), scene_(scene),
          first_(std::uint32_t(scene.vertices.size())) {}

    void append(const std::vector<glm::vec3>& points) {
        const bool shared = !primitive_.normals.empty();
        if (shared) {
            for (std::size_t i = 0; i < points.size(); ++i)
                scene_.vertices.push_back({points[i], transform_.normal(primitive_.normals[i]), material_});
        }
        for (std::size_t i = 0; i < triangle_count(primitive_); ++i) {
            std::array<std::uint32_t, 3> c = corners(primitive_, i);
            if (transform_.mirrored) std::swap(c[1], c[2]);
            const glm::dvec3 a(points[c[0]]), b(points[c[1]]), d(points[c[2]]);
            const glm::vec3 flat = unit_or_zero(glm::cross(b - a, d - a));
            if (flat == glm::vec3(0.0f)) continue;
            shared ? add_shared(c, flat) : add_flat(points, c, flat);
        }
        if (shared) complete_normals();
    }

  private:
    void add_shared(const std::array<std::uint32_t, 3>& c, const glm::vec3& flat) {
        for (const std::uint32_t corner : c) {
            Vertex& vertex = scene_.vertices[first_ + corner];
            if (vertex.normal == glm::vec3(0.0f)) vertex.normal = flat;
            scene_.indices.push_back(first_ + corner);
        }
    }

    void add_flat(const std::vector<glm::vec3>& points, const std::array<std::uint32_t, 3>& c, const glm::vec3& flat) {
        for (const std::uint32_t corner : c) {
            scene_.indices.push_back(std::uint32_t(scene_.vertices.size()));
            scene_.vertices.push_back({points[corner], flat, material_});
        }
    }

    /// Vertices that no triangle uses may still be without a normal.
    void complete_normals() {
        for (std::size_t i = first_; i < scene_.vertices.size(); ++i) {
            if (scene_.vertices[i].normal == glm::vec3(0.0f)) scene_.vertices[i].normal = {0.0f, 1.0f, 0.0f};
        }
    }

    const Primitive& primitive_;
    const Transform& transform_;
    std::uint32_t material_;
    Scene& scene_;
    std::uint32_t first_;
};

std::uint32_t material_of(const std::string& path, const tinygltf::Model& model, const Primitive& primitive,
                          int material) {
    // The last material of the scene is the default one.
    if (material == -1) return std::uint32_t(model.materials.size());
    if (material < 0 || std::size_t(material) >= model.materials.size())
        fail(path, primitive.name + " names material " + std::to_string(material) + ", which does not exist");
    return std::uint32_t(material);
}

} // namespace

void append_mesh(const std::string& path, const tinygltf::Model& model, std::size_t mesh,
                 const glm::dmat4& world_from_mesh, Scene& scene) {
    const Transform transform(world_from_mesh);
    for (std::size_t i = 0; i < model.meshes[mesh].primitives.size(); ++i) {
        const tinygltf::Primitive& source = model.meshes[mesh].primitives[i];
        const bool has_triangles =
            source.mode == -1 || (source.mode >= TINYGLTF_MODE_TRIANGLES && source.mode <= TINYGLTF_MODE_TRIANGLE_FAN);
        if (!has_triangles || attribute(source, "POSITION") < 0) continue;
        const Primitive primitive =
            read_primitive(path, model, source, element("mesh", mesh) + ", " + element("primitive", i));
        if (scene.vertices.size() + primitive.positions.size() + primitive.indices.size() * 3 > kMostVertices)
            fail(path, "has more than 100,000,000 vertices");
        std::vector<glm::vec3> points(primitive.positions.size());
        for (std::size_t k = 0; k < points.size(); ++k) points[k] = checked_point(path, primitive, transform, k);
        Appender(primitive, transform, material_of(path, model, primitive, source.material), scene).append(points);
    }
}

} // namespace manylights::lab::gltf
