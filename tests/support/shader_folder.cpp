#include <tests/support/shader_folder.hpp>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace nearfield::test_support {
namespace {

namespace fs = std::filesystem;

const fs::path original = NEARFIELD_SHADERS;

fs::path new_folder() {
    std::string name = (fs::temp_directory_path() / "nearfield-shaders-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
        throw fs::filesystem_error("no folder for shaders", name,
                                   std::error_code(errno, std::generic_category()));
    }
    return name;
}

}  // namespace

ShaderFolder::ShaderFolder() : path_(new_folder()) {
    for (const auto& entry : fs::directory_iterator(original)) {
        fs::copy_file(entry.path(), path_ / entry.path().filename());
    }
}

ShaderFolder::~ShaderFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

void ShaderFolder::replace(const std::string& file, const std::string& text,
                           const std::string& by) const {
    std::ostringstream content;
    content << std::ifstream(path_ / file).rdbuf();
    std::string changed = content.str();
    const std::size_t place = changed.find(text);
    if (place == std::string::npos) {
        throw std::logic_error(file + " has no place with: " + text);
    }
    changed.replace(place, text.size(), by);
    std::ofstream(path_ / file) << changed;
}

void ShaderFolder::restore(const std::string& file) const {
    fs::copy_file(original / file, path_ / file, fs::copy_options::overwrite_existing);
}

}  // namespace nearfield::test_support
