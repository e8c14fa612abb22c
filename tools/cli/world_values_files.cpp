#include <tools/cli/world_values_files.hpp>
#include <tools/io/number_table.hpp>
#include <tools/io/world_answer.hpp>
#include <tools/io/world_values.hpp>

#include <vector>

namespace nearfield::tools {

WorldValuesFiles::WorldValuesFiles(const Scene& scene, const std::optional<std::string>& json) {
    std::vector<std::string> outputs;
    if (json && *json != "-") {
        outputs.push_back(*json);
    }
    std::vector<std::string> values;
    for (const SceneQuery& query : scene.queries) {
        if (query.problem.empty() && query.world && !query.world->values.empty()) {
            values.push_back(query.world->values);
        }
    }
    outputs.insert(outputs.end(), values.begin(), values.end());
    require_different_files(scene.files, outputs);
    for (const std::string& path : values) {
        files_.try_emplace(path, path);
    }
}

void WorldValuesFiles::write(std::span<const SceneAnswer> answers) {
    for (const SceneAnswer& answer : answers) {
        if (answer.world == nullptr || answer.world->request->values.empty()) {
            continue;
        }
        File& file = files_.at(answer.world->request->values);
        if (is_npy(answer.world->request->values)) {
            write_world_npy(file.output.stream(), *answer.world);
        } else {
            write_world_csv(file.output.stream(), *answer.world);
        }
        file.is_written = true;
    }
}

void WorldValuesFiles::commit() {
    for (auto& [path, file] : files_) {
        if (file.is_written) {
            file.output.commit();
        }
    }
}

}  // namespace nearfield::tools
