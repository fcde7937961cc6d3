#include "lab/app/arguments.h"

#include "lab/app/bench_arguments.h"
#include "lab/app/option_values.h"
#include "lab/app/technique_arguments.h"
#include "lab/scene/error.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace manylights::lab::app {
namespace {

constexpr std::array<const char*, 6> kViewNames = {"shaded", "tested", "affecting", "nodes", "references", "structure"};
constexpr std::array<const char*, 4> kListNames = {"scenes", "techniques", "suites", "devices"};
constexpr std::array<const char*, 2> kDetailNames = {"low", "full"};
constexpr std::array<const char*, 3> kTruthNames = {"auto", "brute_force", kGridOracle};

// Option values as they were typed; CLI11 finds them, the functions below judge them, so all refusals sound alike.
struct Typed {
    std::string lights = "65536", seed = "1", kinds = "point", size, detail = "full", view = "shaded", scale_max;
    CLI::Option *size_option = nullptr, *distribution_option = nullptr;
    std::string truth = "auto";
    std::vector<std::string> settings, techniques;
    std::string list;
};

void read_settings(const std::vector<std::string>& texts, OptionValues& settings) {
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0) refuse("--set", text, "KEY=VALUE");
        settings.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
}

// Spots and boxes have their own membership rule, which this version's shaders do not have.
void check_kinds(const std::string& text) {
    if (text != "point") refuse("--kinds", text, "point: this version shades point lights, and no spots or boxes");
}

void read_selectors(const Typed& typed, Selectors& selectors) {
    selectors.lights.count = whole_number("--lights", typed.lights, 0, kMostLights);
    selectors.lights.seed = whole_number("--seed", typed.seed, 0, 0xFFFFFFFFu);
    selectors.detail = choice("--detail", typed.detail, kDetailNames) == 0 ? Detail::low : Detail::full;
    check_kinds(typed.kinds);
    const ImageSize size = image_size("--size", typed.size);
    selectors.width = size.width;
    selectors.height = size.height;
    selectors.scene_distribution = typed.distribution_option->count() == 0;
    selectors.size_given = typed.size_option->count() > 0;
    read_settings(typed.settings, selectors.settings);
}

void add_selectors(CLI::App& app, Selectors& selectors, Typed& typed) {
    app.add_option("--scene", selectors.scene, "a built-in scene (see `list scenes`) or a .glb or .gltf file [canyon]");
    app.add_option("--detail", typed.detail, "of built-in scenes: low or full [full]");
    app.add_option("--lights", typed.lights, "how many, 0 to 16777216 [65536]");
    typed.distribution_option =
        app.add_option("--distribution", selectors.lights.distribution,
                       "volume, surface, surface-largest, groups, view or file [blocktown: groups, else volume]");
    app.add_option("--seed", typed.seed, "of the distribution, a 32-bit number [1]");
    app.add_option("--radius", selectors.lights.radius,
                   "auto (about 6 lights affect a point), mix (as the distribution makes them) or MIN:MAX [auto]");
    app.add_option("--kinds", typed.kinds, "of lights: point [point]");
    app.add_option("--set", typed.settings, "KEY=VALUE, an option of the technique; may be repeated")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--camera", selectors.camera, "a camera's name, or path:T with T in [0, 1) [the scene's first]");
    typed.size_option = app.add_option("--size", typed.size, fmt::format("WIDTHxHEIGHT in pixels [{}]", typed.size));
    app.add_option("--points", selectors.points,
                   "FILE of the view's points: saved where it is not there yet, else loaded, with its camera and size");
    app.add_option("--device", selectors.device, "index in `list devices` or part of a name [the best one]");
    app.add_flag("--validation", selectors.validation, "run under core and synchronization validation");
}

// One line out of CLI11's words.
std::string usage_error(const CLI::ParseError& error, const CLI::App& app) {
    std::string text = error.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    std::string command = "manylights";
    for (const CLI::App* used : app.get_subcommands()) command += " " + used->get_name();
    return fmt::format("usage: {}; see `{} --help`", text, command);
}

void check_picture_name(const std::string& option, const std::string& path) {
    if (!path.ends_with(".png") && !path.ends_with(".exr"))
        refuse(option, path, "a file name that ends in .png or .exr");
}

void check_render_paths(const RenderArguments& render) {
    check_picture_name("--out", render.out);
    if (render.panels.empty()) return;
    check_picture_name("--panels", render.panels);
    if (render.panels.find("{}") == std::string::npos)
        refuse("--panels", render.panels, "a file name with {} where the technique's name goes");
}

RenderArguments finish_render(RenderArguments render, const Typed& typed, const std::string& technique) {
    read_selectors(typed, render.selectors);
    render.view = static_cast<ViewKind>(choice("--view", typed.view, kViewNames));
    if (!typed.scale_max.empty()) render.scale_max = positive_number("--scale-max", typed.scale_max);
    if (typed.techniques.empty()) {
        check_technique("--technique", technique, technique_names());
        render.techniques = {technique};
    } else {
        render.techniques = read_techniques(typed.techniques);
    }
    check_setting_keys(render.selectors.settings, render.techniques);
    check_render_paths(render);
    return render;
}

