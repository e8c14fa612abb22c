#pragma once

#include <engine/batch_runner.hpp>
#include <engine/contacts.hpp>

#include <vector>

namespace nearfield {

/// Contacts whose normals are the gradient of B's signed field, as the paper has them (section
/// 2.2.4): where the contacts are is known only after they were rendered, so the field around each
/// is a batch of its own.
class GradientNormals {
public:
    GradientNormals(const plan::PlanLimits& limits, const char* gradient_format,
                    Renderer& renderer);

    /// Writes the contacts of those queries of the batch that `main` ran that ask for it.
    void apply(const BatchRunner& main, const plan::FindShape& find_shape, Results& results);

private:
    void set_normals(const plan::PlannedQuery& planned, const plan::FindShape& find_shape,
                     ContactResult& result, Timings& timings);

    BatchRunner runner_;
    ContactDecoder contacts_;
    std::vector<Vector2> points_;
    std::vector<AnyQuery> queries_;
    Results fields_;
};

}  // namespace nearfield
