#include "lab/techniques/pass_technique.h"

namespace manylights::lab {

PassTechnique::PassTechnique(gpu::Device& device, TechniqueInfo info, const PassShaders& shaders)
    : DeviceTechnique(device, std::move(info)), pass_(device, shaders, LightSplit::none) {}

std::vector<PixelRecord> PassTechnique::record(const Frame& frame) {
    return pass_.record(frame, lights(), one_band(frame, structure()));
}

std::vector<float> PassTechnique::shade(const Frame& frame) {
    return pass_.shade(frame, lights(), one_band(frame, structure()), stats_.shade_ms);
}

WaveSummary PassTechnique::waves(const Frame& frame) {
    return pass_.waves(frame, lights(), one_band(frame, structure()));
}

} // namespace manylights::lab
