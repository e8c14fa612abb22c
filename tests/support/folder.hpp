#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace nearfield::test_support {

/// A new folder with a space in its name, removed with its contents.
class Folder {
public:
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// The full path of a file in the folder, which need not exist.
    [[nodiscard]] std::string path(const std::string& name) const;

    /// Writes a file and returns its full path.
    std::string write(const std::string& name, const std::string& bytes) const;

    /// The bytes of a file.
    [[nodiscard]] std::string read(const std::string& name) const;

    /// The name and contents of every file, to check that a rejected command left them unchanged.
    [[nodiscard]] std::map<std::string, std::string> contents() const;

private:
    std::filesystem::path path_;
};

}  // namespace nearfield::test_support
