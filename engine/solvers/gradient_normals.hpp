#pragma once

#include <engine/solvers/found_contacts.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::solvers {

/// Gradient normals of contacts: the gradient of B's signed field, as in section 2.2.4 of the
/// paper. The positions of the contacts are known only once they are found, so the field around
/// them is a query of its own. Reuses its memory between queries.
class GradientNormals {
public:
    /// The fields at the contacts found, without a shape A, for the technique to answer. `cell`: of
    /// the contacts. Valid until the next call.
    [[nodiscard]] std::span<const AnyQuery> fields_around(const FoundContacts& found,
                                                          const ContactQuery& asked,
                                                          Technique technique, double cell);
    /// Sets the normals of the contacts to the gradients of these fields. Returns the error of a
    /// field; then it sets nothing.
    [[nodiscard]] Status set(std::span<const AnyResult> fields, FoundContacts& found);

private:
    /// The square of the plane that contains a contact.
    struct Place {
        double column = 0.0;
        double row = 0.0;
        std::uint32_t contact = 0;
    };

    void sort_into_squares(double cell);

    std::vector<Vector2> points_;  // by contact
    std::vector<Place> places_;    // square by square
    std::vector<Vector2> sorted_points_;
    std::vector<Vector2> gradients_;  // by contact
    std::vector<AnyQuery> queries_;
};

}  // namespace nearfield::solvers
