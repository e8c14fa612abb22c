#pragma once

#include <engine/batch/batch_runner.hpp>
#include <engine/readback/contacts.hpp>
#include <engine/records/gradient_normals.hpp>

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
    void set_normals(const plan::PlannedQuery& planned, ContactResult& result, Timings& timings);

    BatchRunner runner_;
    readback::ContactDecoder decoder_;
    records::FoundContacts contacts_;
    records::GradientNormals normals_;
};

}  // namespace nearfield::batch
