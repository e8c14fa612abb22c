#pragma once

#include <nearfield/context.hpp>

namespace nearfield::bench {

/// Measures families of shapes whose edges boxes do not tell apart, by every technique, and prints
/// a table in Markdown: processor time for each size, and the factor from each size to its double.
/// Throws std::runtime_error if a query fails.
void print_awkward_families(Context& context);

}  // namespace nearfield::bench
