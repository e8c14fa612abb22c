#include <tests/support/shader_folder.hpp>

#include <stdexcept>

namespace nearfield::test_support {
namespace {

namespace fs = std::filesystem;

const fs::path original = NEARFIELD_SHADERS;

}  // namespace

ShaderFolder::ShaderFolder() {
    for (const auto& entry : fs::directory_iterator(original)) {
        fs::copy_file(entry.path(), path() / entry.path().filename());
    }
}

void ShaderFolder::replace(const std::string& file, const std::string& text,
                           const std::string& by) const {
    std::string changed = folder_.read(file);
    const std::size_t place = changed.find(text);
    if (place == std::string::npos) {
        throw std::logic_error(file + " has no place with: " + text);
    }
    changed.replace(place, text.size(), by);
    folder_.write(file, changed);
}

void ShaderFolder::restore(const std::string& file) const {
    fs::copy_file(original / file, path() / file, fs::copy_options::overwrite_existing);
}

}  // namespace nearfield::test_support
