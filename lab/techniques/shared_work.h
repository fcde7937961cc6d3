#pragma once
// Work on the host's processors.

#include <cstddef>
#include <functional>

namespace manylights::lab {

/// Calls work(0) to work(count - 1), each once and in any order, on this many threads (0: one per processor). Returns
/// when all are done; what a call throws is thrown here.
void share_work(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& work);

} // namespace manylights::lab
