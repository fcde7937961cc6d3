#pragma once
// Rows as a suite would make them, without a device.

#include "lab/suites/row.h"

namespace manylights::lab::suites {

inline Measurement sample_measurement(const std::string& technique) {
    Measurement m;
    m.technique = technique;
    m.options = {{"tile_size", "32"}};
    m.work.shaded = 100;
    m.work.tested_mean = 24.5;
    m.work.affecting_mean = 6.125;
    m.waves = WaveSummary{{10, 300, 80, 40, 20, 0}, {20, 500, 150, 60, 30, 0}, 77.0};
    m.stats.references = 7;
    m.stats.structure_bytes = 2048;
    m.stats.build_ms = {3.0, 1.0, 2.0, 10.0};
    m.stats.stages = {{"plan", {2.0, 0.5, 1.5}}, {"write", {1.0}}};
    m.light_set_hash = 0xABCu;
    m.missing_points = 0;
    return m;
}

inline RowView sample_view(const std::string& camera = "street") {
    RowView view;
    view.scene = "canyon";
    view.lights.count = 65536;
    view.camera = camera;
    view.width = 64;
    view.height = 36;
    return view;
}

inline Row sample_row(const std::string& technique = "clustered", const std::string& camera = "street") {
    gpu::DeviceInfo device;
    device.name = "card";
    device.version = "driver 1, new";
    return make_row(sample_view(camera), device, sample_measurement(technique));
}

} // namespace manylights::lab::suites
