#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace nearfield::test_support {

/// A fresh folder with a space in its name, removed with all that is in it.
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

    /// Every file's name and bytes: what a refused command must leave as they were.
    [[nodiscard]] std::map<std::string, std::string> contents() const;

private:
    std::filesystem::path path_;
};

}  // namespace nearfield::test_support
