#pragma once
// The subcommands. Each prints its result on standard output and hands back the exit code; throws InputError or
// DeviceError before anything is written.

#include "lab/app/arguments.h"

namespace manylights::lab::app {

constexpr int kDone = 0, kCheckFailed = 1, kBadInput = 2, kNoDevice = 3;

int run_render(const RenderArguments& arguments);
int run_verify(const VerifyArguments& arguments);
int run_bench(const BenchArguments& arguments);
int run_list(const ListArguments& arguments);

} // namespace manylights::lab::app