VerifyArguments finish_verify(VerifyArguments verify, const Typed& typed) {
    read_selectors(typed, verify.selectors);
    const std::vector<std::string> all = {"all"};
    verify.all_techniques = typed.techniques.empty() || typed.techniques == all;
    verify.techniques = read_techniques(verify.all_techniques ? all : typed.techniques);
    check_setting_keys(verify.selectors.settings, verify.techniques);
    verify.truth = static_cast<TruthKind>(choice("--truth", typed.truth, kTruthNames));
    if (verify.remove_one_light.empty() || verify.remove_one_light == kGridOracle) return verify;
    check_technique("--remove-one-light", verify.remove_one_light, verify.techniques);
    return verify;
}

void add_render(CLI::App& app, RenderArguments& render, Typed& typed, std::string& technique) {
    add_selectors(app, render.selectors, typed);
    CLI::Option* one = app.add_option("--technique", technique, "see `list techniques` [hybrid_light_trees]");
    app.add_option("--techniques", typed.techniques, "NAME,NAME,... or all: pictures side by side on one scale")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->excludes(one);
    app.add_option(
        "--view", typed.view,
        "shaded; false colours of the lights tested, affecting, the nodes or references walked per pixel; or "
        "the structure that served it [shaded]");
    app.add_option("--scale-max", typed.scale_max,
                   "the number at the top of the false colours, so that pictures compare [99th percentile, rounded]");
    app.add_option("--out", render.out, "FILE.png or FILE.exr (linear radiance, or the plain numbers of a view)")
        ->required();
    app.add_option("--panels", render.panels,
                   "FILE{}.png: each technique's picture alone as well, on the same scale; {} becomes its name");
    app.add_option("--stats", render.stats, "FILE.json: work, bytes and times");
}

void add_verify(CLI::App& app, VerifyArguments& verify, Typed& typed) {
    add_selectors(app, verify.selectors, typed);
    app.add_option("--techniques", typed.techniques, "NAME,NAME,... or all [all]")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option(
        "--truth", typed.truth,
        "what is right: brute_force; grid (a quick oracle, itself checked against brute force at 4,096 points); "
        "or auto, brute force where that takes no longer than about half a minute [auto]");
    app.add_option("--stats", verify.stats, "FILE.json: work, bytes, times and missing points");
    // For tests of the proof itself: an empty group keeps it out of the help.
    app.add_option("--remove-one-light", verify.remove_one_light)->group("");
}

} // namespace

const char* view_name(ViewKind view) { return kViewNames[static_cast<std::size_t>(view)]; }

Command parse_command_line(const std::vector<std::string>& arguments) {
    CLI::App app("Light a scene with very many lights, and lose none of them.", "manylights");
    app.set_version_flag("--version",
                         fmt::format("manylights {}.{}", MANYLIGHTS_VERSION_MAJOR, MANYLIGHTS_VERSION_MINOR));
    app.require_subcommand(1);
    app.option_defaults()->take_last(); // so that a script's settings can be overridden

    RenderArguments render;
    VerifyArguments verify;
    Typed render_typed, verify_typed, list_typed;
    render_typed.size = "960x540";
    verify_typed.size = "256x144";
    std::string technique = "hybrid_light_trees";
    CLI::App* render_app = app.add_subcommand("render", "draw a picture of a scene, or of the work it took");
    CLI::App* verify_app =
        app.add_subcommand("verify", "prove that no technique loses a light, against brute force or an oracle");
    CLI::App* bench_app =
        app.add_subcommand("bench", "measure a suite of cases: work counts, bytes, times that compare");
    CLI::App* list_app = app.add_subcommand("list", "what there is: scenes, techniques, suites or devices");
    add_render(*render_app, render, render_typed, technique);
    add_verify(*verify_app, verify, verify_typed);
    BenchOptions bench;
    add_bench(*bench_app, bench);
    list_app->add_option("what", list_typed.list, "scenes, techniques, suites or devices")->required();

    try {
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend())); // CLI11 takes them last first
    } catch (const CLI::CallForHelp&) {
        return Information{app.help()};
    } catch (const CLI::CallForVersion& version) {
        return Information{std::string(version.what()) + "\n"};
    } catch (const CLI::ParseError& error) {
        throw InputError(usage_error(error, app));
    }
    if (render_app->parsed()) return finish_render(render, render_typed, technique);
    if (verify_app->parsed()) return finish_verify(verify, verify_typed);
    if (bench_app->parsed()) return finish_bench(bench);
    return ListArguments{static_cast<ListKind>(choice("list", list_typed.list, kListNames))};
}

} // namespace manylights::lab::app
