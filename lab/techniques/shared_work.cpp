#include "lab/techniques/shared_work.h"

#include <algorithm>
#include <atomic>
#include <future>
#include <thread>
#include <vector>

namespace manylights::lab {

void share_work(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& work) {
    if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency()); // 0 there: not known
    std::atomic<std::size_t> next = 0;
    const auto take_turns = [&] {
        for (std::size_t i = next++; i < count; i = next++) work(i);
    };
    std::vector<std::future<void>> helpers; // each waits for its thread when it goes, also where this one throws
    for (unsigned i = 1; i < threads; ++i) helpers.push_back(std::async(std::launch::async, take_turns));
    take_turns();
    for (std::future<void>& helper : helpers) helper.get();
}

} // namespace manylights::lab
