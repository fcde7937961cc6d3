#pragma once

#include "lab/scene/error.h"

namespace manylights::lab::gltf {

/// One line: which file, what in it, which rule it breaks.
[[noreturn]] inline void fail(const std::string& path, const std::string& what) {
    throw InputError("scene \"" + path + "\": " + what);
}

inline std::string element(const char* kind, std::size_t index) {
    return std::string(kind) + " " + std::to_string(index);
}

} // namespace manylights::lab::gltf
