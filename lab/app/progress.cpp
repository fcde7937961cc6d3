#include "lab/app/progress.h"

#include <cstdio>

#if defined(_WIN32)
#include <io.h>
#else
#include <unistd.h>
#endif

namespace manylights::lab::app {
namespace {

bool error_stream_is_terminal() {
#if defined(_WIN32)
    return _isatty(_fileno(stderr)) != 0;
#else
    return isatty(fileno(stderr)) != 0;
#endif
}

} // namespace

Progress::Progress() : terminal_(error_stream_is_terminal()) {}

Progress::~Progress() { clear(); }

void Progress::clear() {
    if (terminal_) std::fputs("\r\033[K", stderr); // back to the line's start, and empty it
}

void Progress::at(std::string_view what) {
    if (!terminal_) return;
    clear();
    std::fprintf(stderr, "%.*s ...", static_cast<int>(what.size()), what.data());
    std::fflush(stderr);
}

} // namespace manylights::lab::app
