#pragma once
// Everything that a technique needs in place: scene, camera, lights, device and the points of the view.

#include "lab/app/arguments.h"
#include "lab/gpu/device.h"
#include "lab/renderer/point_buffer.h"
#include "lab/renderer/saved_points.h"
#include "lab/suites/row.h"

namespace manylights::lab::app {

/// Throws InputError where the picture, the lights and the scene cannot fit into the device's memory: a software device
/// would rather swap than refuse.
void check_memory(const Selectors& selectors, const Scene& scene, const gpu::DeviceInfo& device);

/// Builds behind a reported time: the median of five is one with warm memory.
constexpr int kTimedBuilds = 5;

class Workbench {
  public:
    /// Throws InputError or DeviceError. Input is read before the device is opened.
    explicit Workbench(const Selectors& selectors);
    Workbench(const Workbench&) = delete;
    Workbench& operator=(const Workbench&) = delete;

    gpu::Device& device() { return device_; }
    const Scene& scene() const { return scene_; }
    const LightSet& lights() const { return lights_; }
    const Frame& frame() const { return frame_; }
    /// As given to the constructor, with the camera and the size of saved points where there are some.
    const Selectors& selectors() const { return selectors_; }
    /// Scene, lights, camera, size, where the points come from if not from here, and device, in one line.
    std::string description() const;
    std::string camera_name() const; ///< as selected; the scene's default camera by its own name
    suites::RowView row_view() const;
    std::vector<std::uint8_t> shaded_mask() const; ///< 1 per pixel with a surface

    /// The options among the given ones that the technique has.
    OptionValues options_for(const std::string& technique) const;
    /// Builds the frame's structures `builds` times: the first one pays for fresh memory, so a time needs several.
    std::unique_ptr<Technique> make_prepared(const std::string& name, int builds);

  private:
    Scene scene_;
    std::optional<SavedPoints> saved_;
    Selectors selectors_;
    Camera camera_;
    LightSet lights_;
    gpu::Device device_;
    PointBuffer points_;
    Frame frame_;
};

} // namespace manylights::lab::app
