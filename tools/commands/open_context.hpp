#pragma once

#include <nearfield/context.hpp>

#include <tools/input/query_request.hpp>
#include <tools/input/scene.hpp>

namespace nearfield::tools {

/// The techniques that the queries of a command ask for.
class AskedTechniques {
public:
    void add(Technique technique) { bits_ |= bit(technique); }
    /// Queries that the CPU alone answers need no device, whatever they say.
    void add(const QueryRequest& request) {
        add(is_sampled(request.type) ? request.technique : Technique::cpu);
    }
    [[nodiscard]] bool has(Technique technique) const { return (bits_ & bit(technique)) != 0; }

private:
    [[nodiscard]] static unsigned bit(Technique technique) {
        return 1U << static_cast<unsigned>(technique);
    }

    unsigned bits_ = 0;
};

[[nodiscard]] AskedTechniques techniques_of(const Scene& scene);

/// A context with pipelines for what is asked, and without a device where none is needed. Where
/// Technique::automatic alone asks for a device and there is none that can be used, says so on the
/// standard error and leaves everything to the CPU. Throws LibraryError.
[[nodiscard]] Context open_context(Settings settings, const AskedTechniques& asked);

}  // namespace nearfield::tools
