#pragma once
// The options of `bench`, as they are typed and as they are meant.

#include "lab/app/arguments.h"

namespace CLI {
class App;
}

namespace manylights::lab::app {

struct BenchOptions {
    BenchArguments arguments;
    std::string size, repeat, detail = "full"; ///< as typed; empty: the suite's own
    std::vector<std::string> lights, techniques;
};

void add_bench(CLI::App& app, BenchOptions& bench);
/// Throws InputError.
BenchArguments finish_bench(const BenchOptions& bench);

} // namespace manylights::lab::app
