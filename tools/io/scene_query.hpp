#pragma once

#include <tools/io/json_document.hpp>
#include <tools/io/query_request.hpp>

namespace nearfield::tools {

/// Reads what a query of a scene between instances asks for: everything but its instances. Throws
/// InputError with the place, UnknownMember for a member that queries of its kind do not have.
[[nodiscard]] QueryRequest read_query_request(const JsonPlace& place);

}  // namespace nearfield::tools
