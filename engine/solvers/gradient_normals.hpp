#pragma once

#include <engine/queries/checked_query.hpp>
#include <engine/solvers/field.hpp>
#include <engine/solvers/found_contacts.hpp>
#include <engine/solvers/workspace.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::solvers {

/// Gradient normals of contacts: the gradient of B's signed field, as in section 2.2.4 of the
/// paper. The positions of the contacts are known only once they are found, so the field around
/// them is a query of its own, which the CPU answers. Reuses its memory between queries.
class GradientNormals {
public:
    /// Sets the normals of the contacts that a query has found. `cell`: of the contacts. Returns
    /// the error of a field; then it sets nothing.
    [[nodiscard]] Status set(const queries::CheckedQuery& query, double cell, Workspace& workspace,
                             FoundContacts& found);

private:
    /// The square of the plane that contains a contact.
    struct Place {
        double column = 0.0;
        double row = 0.0;
        std::uint32_t contact = 0;
    };

    void sort_into_squares(double cell);
    /// The field at these points, whose gradients are those of the contacts from `first` on.
    [[nodiscard]] Status take_field(const queries::CheckedQuery& query,
                                    std::span<const Vector2> points, double cell,
                                    Workspace& workspace, std::size_t first);

    std::vector<Vector2> points_;  // by contact
    std::vector<Place> places_;    // square by square
    std::vector<Vector2> sorted_points_;
    std::vector<Vector2> gradients_;  // by contact
    FieldSolver solver_;
    AnyQuery field_;
    AnyResult result_;
};

}  // namespace nearfield::solvers
