#pragma once
// What a suite has measured so far, a line of JSON per step, written as soon as the step is done: a run that is stopped
// at any moment goes on where it was.
//
//     {"suite": ..., "version": ..., "device": ..., ...}      what all rows have in common
//     {"case": Step::id, "rows": [...], "failures": [...]}     one per step
//
// A last line without its end is a step that was being written when the run was stopped; it is measured again.

#include "lab/suites/schema.h"
#include "lab/suites/step.h"

#include <map>

namespace manylights::lab::suites {

class Journal {
  public:
    /// resume: goes on with the file where there is one. Throws InputError where it cannot be written, where its first
    /// line is not this header (rows of different devices or versions are not mixed), or where it is damaged.
    Journal(std::string path, const Row& header, std::span<const Column> columns, bool resume);

    /// Null where the step has not been measured.
    const StepResult* find(const std::string& id) const;
    /// Throws InputError where the line cannot be written.
    void add(const std::string& id, const StepResult& result);

  private:
    void read(const Row& header);
    void read_line(const std::string& line, std::size_t number);
    void append(const Row& line);
    [[noreturn]] void refuse(const std::string& why) const;

    std::string path_;
    std::span<const Column> columns_;
    std::map<std::string, StepResult> results_;
};

} // namespace manylights::lab::suites
