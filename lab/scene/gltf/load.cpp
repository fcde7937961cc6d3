#include "lab/scene/gltf/load.h"

#include "lab/scene/builtin/mesh_builder.h"
#include "lab/scene/generated_cameras.h"
#include "lab/scene/gltf/document.h"
#include "lab/scene/gltf/error.h"
#include "lab/scene/gltf/material.h"
#include "lab/scene/gltf/mesh.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace manylights::lab {
namespace gltf {
namespace {

class Loader {
  public:
    explicit Loader(const std::string& path)
        : path_(path), model_(load_document(path)), visited_(model_.nodes.size()) {}

    Scene load() {
        scene_.name = path_;
        for (std::size_t i = 0; i < model_.materials.size(); ++i)
            scene_.materials.push_back(convert_material(path_, model_, i));
        scene_.materials.emplace_back();
        for (const int root : roots()) walk(root);
        if (scene_.indices.empty()) fail(path_, "has no geometry: no triangle with an area in its scene");
        set_extents();
        return std::move(scene_);
    }

  private:
    /// The nodes of the default scene; of the first one; or, without scenes, those that are nobody's child.
    std::vector<int> roots() const {
        if (!model_.scenes.empty()) {
            const int chosen = std::max(model_.defaultScene, 0);
            if (std::size_t(chosen) >= model_.scenes.size())
                fail(path_, "names scene " + std::to_string(chosen) + ", which does not exist");
            return model_.scenes[std::size_t(chosen)].nodes;
        }
        std::vector<bool> is_child(model_.nodes.size());
        for (const tinygltf::Node& node : model_.nodes) {
            for (const int child : node.children) {
                if (child >= 0 && std::size_t(child) < is_child.size()) is_child[std::size_t(child)] = true;
            }
        }
        std::vector<int> result;
        for (std::size_t i = 0; i < is_child.size(); ++i) {
            if (!is_child[i]) result.push_back(int(i));
        }
        return result;
    }

    /// Depth first with a stack of our own: a chain of nodes may be as long as the file.
    void walk(int root) {
        std::vector<std::pair<int, glm::dmat4>> open{{root, glm::dmat4(1.0)}};
        while (!open.empty()) {
            const auto [index, world_from_parent] = open.back();
            open.pop_back();
            if (index < 0 || std::size_t(index) >= model_.nodes.size())
                fail(path_, "names node " + std::to_string(index) + ", which does not exist");
            if (visited_[std::size_t(index)])
                fail(path_, element("node", std::size_t(index)) +
                                " has two parents or is its own ancestor: nodes must form a tree");
            visited_[std::size_t(index)] = true;
            const tinygltf::Node& node = model_.nodes[std::size_t(index)];
            const glm::dmat4 world_from_node = world_from_parent * local_transform(node, std::size_t(index));
            add_node(node, std::size_t(index), world_from_node);
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
                open.emplace_back(*child, world_from_node);
        }
    }

    glm::dmat4 local_transform(const tinygltf::Node& node, std::size_t index) const {
        glm::dmat4 m(1.0);
        if (node.matrix.size() == 16) {
            for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = node.matrix[std::size_t(i)];
        } else {
            glm::dquat q(1.0, 0.0, 0.0, 0.0);
            if (node.rotation.size() == 4)
                q = glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
            m = glm::mat4_cast(glm::normalize(q));
            if (node.scale.size() == 3) {
                for (int c = 0; c < 3; ++c) m[c] *= node.scale[std::size_t(c)];
            }
            if (node.translation.size() == 3)
                m[3] = {node.translation[0], node.translation[1], node.translation[2], 1.0};
        }
        for (int i = 0; i < 16; ++i) {
            if (!(std::fabs(m[i / 4][i % 4]) <= 1e18))
                fail(path_, element("node", index) + " has a transform that is not finite");
        }
        return m;
    }

    void add_node(const tinygltf::Node& node, std::size_t index, const glm::dmat4& world_from_node) {
        if (node.mesh >= 0) {
            if (std::size_t(node.mesh) >= model_.meshes.size())
                fail(path_,
                     element("node", index) + " names mesh " + std::to_string(node.mesh) + ", which does not exist");
            append_mesh(path_, model_, std::size_t(node.mesh), world_from_node, scene_);
        }
        if (node.camera >= 0) {
            if (std::size_t(node.camera) >= model_.cameras.size())
                fail(path_, element("node", index) + " names camera " + std::to_string(node.camera) +
                                ", which does not exist");
            add_camera(node, world_from_node);
        }
        const auto light = node.extensions.find("KHR_lights_punctual");
        if (light != node.extensions.end()) add_light(light->second, index, glm::dvec3(world_from_node[3]));
    }

