#pragma once
// Says on standard error what long work is at, where that is a terminal: a single line that goes away again.

#include <string_view>

namespace manylights::lab::app {

class Progress {
  public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void at(std::string_view what);
    void clear();

  private:
    bool terminal_;
};

} // namespace manylights::lab::app
