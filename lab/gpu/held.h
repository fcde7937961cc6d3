#pragma once
// Ownership of Vulkan objects that ends with the device's work: once the device has given up on a submission it may
// still be reading and writing them, so from then on they are left to the end of the process.

#include "lab/gpu/context.h"

#include <memory>
#include <utility>

namespace manylights::lab::gpu {

/// State has a member std::shared_ptr<Context> context.
template <typename State>
std::shared_ptr<State> make_held(State&& state) {
    return std::shared_ptr<State>(new State(std::move(state)), [](State* held) {
        if (!held->context->hung) delete held;
    });
}

} // namespace manylights::lab::gpu
