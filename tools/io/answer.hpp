#pragma once

#include <nearfield/result.hpp>
#include <nearfield/tile.hpp>

#include <tools/io/query_request.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// One query with its answer and everything to report about it. Refers to objects that the caller
/// keeps.
struct Answer {
    const QueryRequest& request;
    const AnyResult& result;
    const Timings& timings;
    const std::string& device;
    const std::vector<TileReport>* tiles = nullptr;  ///< if requested
};

/// One query of a scene and its answer. Refers to objects that the caller keeps.
struct SceneAnswer {
    const QueryRequest& request;
    const std::string& a;  ///< names of the instances
    const std::string& b;
    const AnyResult& result;
};

/// A context's device as text for people. `name`: Context::device_name().
[[nodiscard]] inline const std::string& device_text(const std::string& name) {
    static const std::string none = "none";
    return name.empty() ? none : name;
}

/// The part common to all kinds of result.
[[nodiscard]] inline const ResultSummary& summary_of(const AnyResult& result) {
    return std::visit([](const auto& any) -> const ResultSummary& { return any; }, result);
}

}  // namespace nearfield::tools
