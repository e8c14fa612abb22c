#include <sys/stat.h>
#include <tools/io/input_error.hpp>
#include <tools/io/output_file.hpp>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <system_error>

namespace nearfield::tools {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
    throw InputError(path + ": cannot be written: " + reason);
}

/// The permissions of a new file according to the user's umask.
mode_t default_mode() {
    const mode_t mask = umask(0);
    umask(mask);
    return static_cast<mode_t>(0666) & ~mask;
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path) {
    std::error_code error;
    target_ = std::filesystem::weakly_canonical(path, error);
    if (error || path.empty()) {
        refuse(path, path.empty() ? "an empty name" : error.message());
    }
    const std::filesystem::file_status status = std::filesystem::status(target_, error);
    if (std::filesystem::is_directory(status)) {
        refuse(path, "is a folder");
    }
    if (std::filesystem::exists(status)) {
        if (access(target_.c_str(), W_OK) != 0) {
            refuse(path, std::strerror(errno));
        }
        if (!std::filesystem::is_regular_file(status)) {
            stream_.open(target_, std::ios::binary);
            if (!stream_) {
                refuse(path, "cannot be opened");
            }
            return;
        }
    }
    open_temporary();
}

void OutputFile::open_temporary() {
    std::string name = target_.string() + ".XXXXXX";
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) {
        refuse(path_, std::strerror(errno));
    }
    temporary_ = name;
    fchmod(descriptor, default_mode());
    close(descriptor);
    stream_.open(temporary_, std::ios::binary);
    if (!stream_) {
        refuse(path_, "the temporary file beside it cannot be opened");
    }
}

OutputFile::~OutputFile() {
    if (!temporary_.empty()) {
        stream_.close();
        std::error_code ignored;
        std::filesystem::remove(temporary_, ignored);
    }
}

void OutputFile::commit() {
    stream_.close();
    if (!stream_) {
        throw std::runtime_error(path_ + ": could not be written completely");
    }
    if (temporary_.empty()) {
        return;
    }
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) {
        throw std::runtime_error(path_ + ": could not be written: " + error.message());
    }
    temporary_.clear();
}

namespace {

/// The same for all names of a file, which need not be there yet.
std::filesystem::path only_name(const std::string& file) {
    std::error_code ignored;
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file, ignored), ignored);
}

}  // namespace

void require_different_files(const std::vector<std::string>& inputs,
                             const std::vector<std::string>& outputs) {
    std::vector<std::filesystem::path> taken;
    taken.reserve(inputs.size() + outputs.size());
    std::error_code ignored;
    for (const std::string& input : inputs) {
        taken.push_back(only_name(input));
    }
    for (const std::string& output : outputs) {
        const std::filesystem::path path = only_name(output);
        if (std::filesystem::exists(path, ignored) &&
            !std::filesystem::is_regular_file(path, ignored)) {
            continue;
        }
        if (std::find(taken.begin(), taken.end(), path) != taken.end()) {
            throw InputError(output + ": would be written over an input or another output");
        }
        taken.push_back(path);
    }
}

ReportTarget::ReportTarget(const std::optional<std::string>& json) : standard_output_(json == "-") {
    if (json && !standard_output_) {
        file_.emplace(*json);
    }
}

std::ostream* ReportTarget::json() noexcept {
    if (standard_output_) {
        return &std::cout;
    }
    return file_ ? &file_->stream() : nullptr;
}

std::ostream& ReportTarget::summary() noexcept {
    return standard_output_ ? std::cerr : std::cout;
}

void ReportTarget::commit() {
    if (file_) {
        file_->commit();
    }
}

}  // namespace nearfield::tools
