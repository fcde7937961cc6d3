#include "lab/scene/gltf/material.h"

#include "lab/scene/gltf/error.h"

#include <algorithm>
#include <cmath>

namespace manylights::lab::gltf {
namespace {

glm::vec3 color_factor(const std::vector<double>& factor, float missing) {
    glm::vec3 color(missing);
    for (int c = 0; c < 3 && std::size_t(c) < factor.size(); ++c) color[c] = float(factor[std::size_t(c)]);
    return color;
}

double emissive_strength(const tinygltf::Material& material) {
    const auto extension = material.extensions.find("KHR_materials_emissive_strength");
    if (extension == material.extensions.end() || !extension->second.IsObject()) return 1.0;
    const tinygltf::Value& strength = extension->second.Get("emissiveStrength");
    return strength.IsNumber() ? strength.GetNumberAsDouble() : 1.0;
}

bool is_good(const glm::vec3& color) {
    for (int c = 0; c < 3; ++c) {
        if (!(color[c] >= 0.0f && color[c] <= 1e9f)) return false;
    }
    return true;
}

} // namespace

Material convert_material(const std::string& path, const tinygltf::Model& model, std::size_t index) {
    const tinygltf::Material& source = model.materials[index];
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    Material material;
    material.base_color = color_factor(pbr.baseColorFactor, 1.0f);
    material.roughness = float(pbr.roughnessFactor);
    material.metallic = float(pbr.metallicFactor);
    material.emissive = color_factor(source.emissiveFactor, 0.0f) * float(emissive_strength(source));
    // Textures are not read, so a middle value stands in for what each would have multiplied its factor by.
    if (pbr.baseColorTexture.index >= 0) material.base_color *= 0.6f;
    if (pbr.metallicRoughnessTexture.index >= 0) {
        material.roughness *= 0.7f;
        material.metallic = 0.0f;
    }
    if (source.emissiveTexture.index >= 0) material.emissive = glm::vec3(0.0f);
    if (!is_good(material.base_color) || !is_good(material.emissive) || !(material.roughness >= 0.0f) ||
        !(material.metallic >= 0.0f))
        fail(path, element("material", index) + " has a factor that is negative, not finite, or above 1e9");
    material.base_color = glm::min(material.base_color, glm::vec3(1.0f));
    material.roughness = std::min(material.roughness, 1.0f);
    material.metallic = std::min(material.metallic, 1.0f);
    return material;
}

} // namespace manylights::lab::gltf
