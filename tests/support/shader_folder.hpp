#pragma once

#include <tests/support/folder.hpp>

#include <filesystem>
#include <string>

namespace nearfield::test_support {

/// A copy of the library's shaders for modification; removed at the end.
class ShaderFolder {
public:
    ShaderFolder();

    [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }

    /// Replaces the first occurrence of a text in a file. Throws std::logic_error if there is none.
    void replace(const std::string& file, const std::string& text, const std::string& by) const;
    /// Restores the library's version of the file.
    void restore(const std::string& file) const;

private:
    Folder folder_;
};

}  // namespace nearfield::test_support
