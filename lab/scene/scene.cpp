#include "lab/scene/scene.h"

#include "lab/scene/builtin/builtin.h"
#include "lab/scene/error.h"
#include "lab/scene/gltf/load.h"

#include <charconv>

namespace manylights::lab {
namespace {

struct Builtin {
    const char* name;
    const char* summary;
    Scene (*make)(Detail);
};

constexpr Builtin kBuiltins[] = {
    {"canyon", "winding rock walls, pillars and bridges, 200 x 60 x 600 m", make_canyon},
    {"citadel", "town on a terraced hill, 3 x 3 km, very long views", make_citadel},
    {"bars", "thin tall bars in front of a wall, 400 x 400 m", make_bars},
    {"cornell", "Cornell box, 10 x 10 x 10 m", make_cornell},
    {"blocktown", "walled town of unit blocks on an island, 768 x 128 x 640", make_blocktown},
};

bool ends_with(const std::string& text, const char* ending) {
    const std::string suffix(ending);
    return text.size() >= suffix.size() && text.compare(text.size() - suffix.size(), suffix.size(), suffix) == 0;
}

/// The camera at parameter t of the closed interval between two frames.
Camera between(const Camera& a, const Camera& b, float t) {
    Camera camera = a;
    camera.position = a.position * (1.0f - t) + b.position * t;
    camera.forward = glm::normalize(a.forward * (1.0f - t) + b.forward * t);
    camera.up = glm::normalize(a.up * (1.0f - t) + b.up * t);
    return camera;
}

Camera path_camera(const Scene& scene, const std::string& selector) {
    float t = -1.0f;
    const char* end = selector.data() + selector.size();
    const auto [rest, error] = std::from_chars(selector.data() + 5, end, t);
    if (error != std::errc() || rest != end || !(t >= 0.0f && t < 1.0f))
        throw InputError("camera \"" + selector + "\": path:T needs a number T in [0, 1)");
    // Frame i of n lies at t = i / n, so that path:0, path:0.0625, ... are exactly the fixed frames of 16.
    const float position = t * float(scene.path.size());
    const auto frame = std::size_t(position);
    if (frame + 1 >= scene.path.size()) return scene.path.back();
    return between(scene.path[frame], scene.path[frame + 1], position - float(frame));
}

} // namespace

std::vector<SceneInfo> builtin_scenes() {
    std::vector<SceneInfo> infos;
    for (const Builtin& builtin : kBuiltins) infos.push_back({builtin.name, builtin.summary});
    return infos;
}

Scene load_scene(const std::string& name_or_path, Detail detail) {
    std::string names;
    for (const Builtin& builtin : kBuiltins) {
        if (name_or_path == builtin.name) return builtin.make(detail);
        names += std::string(builtin.name) + ", ";
    }
    if (ends_with(name_or_path, ".glb") || ends_with(name_or_path, ".gltf")) return load_gltf(name_or_path);
    throw InputError("scene \"" + name_or_path + "\": must be one of " + names + "or the path of a .glb or .gltf file");
}

Camera find_camera(const Scene& scene, const std::string& selector) {
    if (selector.empty()) return scene.cameras.front();
    if (selector.rfind("path:", 0) == 0) return path_camera(scene, selector);
    std::string names;
    for (const Camera& camera : scene.cameras) {
        if (camera.name == selector) return camera;
        names += camera.name + ", ";
    }
    throw InputError("camera \"" + selector + "\": must be one of " + names + "or path:T with T in [0, 1)");
}

} // namespace manylights::lab
