#pragma once

#include <engine/batch/batch_runner.hpp>
#include <engine/decode/contacts.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::batch {

/// Gradient normals of contacts: the gradient of B's signed field, as in section 2.2.4 of the
/// paper. The positions of the contacts are known only after rendering, so the field around each is
/// a batch of its own, submitted and waited for when the contacts are collected.
class GradientNormals {
public:
    GradientNormals(Planning& planning, render::Renderer* renderer);

    /// Completes the contacts of a collected batch's queries that ask for gradient normals.
    void apply(BatchRunner& main);
    /// As BatchRunner::trim().
    void trim() noexcept { runner_.trim(); }

private:
    void set_normals(const plan::PlannedQuery& planned, ContactResult& result, Timings& timings);

    /// The square of the plane that contains a contact.
    struct Place {
        double column = 0.0;
        double row = 0.0;
        std::uint32_t contact = 0;
    };

    void sort_into_squares(double cell);
    void add_fields(const ContactQuery& asked, double cell);

    BatchRunner runner_;
    decode::ContactDecoder decoder_;
    records::FoundContacts contacts_;
    std::vector<Vector2> points_;  // by contact
    std::vector<Place> places_;    // square by square
    std::vector<Vector2> sorted_points_;
    std::vector<Vector2> gradients_;  // by contact
    std::vector<AnyQuery> queries_;
};

}  // namespace nearfield::batch
