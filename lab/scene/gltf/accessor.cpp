#include "lab/scene/gltf/accessor.h"

#include "lab/scene/gltf/error.h"

#include <algorithm>
#include <cstring>

namespace manylights::lab::gltf {
namespace {

// An accessor without data is all zeros at no cost in the file; this bounds what such a file can make us allocate.
constexpr std::size_t kMostElementsWithoutData = std::size_t(1) << 22;

/// count elements, `stride` bytes apart, inside a buffer.
struct Elements {
    const unsigned char* data = nullptr;
    std::size_t stride = 0;
};

class Reader {
  public:
    Reader(const std::string& path, const tinygltf::Model& model, int index)
        : path_(path), model_(model), index_(index) {
        if (index < 0 || std::size_t(index) >= model.accessors.size())
            fail(path, "accessor " + std::to_string(index) + " does not exist: the file has " +
                           std::to_string(model.accessors.size()));
    }

    const tinygltf::Accessor& accessor() const { return model_.accessors[std::size_t(index_)]; }

    void require(bool holds, const std::string& rule) const {
        if (!holds) fail(path_, element("accessor", std::size_t(index_)) + " " + rule);
    }

    /// Calls set(i, address) for every element with data: the dense ones, then those that a sparse accessor replaces.
    template <typename Set>
    void for_each(std::size_t element_bytes, Set&& set) const {
        const tinygltf::Accessor& a = accessor();
        require(a.count > 0, "is empty");
        if (a.bufferView >= 0) {
            const Elements dense = locate(a.bufferView, a.byteOffset, a.count, element_bytes, true);
            for (std::size_t i = 0; i < a.count; ++i) set(i, dense.data + i * dense.stride);
        } else {
            require(a.count <= kMostElementsWithoutData, "has no buffer view, and more than 4,194,304 elements");
        }
        if (a.sparse.isSparse) for_each_sparse(element_bytes, set);
    }

  private:
    /// Checked without overflow: every element must end inside its buffer view, and that inside its buffer.
    Elements locate(int view_index, std::size_t offset, std::size_t count, std::size_t element_bytes,
                    bool strided) const {
        require(view_index >= 0 && std::size_t(view_index) < model_.bufferViews.size(),
                "names buffer view " + std::to_string(view_index) + ", which does not exist");
        const tinygltf::BufferView& view = model_.bufferViews[std::size_t(view_index)];
        require(view.buffer >= 0 && std::size_t(view.buffer) < model_.buffers.size(),
                "names a buffer that does not exist");
        const std::vector<unsigned char>& data = model_.buffers[std::size_t(view.buffer)].data;
        require(view.byteOffset <= data.size() && view.byteLength <= data.size() - view.byteOffset,
                "has a buffer view that reaches beyond its buffer of " + std::to_string(data.size()) + " bytes");
        const std::size_t stride = strided && view.byteStride != 0 ? view.byteStride : element_bytes;
        require(stride >= element_bytes && stride <= 65535, "has a byte stride that does not fit its elements");
        require(offset <= view.byteLength && element_bytes <= view.byteLength - offset &&
                    count - 1 <= (view.byteLength - offset - element_bytes) / stride,
                "reaches beyond its buffer view of " + std::to_string(view.byteLength) + " bytes");
        return {data.data() + view.byteOffset + offset, stride};
    }

    template <typename Set>
    void for_each_sparse(std::size_t element_bytes, Set&& set) const {
        const tinygltf::Accessor& a = accessor();
        require(a.sparse.count > 0 && std::size_t(a.sparse.count) <= a.count, "has a bad sparse count");
        const auto count = std::size_t(a.sparse.count);
        const std::size_t index_bytes = index_size(a.sparse.indices.componentType);
        // Offsets are signed in some versions of the parser; a negative one becomes too large here, and is refused.
        const Elements indices =
            locate(a.sparse.indices.bufferView, std::size_t(a.sparse.indices.byteOffset), count, index_bytes, false);
        const Elements values =
            locate(a.sparse.values.bufferView, std::size_t(a.sparse.values.byteOffset), count, element_bytes, false);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t target = read_unsigned(indices.data + i * indices.stride, index_bytes);
            require(target < a.count, "has a sparse index beyond its " + std::to_string(a.count) + " elements");
            set(target, values.data + i * values.stride);
        }
    }

  public:
    std::size_t index_size(int component_type) const {
        if (component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return 1;
        if (component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return 2;
        require(component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                "has component type " + std::to_string(component_type) + "; indices are unsigned 8, 16 or 32 bits");
        return 4;
    }

    /// Little-endian, unaligned.
    static std::uint32_t read_unsigned(const unsigned char* bytes, std::size_t size) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < size; ++i) value |= std::uint32_t(bytes[i]) << 8 * i;
        return value;
    }

  private:
    const std::string& path_;
    const tinygltf::Model& model_;
    int index_;
};

/// One component as the format's section 3.11 converts it: normalized integers to [0, 1] or [-1, 1].
float read_component(const unsigned char* bytes, int type, bool normalized) {
    const std::uint32_t low = Reader::read_unsigned(bytes, 1);
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return normalized ? float(low) / 255.0f : float(low);
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
        const auto value = float(std::int8_t(low));
        return normalized ? std::max(value / 127.0f, -1.0f) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
        const auto value = float(Reader::read_unsigned(bytes, 2));
        return normalized ? value / 65535.0f : value;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
        const auto value = float(std::int16_t(Reader::read_unsigned(bytes, 2)));
        return normalized ? std::max(value / 32767.0f, -1.0f) : value;
    }
    default: {
        const std::uint32_t bits = Reader::read_unsigned(bytes, 4);
        float value = 0.0f;
        std::memcpy(&value, &bits, sizeof(value));
        return value;
    }
    }
}

std::size_t component_size(int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        return 0;
    }
}

} // namespace

std::vector<glm::vec3> read_vectors(const std::string& path, const tinygltf::Model& model, int accessor) {
    const Reader reader(path, model, accessor);
    const tinygltf::Accessor& a = reader.accessor();
    reader.require(a.type == TINYGLTF_TYPE_VEC3, "must be of type VEC3");
    const std::size_t size = component_size(a.componentType);
    reader.require(size != 0, "has component type " + std::to_string(a.componentType) + ", which vectors cannot have");
    std::vector<glm::vec3> vectors;
    reader.for_each(3 * size, [&](std::size_t i, const unsigned char* bytes) {
        if (vectors.empty()) vectors.assign(a.count, glm::vec3(0.0f));
        for (int c = 0; c < 3; ++c)
            vectors[i][c] = read_component(bytes + std::size_t(c) * size, a.componentType, a.normalized);
    });
    vectors.resize(a.count, glm::vec3(0.0f));
    return vectors;
}

std::vector<std::uint32_t> read_indices(const std::string& path, const tinygltf::Model& model, int accessor) {
    const Reader reader(path, model, accessor);
    const tinygltf::Accessor& a = reader.accessor();
    reader.require(a.type == TINYGLTF_TYPE_SCALAR, "must be of type SCALAR");
    const std::size_t size = reader.index_size(a.componentType);
    std::vector<std::uint32_t> indices;
    reader.for_each(size, [&](std::size_t i, const unsigned char* bytes) {
        if (indices.empty()) indices.assign(a.count, 0);
        indices[i] = Reader::read_unsigned(bytes, size);
    });
    indices.resize(a.count, 0);
    return indices;
}

} // namespace manylights::lab::gltf
