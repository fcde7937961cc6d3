// The command `manylights`. Whatever goes wrong is one line on standard error and an exit code.

#include "lab/app/commands.h"
#include "lab/scene/error.h"

#include <fmt/format.h>

#include <new>

namespace {

using namespace manylights::lab;

int run(const app::Command& command) {
    if (const auto* render = std::get_if<app::RenderArguments>(&command)) return app::run_render(*render);
    if (const auto* verify = std::get_if<app::VerifyArguments>(&command)) return app::run_verify(*verify);
    if (const auto* bench = std::get_if<app::BenchArguments>(&command)) return app::run_bench(*bench);
    if (const auto* list = std::get_if<app::ListArguments>(&command)) return app::run_list(*list);
    fmt::print("{}", std::get<app::Information>(command).text);
    return app::kDone;
}

int complain(const char* what, int code) {
    fmt::print(stderr, "manylights: {}\n", what);
    return code;
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run(app::parse_command_line(std::vector<std::string>(argv + 1, argv + argc)));
    } catch (const InputError& error) {
        return complain(error.what(), app::kBadInput);
    } catch (const DeviceError& error) {
        return complain(error.what(), app::kNoDevice);
    } catch (const std::bad_alloc&) {
        return complain("out of memory: the machine has less than this scene, size and light count need",
                        app::kNoDevice);
    } catch (const std::exception& error) {
        return complain(fmt::format("unexpected: {}", error.what()).c_str(), app::kNoDevice);
    }
}
