#pragma once

#include <tools/io/world_answer.hpp>

#include <ostream>
#include <string>
#include <vector>

namespace nearfield::tools {

/// The columns of a file with the records of an answer. Where there are lists, the first is the
/// number of the pose, point, segment or rectangle.
[[nodiscard]] std::vector<std::string> world_columns(const WorldAnswer& answer);

/// Writes the records as CSV with a line of names. Cells of what there is not are empty.
void write_world_csv(std::ostream& stream, const WorldAnswer& answer);

/// Writes the records in NumPy's format: float64, shape (records, columns). Instances are indices
/// into Scene::instances and states those of ImpactState; what there is not is -1, points NaN.
void write_world_npy(std::ostream& stream, const WorldAnswer& answer);

}  // namespace nearfield::tools
