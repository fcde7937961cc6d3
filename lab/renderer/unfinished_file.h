#pragma once
// A file is written under another name in the same folder and renamed when it is complete, so that nothing half-written
// is ever found under its name. All throw InputError naming the path and why.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace manylights::lab {

[[noreturn]] void cannot_write(const std::string& path, const std::string& why);

/// Throws the InputError that writing this file would end in because of its folder, before any long work is done for
/// it.
void check_writable(const std::string& path);

/// A file under a name of its own beside the wanted one; gone again unless kept.
class UnfinishedFile {
  public:
    explicit UnfinishedFile(std::string path);
    UnfinishedFile(const UnfinishedFile&) = delete;
    UnfinishedFile& operator=(const UnfinishedFile&) = delete;
    ~UnfinishedFile();

    /// Where to write, for libraries that open files themselves.
    const std::string& name() const { return name_; }

    void write(const std::vector<std::uint8_t>& bytes);
    void keep();

  private:
    std::string path_, name_;
    bool kept_ = false;
};

/// The whole file at once.
void write_text(const std::string& path, std::string_view text);

} // namespace manylights::lab
