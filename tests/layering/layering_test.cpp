// Dependencies point one way, and the shader library has no bindings: read from the sources.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace manylights::test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = MANYLIGHTS_SOURCE_DIR;

struct Layer {
    std::string folder;
    std::set<std::string> may_include; ///< beside itself
};

/// A folder belongs to the first layer whose name it begins with. What is in no layer's list is refused.
const std::vector<Layer> kLayers = {
    {"shaders/manylights/", {}},
    {"include/manylights/", {}},
    {"src/format/", {"shaders/manylights/", "include/manylights/"}},
    {"src/build/", {"src/format/", "shaders/manylights/", "include/manylights/"}},
    {"src/", {"src/build/", "src/format/", "shaders/manylights/", "include/manylights/"}},
    {"reference/", {"shaders/manylights/", "include/manylights/"}},
    {"lab/scene/", {"include/manylights/"}},
    {"lab/gpu/", {"lab/scene/", "include/manylights/", "shaders/manylights/"}},
    {"lab/renderer/", {"lab/gpu/", "lab/scene/", "include/manylights/", "shaders/manylights/", "reference/"}},
    {"lab/techniques/",
     {"lab/renderer/", "lab/gpu/", "lab/scene/", "include/manylights/", "shaders/manylights/", "reference/"}},
    {"lab/suites/",
     {"lab/techniques/", "lab/renderer/", "lab/gpu/", "lab/scene/", "include/manylights/", "shaders/manylights/",
      "reference/"}},
    {"lab/app/",
     {"lab/suites/", "lab/techniques/", "lab/renderer/", "lab/gpu/", "lab/scene/", "include/manylights/",
      "shaders/manylights/", "reference/"}},
};

/// The library depends on the language's own headers, and privately on Highway; its adapter for oneTBB on that.
const std::set<std::string> kStandardHeaders = {
    "algorithm", "array",    "atomic",   "bit",      "cassert", "cfloat",      "climits",     "cmath",
    "compare",   "concepts", "cstddef",  "cstdint",  "cstdlib", "cstring",     "functional",  "iterator",
    "limits",    "memory",   "mutex",    "new",      "numeric", "optional",    "span",        "string",
    "thread",    "tuple",    "utility",  "vector",   "version", "string_view", "type_traits", "initializer_list",
    "stddef.h",  "stdint.h", "stdlib.h", "string.h", "math.h"};

const Layer* layer_of(const std::string& path) {
    for (const Layer& layer : kLayers)
        if (path.starts_with(layer.folder)) return &layer;
    return nullptr;
}

bool is_library(const std::string& path) {
    return path.starts_with("src/") || path.starts_with("include/") || path.starts_with("shaders/");
}

/// The file of the project that an include line names, from the root; empty where it is none of the project's.
std::string resolve(const std::string& from, const std::string& name) {
    for (const fs::path& base : {fs::path(""), fs::path("include"), fs::path("shaders"), fs::path(from).parent_path()})
        if (fs::is_regular_file(kRoot / base / name)) return (base / name).lexically_normal().generic_string();
    return "";
}

/// Why this file must not include that name; empty where it may.
std::string violation(const std::string& from, const std::string& name) {
    const Layer* layer = layer_of(from);
    if (layer == nullptr) return "";
    std::string target = resolve(from, name);
    bool names_a_part = name.starts_with("lab/") || name.starts_with("tests/") || name.starts_with("reference/") ||
                        name.starts_with("src/") || name.starts_with("bench/") || name.starts_with("examples/");
    if (target.empty() && names_a_part) target = name;
    if (target.empty()) {
        if (from.starts_with("src/") && name.starts_with("hwy/")) return "";
        if (from == "include/manylights/manylights_tbb.hpp" && name.starts_with("tbb/")) return "";
        if (is_library(from) && !kStandardHeaders.contains(name)) return "the library includes a third party's header";
        if (from.starts_with("lab/scene/") && name.find("vulkan") != std::string::npos) return "lab/scene knows no GPU";
        return "";
    }
    const Layer* of_target = layer_of(target);
    if (of_target == layer) return "";
    if (of_target != nullptr)
        for (const std::string& allowed : layer->may_include)
            if (target.starts_with(allowed)) return "";
    return layer->folder + " must not know " + target;
}

struct Source {
    std::string path, text;
};

std::vector<Source> read_sources() {
    static const std::set<std::string> kExtensions = {".h",    ".hpp",  ".c",    ".cpp",  ".glsl",
                                                      ".hlsl", ".comp", ".vert", ".frag", ".inl"};
    std::vector<Source> sources;
    for (const char* top : {"include", "shaders", "src", "reference", "lab", "tests", "bench", "examples"}) {
        if (!fs::is_directory(kRoot / top)) continue;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kRoot / top)) {
            if (!entry.is_regular_file() || !kExtensions.contains(entry.path().extension().string())) continue;
            std::ifstream file(entry.path(), std::ios::binary);
            std::ostringstream text;
            text << file.rdbuf();
            sources.push_back({fs::relative(entry.path(), kRoot).generic_string(), text.str()});
        }
    }
    return sources;
}

