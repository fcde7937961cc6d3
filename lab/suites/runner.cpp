#include "lab/suites/runner.h"

#include "lab/gpu/device.h"
#include "lab/techniques/truth.h"
#include "lab/techniques/verification.h"

#include <fmt/format.h>

#include <algorithm>

namespace manylights::lab::suites {

struct Runner::Truth {
    PointLists lists;
    std::vector<PixelRecord> records; ///< light sets only
    std::string failure;              ///< why the lists are no truth; empty: they are
};

Runner::Runner(gpu::Device& device, Say say, std::string remove_one_light)
    : device_(device), say_(std::move(say)), remove_one_light_(std::move(remove_one_light)), source_(device) {}

Runner::Truth Runner::find_truth(const Frame& frame) {
    say_("finding the lights of every point");
    const std::vector<PointPosition> positions = frame.points.download_positions();
    Truth truth;
    truth.lists = find_point_lists(frame, positions);
    if (remove_one_light_ == kGridOracle) remove_one_light(truth.lists, positions);
    say_("testing every light at some of the points");
    const ListCheck check = check_lists(frame, truth.lists, positions);
    if (check.first_wrong)
        truth.failure = fmt::format("the grid oracle differs from brute force at pixel ({}, {})",
                                    *check.first_wrong % frame.width, *check.first_wrong / frame.width);
    truth.records = light_set_records(frame, truth.lists, positions, frame.points.download_normals());
    return truth;
}

void Runner::count_work(TimedTechnique& timed, const Frame& frame, const Truth& truth) {
    Measurement& m = timed.measurement;
    const std::vector<PixelRecord> records = timed.technique->record(frame);
    const VerifyResult result = compare_light_sets(truth.records, records, frame.width);
    m.missing_points = result.wrong_pixels;
    m.stats = timed.technique->stats();
    if (result.wrong_pixels != 0) {
        m.wrong = true;
        timed.failure =
            fmt::format("{}: {} of {} points differ from the grid oracle, first at pixel ({}, {}): {} of {} "
                        "affecting lights",
                        m.technique, result.wrong_pixels, result.pixels, result.first_x, result.first_y,
                        result.first_got.affecting, result.first_truth.affecting);
        return;
    }
    m.work = summarize(records);
    m.light_set_hash = light_set_hash(records);
    m.waves = timed.technique->waves(frame);
    m.references_in_range = timed.technique->references_in_range(frame);
}

TimedTechnique Runner::measure(const TechniqueChoice& choice, const Frame& frame, const Truth& truth) {
    say_(choice.name);
    TimedTechnique timed;
    timed.technique = make_technique(device_, choice.name, choice.options);
    timed.measurement.technique = choice.name;
    timed.measurement.options = choice.options;
    timed.technique->prepare(frame);
    if (choice.name == remove_one_light_) timed.technique->remove_one_reference(frame);
    count_work(timed, frame, truth);
    return timed;
}

StepResult Runner::run(const Case& c) {
    say_("drawing the points");
    const Frame& drawn = source_.frame(c);
    const Truth truth = find_truth(drawn);
    Frame frame = drawn;
    frame.lists = &truth.lists;

    std::vector<TimedTechnique> techniques;
    for (const TechniqueChoice& choice : c.techniques) techniques.push_back(measure(choice, frame, truth));
    say_("timing");
    time_techniques(techniques, frame, c.rounds);

    StepResult result;
    for (TimedTechnique& timed : techniques) {
        if (!truth.failure.empty()) {
            timed.failure = fmt::format("{}: {}", timed.measurement.technique, truth.failure);
            timed.measurement.missing_points.reset();
            timed.measurement.wrong = true;
        }
        if (!timed.failure.empty()) result.failures.push_back(fmt::format("{}: {}", case_label(c), timed.failure));
        result.rows.push_back(make_row({c.scene.name, c.lights, frame.camera.name, c.width, c.height}, device_.info(),
                                       timed.measurement));
    }
    return result;
}

} // namespace manylights::lab::suites
