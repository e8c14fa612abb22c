#pragma once

#include <tools/io/json_document.hpp>
#include <tools/io/query_request.hpp>

#include <functional>
#include <string>
#include <vector>

namespace nearfield::tools {

/// A member of a query besides its shapes and its tolerance: how scenes and the command line name
/// it, and how each sets it. Both throw InputError.
struct QueryMember {
    std::string key;   ///< in a scene; the option of the command line has dashes
    std::string form;  ///< of its value, in the help
    std::string help;
    /// Sets it from the text of an option; empty if only scenes have the member.
    std::function<void(QueryRequest&, const std::string& text, const std::string& option)> parse;
    std::function<void(QueryRequest&, const JsonPlace&)> read;
};

/// What the answer of a kind holds, in the order of the help.
[[nodiscard]] std::vector<QueryMember> answer_members(QueryType type);
/// How it is found. Scenes have `strategy` only in the kinds that are sampled.
[[nodiscard]] std::vector<QueryMember> technique_members(QueryType type);

/// Reads what a query of a scene between instances asks for: everything but its instances. Throws
/// InputError with the place, UnknownMember for a member that queries of its kind do not have.
[[nodiscard]] QueryRequest read_query_request(const JsonPlace& place);

}  // namespace nearfield::tools
