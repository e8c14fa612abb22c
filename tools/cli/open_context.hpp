#pragma once

#include <nearfield/context.hpp>

#include <tools/io/query_request.hpp>
#include <tools/io/scene.hpp>

namespace nearfield::tools {

/// The techniques that the queries of a command request.
class AskedTechniques {
public:
    void add(Technique technique) { bits_ |= bit(technique); }
    /// Queries that only the CPU answers need no device, whatever technique they request.
    void add(const QueryRequest& request) {
        add(is_sampled(request.type) ? technique_of(request) : Technique::cpu);
    }
    [[nodiscard]] bool has(Technique technique) const { return (bits_ & bit(technique)) != 0; }

private:
    [[nodiscard]] static unsigned bit(Technique technique) {
        return 1U << static_cast<unsigned>(technique);
    }

    unsigned bits_ = 0;
};

[[nodiscard]] AskedTechniques techniques_of(const Scene& scene);

/// Creates a context with pipelines for the requested techniques, and without a device if none is
/// needed. If only Technique::automatic requests a device and none is usable, it prints a notice to
/// standard error and runs everything on the CPU. Throws LibraryError.
[[nodiscard]] Context open_context(Settings settings, const AskedTechniques& asked);

}  // namespace nearfield::tools
