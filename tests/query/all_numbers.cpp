#include <tests/query/all_numbers.hpp>
#include <tests/support/numbers.hpp>

#include <type_traits>
#include <variant>

namespace nearfield::test {

std::vector<double> all_numbers(const Results& results) {
    Numbers numbers;
    for (const AnyResult& any : results.results) {
        std::visit(
            [&numbers](const auto& result) {
                const ResultSummary& s = result;
                numbers.add(s.status.code(), s.tolerance, s.error_bound, s.intersects, s.cell,
                            s.regions, s.localization.nodes_evaluated,
                            s.localization.pairs_rejected, s.localization.edges_kept, s.technique);
                if constexpr (requires { result.gradients; }) {
                    numbers.add_field(result);
                } else {
                    numbers.add_answer(result);
                }
            },
            any);
    }
    return numbers.list();
}

}  // namespace nearfield::test
