#include <engine/base/interruption.hpp>
#include <engine/solvers/solvers.hpp>

#include <variant>

namespace nearfield::solvers {

void Solvers::begin_batch(queries::MemoryBudget& memory) {
    workspace_.instances.begin_batch();
    workspace_.simplified.clear();
    workspace_.memory = &memory;
    static_cast<PenetrationSolver&>(solvers_).begin_batch();
}

void Solvers::answer(const queries::CheckedQuery& query, AnyResult& any) {
    std::visit(
        [&](auto& result) {
            checkpoint();
            solvers_.answer(query, workspace_, result);
            finish_answers(1);
        },
        any);
}

}  // namespace nearfield::solvers