    glm::vec3 unit(const glm::dvec3& v, const char* what) const {
        const double length = std::sqrt(glm::dot(v, v));
        if (!(length > 1e-12 && length < 1e12))
            fail(path_, std::string(what) + " has no direction: its node's scale is 0 or not finite");
        return glm::vec3(v / length);
    }

    void add_camera(const tinygltf::Node& node, const glm::dmat4& world_from_node) {
        const tinygltf::Camera& source = model_.cameras[std::size_t(node.camera)];
        if (source.type != "perspective") return;
        const double fov = source.perspective.yfov, near_plane = source.perspective.znear;
        const std::string what = element("camera", std::size_t(node.camera));
        if (!(fov > 0.01 && fov < 3.0)) fail(path_, what + ": yfov must be between 0.01 and 3 radians");
        if (!(near_plane > 0.0 && near_plane < 1e6)) fail(path_, what + ": znear must be between 0 and 1e6");
        Camera camera;
        camera.name = unused_name(!node.name.empty() ? node.name : source.name);
        camera.position = glm::vec3(world_from_node[3]);
        camera.forward = unit(-glm::dvec3(world_from_node[2]), "a camera");
        camera.up = unit(glm::dvec3(world_from_node[1]), "a camera");
        if (std::fabs(glm::dot(camera.forward, camera.up)) > 0.999f)
            fail(path_, what + ": its node's axes must not be parallel");
        camera.vertical_fov = float(fov);
        camera.near_plane = std::max(float(near_plane), 1e-6f);
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::fabs(camera.position[axis]) <= 1e9f))
                fail(path_, what + ": its position must be within 1e9 of the origin");
        }
        scene_.cameras.push_back(camera);
    }

    std::string unused_name(const std::string& wanted) const {
        const std::string base = wanted.empty() ? "camera" : wanted;
        const auto is_used = [&](const std::string& name) {
            return std::any_of(scene_.cameras.begin(), scene_.cameras.end(),
                               [&](const Camera& c) { return c.name == name; });
        };
        std::string name = base;
        for (int n = 2; is_used(name); ++n) name = base + std::to_string(n);
        return name;
    }

    void add_light(const tinygltf::Value& reference, std::size_t node, const glm::dvec3& position) {
        const tinygltf::Value& value = reference.IsObject() ? reference.Get("light") : reference;
        const int index = value.IsInt() ? value.GetNumberAsInt() : -1;
        const std::string what = element("node", node) + ", light " + std::to_string(index);
        if (index < 0 || std::size_t(index) >= model_.lights.size()) fail(path_, what + " does not exist");
        const tinygltf::Light& source = model_.lights[std::size_t(index)];
        if (source.type != "point") return;
        Light light{};
        double brightest = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double color = (c < source.color.size() ? source.color[c] : 1.0) * source.intensity;
            if (!(color >= 0.0 && color <= 1e18))
                fail(path_, what + ": color times intensity must be between 0 and 1e18");
            light.color[c] = float(color);
            brightest = std::max(brightest, color);
            if (!(std::fabs(position[int(c)]) <= 1e9))
                fail(path_, what + ": its position must be within 1e9 of the origin");
            light.sphere.center[c] = float(position[int(c)]);
        }
        if (!(source.range >= 0.0)) fail(path_, what + ": range must not be negative");
        // Without a range the light ends where a fully white surface would receive 1/256.
        light.sphere.range = float(std::min(source.range > 0.0 ? source.range : 16.0 * std::sqrt(brightest), 1e18));
        scene_.lights.push_back(light);
    }

    void set_extents() {
        set_bounds(scene_);
        scene_.light_box = scene_.bounds;
        const glm::vec3 size = scene_.bounds.upper - scene_.bounds.lower;
        const float diagonal = std::sqrt(glm::dot(size, size));
        scene_.view_extent = diagonal;
        // No published radii for arbitrary files: generous ones, in the proportions of the built-in scenes, that
        // `auto` scales down from about 500 lights on.
        scene_.radii = {0.03f * diagonal, 0.12f * diagonal, 0.3f * diagonal, 0.8f * diagonal, 0.0005f, 1.0f};
        add_generated_cameras(scene_);
    }

    std::string path_;
    tinygltf::Model model_;
    std::vector<bool> visited_;
    Scene scene_;
};

} // namespace
} // namespace gltf

Scene load_gltf(const std::string& path) { return gltf::Loader(path).load(); }

} // namespace manylights::lab
