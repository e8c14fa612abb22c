#pragma once

#include <nearfield/query.hpp>

#include <tools/io/world_request.hpp>

#include <string>

namespace nearfield::tools {

/// The technique that answers a query of all instances: `cpu`, unless it requests `compute`.
[[nodiscard]] Technique answering_technique(const WorldRequest& request);

/// Why the technique that a query requests does not answer it; empty if it does.
[[nodiscard]] std::string technique_problem(const WorldRequest& request);

}  // namespace nearfield::tools
