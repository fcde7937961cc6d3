#pragma once
// What a suite has measured so far, a line of JSON per case, written as soon as the case is done: a run that is stopped
// at any moment goes on where it was.
//
//     {"suite": ..., "version": ..., "device": ..., ...}      what all rows have in common
//     {"case": case_id, "rows": [...], "failures": [...]}     one per case
//
// A last line without its end is a case that was being written when the run was stopped; it is measured again.

#include "lab/suites/row.h"

#include <map>

namespace manylights::lab::suites {

struct CaseResult {
    std::vector<Row> rows;
    std::vector<std::string> failures; ///< a line for each technique whose light sets are wrong
};

class Journal {
  public:
    /// resume: goes on with the file where there is one. Throws InputError where it cannot be written, where its first
    /// line is not this header (rows of different devices or versions are not mixed), or where it is damaged.
    Journal(std::string path, const Row& header, bool resume);

    /// Null where the case has not been measured.
    const CaseResult* find(const std::string& id) const;
    /// Throws InputError where the line cannot be written.
    void add(const std::string& id, const CaseResult& result);

  private:
    void read(const Row& header);
    void read_line(const std::string& line, std::size_t number);
    void append(const Row& line);
    [[noreturn]] void refuse(const std::string& why) const;

    std::string path_;
    std::map<std::string, CaseResult> results_;
};

} // namespace manylights::lab::suites
