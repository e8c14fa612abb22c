#include <engine/base/status_exception.hpp>
#include <engine/reload/compiler.hpp>
#include <engine/reload/shader_reload.hpp>

#include <shaders/sources.hpp>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace nearfield::reload {
namespace {

namespace fs = std::filesystem;

StatusException unusable(const std::string& message, std::vector<std::string> reasons = {}) {
    return StatusException({StatusCode::invalid_shader,
                            message + "; the shaders in use stay in use", std::move(reasons)});
}

std::string text_of(const fs::path& file) {
    const std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream) {
        throw unusable("the shader source '" + file.string() + "' cannot be read");
    }
    return text.str();
}

/// The name in a line `#include "NAME"`; empty in any other.
std::string included_in(const std::string& line) {
    constexpr std::string_view directive = "#include";
    const std::size_t begin = line.find('"');
    const std::size_t end = line.rfind('"');
    const bool includes = line.starts_with(directive) && begin < end;
    return includes ? line.substr(begin + 1, end - begin - 1) : std::string();
}

/// Adds the text of a file and of everything that it includes, recursively.
void add_text(const fs::path& folder, const fs::path& file, std::set<fs::path>& added,
              std::string& text) {
    if (!added.insert(file).second) {
        return;
    }
    const std::string own = text_of(file);
    text += own;
    std::istringstream lines(own);
    for (std::string line; std::getline(lines, line);) {
        if (const std::string name = included_in(line); !name.empty()) {
            const bool is_here = fs::exists(folder / name);
            add_text(folder, (is_here ? folder : fs::path(shaders::include_folder)) / name, added,
                     text);
        }
    }
}

bool same(gpu::ShaderWords::Words a, gpu::ShaderWords::Words b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

std::uint32_t ShaderReload::compile_changed(const char* folder) {
    const fs::path sources = folder != nullptr ? folder : shaders::source_folder;
    Texts texts;
    for (const shaders::Source& source : shaders::sources) {
        std::set<fs::path> added;
        add_text(sources, sources / source.file, added, texts[source.file]);
    }
    const std::uint32_t changed = compile(sources, texts);
    former_texts_ = std::exchange(compiled_, std::move(texts));
    return changed;
}

std::uint32_t ShaderReload::compile(const fs::path& folder, const Texts& texts) {
    gpu::ShaderWords words = device_->shader_words();
    std::uint32_t changed = 0;
    for (const shaders::Source& source : shaders::sources) {
        const auto former = compiled_.find(source.file);
        if (former != compiled_.end() && former->second == texts.at(source.file)) {
            continue;
        }
        Compilation compilation = reload::compile(folder, source.file);
        if (compilation.words.empty()) {
            const std::string what =
                "shader '" + (folder / source.file).string() + "' does not compile";
            for (const std::string& line : compilation.complaints) {
                device_->log(LogLevel::error, [&] { return what + ": " + line; });
            }
            throw unusable(what, std::move(compilation.complaints));
        }
        if (!same(compilation.words, words.in_use(source.built))) {
            words.use(source.built, std::move(compilation.words));
            ++changed;
            device_->log(LogLevel::information, [&] {
                return std::string("shader '") + source.file + "' is another one now";
            });
        }
    }
    former_words_ = std::exchange(device_->shader_words(), std::move(words));
    return changed;
}

void ShaderReload::take_back() {
    device_->shader_words() = std::move(former_words_);
    compiled_ = std::move(former_texts_);
}

}  // namespace nearfield::reload
