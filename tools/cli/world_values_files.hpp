#pragma once

#include <tools/io/answer.hpp>
#include <tools/io/output_file.hpp>
#include <tools/io/scene.hpp>

#include <map>
#include <optional>
#include <span>
#include <string>

namespace nearfield::tools {

/// The files into which a scene has the records of its queries written.
class WorldValuesFiles {
public:
    /// `json`: the file of the answers; "-" is the standard output. Throws InputError for a file
    /// that cannot be written, or that would replace an input or another output.
    WorldValuesFiles(const Scene& scene, const std::optional<std::string>& json);

    /// Writes the records of the answers that there are. Other files are left as they are.
    void write(std::span<const SceneAnswer> answers);

    /// Throws std::runtime_error if writing failed.
    void commit();

private:
    struct File {
        explicit File(const std::string& path) : output(path) {}
        OutputFile output;
        bool is_written = false;
    };
    std::map<std::string, File> files_;  ///< by path
};

}  // namespace nearfield::tools
