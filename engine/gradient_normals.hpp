#pragma once

#include <engine/batch_runner.hpp>
#include <engine/contacts.hpp>

#include <cstdint>
#include <vector>

namespace nearfield {

/// Contacts whose normals are the gradient of B's signed field, as the paper has them (section
/// 2.2.4): where the contacts are is known only after they were rendered, so the field around each
/// is a batch of its own, submitted and waited for when the contacts are collected.
class GradientNormals {
public:
    GradientNormals(Planning& planning, Renderer* renderer);

    /// Writes the contacts of those queries of a collected batch that ask for it.
    void apply(BatchRunner& main);

private:
    void set_normals(const plan::PlannedQuery& planned, ContactResult& result, Timings& timings);

    /// Which square of the plane a contact lies in.
    struct Place {
        double column = 0.0;
        double row = 0.0;
        std::uint32_t contact = 0;
    };

    void sort_into_squares(double cell);
    void add_fields(const ContactQuery& asked, double cell);

    BatchRunner runner_;
    ContactDecoder decoder_;
    FoundContacts contacts_;
    std::vector<Vector2> points_;  // by contact
    std::vector<Place> places_;    // square by square
    std::vector<Vector2> sorted_points_;
    std::vector<Vector2> gradients_;  // by contact
    std::vector<AnyQuery> queries_;
};

}  // namespace nearfield
