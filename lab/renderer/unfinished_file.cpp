#include "lab/renderer/unfinished_file.h"

#include "lab/scene/error.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace manylights::lab {

namespace fs = std::filesystem;

void cannot_write(const std::string& path, const std::string& why) {
    throw InputError("cannot write " + path + ": " + why);
}

void check_writable(const std::string& path) {
    std::error_code error;
    const fs::path file(path);
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    const fs::file_status status = fs::status(folder, error);
    if (!fs::exists(status)) cannot_write(path, "the folder " + folder.string() + " does not exist");
    if (!fs::is_directory(status)) cannot_write(path, folder.string() + " is not a folder");
    if (fs::is_directory(file, error)) cannot_write(path, "it is a folder");
    // Permissions do not tell everything: a file system may refuse files of any user.
    const std::string probe = path + ".probe-" + std::to_string(getpid());
    std::FILE* opened = std::fopen(probe.c_str(), "wb");
    if (opened == nullptr)
        cannot_write(path, "the folder " + folder.string() + " is not writable: " + std::strerror(errno));
    std::fclose(opened);
    fs::remove(probe, error);
}

UnfinishedFile::UnfinishedFile(std::string path)
    : path_(std::move(path)), name_(path_ + ".unfinished-" + std::to_string(getpid())) {
    check_writable(path_);
}

UnfinishedFile::~UnfinishedFile() {
    std::error_code ignored;
    if (!kept_) fs::remove(name_, ignored);
}

void UnfinishedFile::write(const std::vector<std::uint8_t>& bytes) {
    std::FILE* file = std::fopen(name_.c_str(), "wb");
    if (file == nullptr) cannot_write(path_, std::strerror(errno));
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    const int write_error = errno;
    const bool closed = std::fclose(file) == 0; // a full disk may be noticed only here
    if (!written || !closed) cannot_write(path_, std::strerror(written ? errno : write_error));
}

void UnfinishedFile::keep() {
    std::error_code error;
    fs::rename(name_, path_, error);
    if (error) cannot_write(path_, error.message());
    kept_ = true;
}

void write_text(const std::string& path, std::string_view text) {
    UnfinishedFile file(path);
    file.write({text.begin(), text.end()});
    file.keep();
}

} // namespace manylights::lab
