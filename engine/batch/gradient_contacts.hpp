#pragma once

#include <engine/batch/batch_runner.hpp>
#include <engine/batch/contacts.hpp>
#include <engine/solvers/gradient_normals.hpp>

namespace nearfield::batch {

/// Completes contacts that a device has found and that have gradient normals: the fields around
/// them are a batch of their own, submitted and waited for when the contacts are collected.
class GradientContacts {
public:
    GradientContacts(Planning& planning, render::Renderer* renderer)
        : runner_(planning, renderer) {}

    /// Completes the contacts of a collected batch.
    void complete(BatchRunner& main);
    /// As BatchRunner::trim().
    void trim() noexcept { runner_.trim(); }

private:
    void set_normals(const device_input::PlannedQuery& planned, ContactResult& result,
                     Timings& timings);

    BatchRunner runner_;
    ContactDecoder decoder_;
    solvers::FoundContacts contacts_;
    solvers::GradientNormals normals_;
};

}  // namespace nearfield::batch
