#pragma once
// The command line: what each subcommand was asked to do. Texts that belong to a scene, a device or a technique are
// checked where those are at hand; everything else is checked here.

#include "lab/scene/lights.h"
#include "lab/scene/scene.h"
#include "lab/suites/suite.h"
#include "lab/techniques/technique.h"
#include "lab/techniques/truth.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace manylights::lab::app {

/// What is looked at and what computes it: common to render and verify.
struct Selectors {
    std::string scene = "canyon";
    Detail detail = Detail::full;
    LightOptions lights;
    bool scene_distribution = false; ///< the scene's own stands for that of lights
    OptionValues settings;           ///< of the technique, in the order given
    std::string camera;              ///< empty: the scene's first
    std::uint32_t width = 0, height = 0;
    bool size_given = false; ///< else the size is the command's own
    std::string points;      ///< file of saved points; may be empty, or not be there yet
    std::string device;      ///< empty: the best one
    bool validation = false;
};

enum class ViewKind { shaded, tested, affecting, nodes, references, structure };
const char* view_name(ViewKind view);

struct RenderArguments {
    Selectors selectors;
    std::vector<std::string> techniques; ///< several: panels side by side on one scale
    ViewKind view = ViewKind::shaded;
    std::optional<double> scale_max; ///< top of the false colours
    std::string out;
    std::string stats;  ///< may be empty
    std::string panels; ///< name with {} for a technique's own picture; may be empty
};

/// What techniques are held to; automatic: brute force where that does not take too long, else the grid.
enum class TruthKind { automatic, brute_force, grid };

struct VerifyArguments {
    Selectors selectors;
    std::vector<std::string> techniques; ///< never empty
    bool all_techniques = false;         ///< none was named: they are all there are
    TruthKind truth = TruthKind::automatic;
    std::string stats;            ///< may be empty
    std::string remove_one_light; ///< technique to damage on purpose, or kGridOracle; empty: none
};

struct BenchArguments {
    std::string suite;
    suites::SuiteOptions options;
    std::string out; ///< folder
    bool resume = false;
    std::string device; ///< empty: the best one
    bool validation = false;
    std::string remove_one_light; ///< as for verify
};

enum class ListKind { scenes, techniques, suites, devices };
struct ListArguments {
    ListKind what;
};

/// The help or the version was asked for: text for standard output.
struct Information {
    std::string text;
};

using Command = std::variant<RenderArguments, VerifyArguments, BenchArguments, ListArguments, Information>;

/// arguments without the program's name. Throws InputError: the option, what was given, and the rule.
Command parse_command_line(const std::vector<std::string>& arguments);

} // namespace manylights::lab::app
