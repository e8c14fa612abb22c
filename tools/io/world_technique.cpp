#include <tools/io/world_technique.hpp>

namespace nearfield::tools {
namespace {

/// What messages call a query that the device does not answer; empty for others.
std::string unanswered_by_device(const WorldRequest& request) {
    std::string name(name_of(request.type));
    switch (request.type) {
        case WorldQueryType::poses:
            return request.clearance ? name + " with \"answer\": \"clearance\"" : "";
        case WorldQueryType::nearest:
            if (request.shape) {
                return name + " of a shape";
            }
            return request.count > 1 ? name + " with a \"count\" above 1" : "";
        case WorldQueryType::rays:
            return request.all_hits ? name + " with \"hits\": \"all\"" : "";
        case WorldQueryType::cast:
        case WorldQueryType::overlap:
            break;
    }
    return name;
}

}  // namespace

Technique answering_technique(const WorldRequest& request) {
    return request.technique == Technique::compute ? Technique::compute : Technique::cpu;
}

std::string technique_problem(const WorldRequest& request) {
    if (request.technique == Technique::raster) {
        return "the technique raster does not answer " + std::string(name_of(request.type)) +
               ", nor any other query of all instances; ask for another, or for automatic";
    }
    const std::string what =
        request.technique == Technique::compute ? unanswered_by_device(request) : "";
    return what.empty() ? ""
                        : "the technique compute does not answer " + what +
                              "; of all instances it answers poses with \"answer\": \"hits\", "
                              "nearest of points with \"count\": 1, and rays with \"hits\": "
                              "\"first\"; ask for cpu, or for automatic";
}

}  // namespace nearfield::tools
