#include "lab/app/commands.h"
#include "lab/app/figure.h"
#include "lab/app/number_scale.h"
#include "lab/app/progress.h"
#include "lab/app/statistics_file.h"
#include "lab/app/validation_report.h"
#include "lab/app/work_table.h"
#include "lab/app/workbench.h"
#include "lab/renderer/image_file.h"
#include "lab/renderer/tone_map.h"
#include "lab/renderer/unfinished_file.h"
#include "lab/scene/error.h"
#include "lab/techniques/verification.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace manylights::lab::app {
namespace {

/// What one technique made of the frame, as far as the view needs it.
struct Panel {
    suites::Measurement measurement;
    std::vector<float> radiance;    ///< linear RGB per pixel
    std::vector<float> values;      ///< of a false-colour view, per pixel; -1: sky
    std::vector<CellClass> classes; ///< of the structure view
};

constexpr float kSkyValue = -1.0f;

float value_of(const PixelRecord& record, ViewKind view) {
    if (record.shaded == 0) return kSkyValue;
    switch (view) {
    case ViewKind::tested:
        return static_cast<float>(record.tested);
    case ViewKind::affecting:
        return static_cast<float>(record.affecting);
    case ViewKind::nodes:
        return static_cast<float>(record.nodes);
    case ViewKind::references:
        return static_cast<float>(record.references);
    case ViewKind::shaded:
    case ViewKind::structure:
        break;
    }
    return 0.0f;
}

std::vector<float> values_of(const std::vector<PixelRecord>& records, ViewKind view) {
    std::vector<float> values;
    values.reserve(records.size());
    for (const PixelRecord& record : records) values.push_back(value_of(record, view));
    return values;
}

bool shows_numbers(ViewKind view) { return view != ViewKind::shaded && view != ViewKind::structure; }

bool measures_work(const RenderArguments& arguments) {
    return shows_numbers(arguments.view) || !arguments.stats.empty();
}

std::vector<CellClass> classes_of(Technique& technique, const Frame& frame) {
    std::vector<CellClass> classes = technique.classify(frame);
    if (classes.empty())
        throw InputError(fmt::format("--view structure: {} has no cells; clustered, tiled_light_trees, "
                                     "hybrid_light_trees, depth_windows and depth_windows_wave have",
                                     technique.info().name));
    return classes;
}

// Sky has no cell to speak of, whatever its tile holds.
void drop_sky(std::vector<CellClass>& classes, const std::vector<std::uint8_t>& mask) {
    for (std::size_t i = 0; i < classes.size(); ++i)
        if (mask.at(i) == 0) classes[i] = CellClass::none;
}

Panel make_panel(Workbench& bench, const std::string& name, const RenderArguments& arguments, Progress& progress) {
    progress.at(fmt::format("{}: building", name));
    const std::unique_ptr<Technique> technique = bench.make_prepared(name, measures_work(arguments) ? kTimedBuilds : 1);
    Panel panel;
    progress.at(fmt::format("{}: shading", name));
    if (!shows_numbers(arguments.view) || !arguments.stats.empty()) panel.radiance = technique->shade(bench.frame());
    if (measures_work(arguments)) {
        const std::vector<PixelRecord> records = technique->record(bench.frame());
        panel.measurement.work = summarize(records);
        panel.measurement.light_set_hash = light_set_hash(records);
        panel.values = values_of(records, arguments.view);
    }
    if (!arguments.stats.empty()) {
        panel.measurement.waves = technique->waves(bench.frame());
        panel.measurement.references_in_range = technique->references_in_range(bench.frame());
    }
    if (arguments.view == ViewKind::structure) {
        panel.classes = classes_of(*technique, bench.frame());
        drop_sky(panel.classes, bench.shaded_mask());
    }
    panel.measurement.technique = name;
    panel.measurement.options = bench.options_for(name);
    panel.measurement.stats = technique->stats();
    return panel;
}

const char* view_title(ViewKind view) {
    switch (view) {
    case ViewKind::tested:
        return "lights tested per pixel";
    case ViewKind::affecting:
        return "lights that affect a pixel's point";
    case ViewKind::nodes:
        return "tree nodes visited per pixel";
    case ViewKind::references:
        return "references read per pixel";
    case ViewKind::shaded:
    case ViewKind::structure:
        break;
    }
    return "";
}

std::vector<float> surface_values(const std::vector<Panel>& panels) {
    std::vector<float> values;
    for (const Panel& panel : panels)
        std::copy_if(panel.values.begin(), panel.values.end(), std::back_inserter(values),
                     [](float value) { return value >= 0.0f; });
    return values;
}

double mean_of(const std::vector<float>& values) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const float value : values) {
        if (value < 0.0f) continue;
        sum += static_cast<double>(value);
        ++count;
    }
    return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

// One scale and one exposure for all pictures of a run.
struct Look {
    HeatScale scale;
    float exposure = 0.0f;
    std::vector<std::uint8_t> mask;
};

Look choose_look(const std::vector<Panel>& panels, const Workbench& bench, const RenderArguments& arguments) {
    Look look;
    look.mask = bench.shaded_mask();
    if (!shows_numbers(arguments.view)) {
        look.exposure = auto_exposure(panels.at(0).radiance, look.mask);
        return look;
    }
    const std::vector<float> values = surface_values(panels);
    look.scale.title = view_title(arguments.view);
    look.scale.top = arguments.scale_max ? *arguments.scale_max : round_up_nicely(percentile(values, 0.99));
    look.scale.largest = values.empty() ? 0.0 : static_cast<double>(*std::max_element(values.begin(), values.end()));
    return look;
}