std::vector<std::string> included_names(const std::string& text) {
    static const std::regex kInclude(R"re(^[ \t]*#[ \t]*include[ \t]*[<"]([^>"\n]+)[>"])re", std::regex::multiline);
    std::vector<std::string> names;
    for (std::sregex_iterator it(text.begin(), text.end(), kInclude), end; it != end; ++it) names.push_back((*it)[1]);
    return names;
}

std::string without_comments(const std::string& text) {
    static const std::regex kComment(R"(//[^\n]*|/\*[^*]*\*+(?:[^/*][^*]*\*+)*/)");
    return std::regex_replace(text, kComment, "");
}

TEST(Layering, IncludesPointOneWay) {
    std::size_t files = 0, includes = 0;
    for (const Source& source : read_sources()) {
        ++files;
        for (const std::string& name : included_names(source.text)) {
            ++includes;
            EXPECT_EQ(violation(source.path, name), "") << source.path << " includes " << name;
        }
    }
    EXPECT_GT(files, 30u);
    EXPECT_GT(includes, 100u);
}

TEST(Layering, TheRuleRefusesWhatPointsTheOtherWay) {
    for (auto [from, name] :
         std::vector<std::pair<std::string, std::string>>{{"include/manylights/manylights.h", "vector3.h"},
                                                          {"include/manylights/manylights.h", "vulkan/vulkan.h"},
                                                          {"include/manylights/manylights.hpp", "tbb/parallel_for.h"},
                                                          {"include/manylights/manylights.h", "manylights/format.h"},
                                                          {"shaders/manylights/format.h", "manylights/manylights.h"},
                                                          {"src/format/layout.h", "src/build/camera.h"},
                                                          {"src/build/camera.cpp", "src/api/anything.h"},
                                                          {"src/build/camera.cpp", "reference/oracle/camera.h"},
                                                          {"src/build/camera.cpp", "lab/scene/scene.h"},
                                                          {"src/build/camera.cpp", "tests/property/frame.h"},
                                                          {"src/build/camera.cpp", "glm/glm.hpp"},
                                                          {"reference/oracle/camera.cpp", "src/build/camera.h"},
                                                          {"reference/oracle/camera.cpp", "lab/scene/camera.h"},
                                                          {"lab/scene/camera.cpp", "lab/gpu/context.h"},
                                                          {"lab/scene/camera.cpp", "vulkan/vulkan_raii.hpp"},
                                                          {"lab/scene/camera.cpp", "src/build/camera.h"},
                                                          {"lab/gpu/context.cpp", "lab/renderer/anything.h"},
                                                          {"lab/renderer/anything.cpp", "lab/techniques/technique.h"},
                                                          {"lab/techniques/anything.cpp", "lab/app/arguments.h"},
                                                          {"lab/techniques/anything.cpp", "src/build/camera.h"},
                                                          {"lab/app/main.cpp", "tests/property/frame.h"}})
        EXPECT_NE(violation(from, name), "") << from << " includes " << name;
    EXPECT_EQ(violation("src/build/camera.cpp", "src/format/layout.h"), "");
    EXPECT_EQ(violation("lab/app/main.cpp", "lab/techniques/technique.h"), "");
    EXPECT_EQ(violation("lab/scene/camera.cpp", "glm/glm.hpp"), "");
}

TEST(Layering, TheQueryTextHasNoBindings) {
    static const std::regex kBinding(R"(layout\s*\(|register\s*\(|\[\[\s*vk\s*::)");
    ASSERT_TRUE(std::regex_search("layout(std430) buffer", kBinding));
    ASSERT_TRUE(std::regex_search(": register(t0)", kBinding));
    ASSERT_TRUE(std::regex_search("[[vk::binding(0)]]", kBinding));
    int read = 0;
    for (const Source& source : read_sources())
        if (source.path == "shaders/manylights/format.h" || source.path == "shaders/manylights/query.h") {
            ++read;
            EXPECT_FALSE(std::regex_search(without_comments(source.text), kBinding)) << source.path;
        }
    EXPECT_EQ(read, 2);
}

/// Definitions of structs named Ml*, by name: the files that hold one.
std::map<std::string, std::vector<std::string>> layout_definitions(const std::vector<Source>& sources) {
    static const std::regex kDefinition(R"(\bstruct\s+(Ml[A-Za-z0-9]*)\s*\{)");
    std::map<std::string, std::vector<std::string>> definitions;
    for (const Source& source : sources) {
        std::string text = without_comments(source.text);
        for (std::sregex_iterator it(text.begin(), text.end(), kDefinition), end; it != end; ++it)
            definitions[(*it)[1]].push_back(source.path);
    }
    return definitions;
}

TEST(Layering, LayoutsAreDeclaredOnceForAllLanguages) {
    std::map<std::string, std::vector<std::string>> definitions = layout_definitions(read_sources());
    for (const char* name : {"MlView", "MlCell", "MlNode"})
        EXPECT_EQ(definitions[name], std::vector<std::string>{"shaders/manylights/format.h"}) << name;
    for (const auto& [name, files] : definitions)
        EXPECT_EQ(files.size(), 1u) << name << " is declared in " << files[0] << " and " << files[files.size() - 1];
    EXPECT_EQ(layout_definitions({{"a.h", std::string("struct ") + "MlNode {"},
                                  {"b.comp", std::string("struct ") + "MlNode\n{"}})["MlNode"]
                  .size(),
              2u);
}

} // namespace
} // namespace manylights::test
