#pragma once

#include <tests/support/folder.hpp>

#include <filesystem>
#include <string>

namespace nearfield::test_support {

/// A copy of the library's shaders, to change; gone in the end.
class ShaderFolder {
public:
    ShaderFolder();

    [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }

    /// Replaces the first place of a file with that text. Throws std::logic_error where there is
    /// none.
    void replace(const std::string& file, const std::string& text, const std::string& by) const;
    /// The file as the library has it.
    void restore(const std::string& file) const;

private:
    Folder folder_;
};

}  // namespace nearfield::test_support