Canvas draw_numbers(std::span<const Panel> panels, const Look& look, const Frame& frame) {
    std::vector<HeatPanel> drawn;
    for (const Panel& panel : panels)
        drawn.push_back({fmt::format("{}: mean {}", panel.measurement.technique, short_number(mean_of(panel.values))),
                         panel.values});
    return heat_figure(drawn, look.scale, static_cast<int>(frame.width), static_cast<int>(frame.height));
}

Canvas draw_structure(std::span<const Panel> panels, const std::vector<Canvas>& shaded, const Frame& frame) {
    std::vector<StructurePanel> drawn;
    for (std::size_t i = 0; i < panels.size(); ++i)
        drawn.push_back({panels[i].measurement.technique, panels[i].classes, shaded[i]});
    return structure_figure(drawn, static_cast<int>(frame.width), static_cast<int>(frame.height));
}

Canvas draw(std::span<const Panel> panels, const Look& look, ViewKind view, const Frame& frame) {
    if (shows_numbers(view)) return draw_numbers(panels, look, frame);
    std::vector<Canvas> pictures;
    std::vector<std::string> names;
    for (const Panel& panel : panels) {
        pictures.emplace_back(tone_map(panel.radiance, look.mask, frame.width, frame.height, look.exposure));
        names.push_back(panel.measurement.technique);
    }
    if (view == ViewKind::structure) return draw_structure(panels, pictures, frame);
    return pictures.size() == 1 ? pictures[0] : picture_row(names, pictures);
}

// The plain numbers: radiance, or a view's count in all three channels (-1 sky), or the class's number.
std::array<float, 3> plain_pixel(const Panel& panel, ViewKind view, std::size_t pixel) {
    if (view == ViewKind::shaded)
        return {panel.radiance[3 * pixel], panel.radiance[3 * pixel + 1], panel.radiance[3 * pixel + 2]};
    const float value = view == ViewKind::structure ? static_cast<float>(panel.classes[pixel]) : panel.values[pixel];
    return {value, value, value};
}

// Panels side by side without anything drawn on or between them.
std::vector<float> plain_image(std::span<const Panel> panels, const Frame& frame, ViewKind view) {
    std::vector<float> rgb;
    rgb.reserve(std::size_t{3} * frame.width * frame.height * panels.size());
    for (std::uint32_t y = 0; y < frame.height; ++y)
        for (const Panel& panel : panels)
            for (std::uint32_t x = 0; x < frame.width; ++x)
                for (const float channel : plain_pixel(panel, view, std::size_t{y} * frame.width + x))
                    rgb.push_back(channel);
    return rgb;
}

void write_picture(const std::string& path, std::span<const Panel> panels, const Look& look, ViewKind view,
                   const Frame& frame) {
    if (path.ends_with(".exr"))
        write_exr(path, plain_image(panels, frame, view), frame.width * static_cast<std::uint32_t>(panels.size()),
                  frame.height);
    else
        write_png(path, draw(panels, look, view, frame).picture());
}

std::string panel_path(const RenderArguments& arguments, const std::string& technique) {
    std::string path = arguments.panels;
    return path.replace(path.find("{}"), 2, technique);
}

void check_paths(const RenderArguments& arguments) {
    check_writable(arguments.out);
    if (!arguments.panels.empty())
        for (const std::string& name : arguments.techniques) check_writable(panel_path(arguments, name));
    if (!arguments.stats.empty()) check_writable(arguments.stats);
}

void write_pictures(const std::vector<Panel>& panels, const Workbench& bench, const RenderArguments& arguments) {
    const Look look = choose_look(panels, bench, arguments);
    write_picture(arguments.out, panels, look, arguments.view, bench.frame());
    if (arguments.panels.empty()) return;
    for (const Panel& panel : panels)
        write_picture(panel_path(arguments, panel.measurement.technique), {&panel, 1}, look, arguments.view,
                      bench.frame());
}

void print_work(const std::vector<Panel>& panels, const Workbench& bench, const RenderArguments& arguments) {
    if (!measures_work(arguments)) return;
    std::vector<suites::Measurement> measurements;
    for (const Panel& panel : panels) measurements.push_back(panel.measurement);
    fmt::print("{}\n{}", bench.description(), work_table(measurements, {}));
}

void write_rows(const std::vector<Panel>& panels, Workbench& bench, const RenderArguments& arguments) {
    if (arguments.stats.empty()) return;
    std::vector<suites::Row> rows;
    for (const Panel& panel : panels)
        rows.push_back(make_row(bench.row_view(), bench.device().info(), panel.measurement));
    write_statistics(arguments.stats, rows);
}

} // namespace

int run_render(const RenderArguments& arguments) {
    check_paths(arguments);
    std::vector<Panel> panels;
    Progress progress;
    progress.at("loading");
    Workbench bench(arguments.selectors);
    for (const std::string& name : arguments.techniques) panels.push_back(make_panel(bench, name, arguments, progress));
    progress.at("writing");
    write_pictures(panels, bench, arguments);
    write_rows(panels, bench, arguments);
    progress.clear();
    print_work(panels, bench, arguments);
    return report_validation(bench.device());
}

} // namespace manylights::lab::app
