#pragma once
// How long the rest of some long work will take, from how long its parts took so far.

#include <chrono>
#include <string>

namespace manylights::lab::app {

class RemainingTime {
  public:
    void expect(double weight) { expected_ += weight; } ///< a part of the work, before it begins
    void done(double weight) { done_ += weight; }       ///< that part

    /// "4 min", "20 s", or "?" before the first part is done.
    std::string text() const { return text(std::chrono::duration<double>(Clock::now() - start_).count()); }
    std::string text(double seconds_so_far) const;

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
    double expected_ = 0.0, done_ = 0.0;
};

} // namespace manylights::lab::app
