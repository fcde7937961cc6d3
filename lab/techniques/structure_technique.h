#pragma once
// A technique whose structure has the library's format: a build on the CPU or on the device, the common shading pass
// with a query of the library. The techniques of this kind differ in their options, in what is built and in their
// query.

#include "lab/techniques/structure_build.h"

#include <optional>

namespace manylights::lab {

/// The forms of a shader that walks the structure; its five buffers follow the common ones, as in
/// structure_accessors.glsl.
struct QueryShaders {
    std::span<const std::uint32_t> record, shade, log;
    std::vector<std::uint32_t> constants{}; ///< as in PassShaders
    bool log_has_wave_size = false;
};
/// The library's per-pixel cursor: cursor.glsl.
QueryShaders cursor_shaders();
/// The cursor, or where the options ask for what it has not: tree_walk.glsl.
QueryShaders tree_shaders(const StructureOptions& options);

class StructureTechnique : public Technique {
  public:
    /// info lists the options of the kind, and those that the technique reads itself.
    StructureTechnique(gpu::Device& device, TechniqueInfo info, StructureKind kind, const OptionValues& values);
    StructureTechnique(gpu::Device& device, TechniqueInfo info, const StructureOptions& options);
    StructureTechnique(gpu::Device& device, TechniqueInfo info, const StructureOptions& options,
                       const QueryShaders& shaders);

    const TechniqueInfo& info() const override { return info_; }
    void prepare(const Frame& frame) override;
    void rebuild(const Frame& frame) override;
    std::vector<PixelRecord> record(const Frame& frame) override;
    std::vector<float> shade(const Frame& frame) override;
    WaveSummary waves(const Frame& frame) override;
    std::optional<double> references_in_range(const Frame& frame) override;
    std::vector<CellClass> classify(const Frame& frame) override;
    bool remove_one_reference(const Frame& frame) override;

  protected:
    /// What a technique makes of the producer's structure on the device, in buffers of its own, before anything reads
    /// it. As it is, by default.
    virtual BuiltStructure refine(const Frame&, const BuiltStructure& built) { return built; }
    /// Adds a time to the stage of this name, a new one behind those that are there.
    void add_stage(const std::string& name, double ms);

    const BuiltStructure& structure() const { return structure_; }

  private:
    gpu::Device& device_;
    TechniqueInfo info_;
    bool has_records_;
    std::unique_ptr<StructureBuild> build_;
    BuiltStructure structure_;
    std::optional<FrameLights> lights_;
    ShadingPass pass_;
};

/// What their infos have in common: no depth needed, every kind of surface served.
TechniqueInfo structure_technique_info(const char* name, const char* summary, StructureKind kind);

} // namespace manylights::lab
