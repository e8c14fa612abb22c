#include <nearfield/query.hpp>
#include <nearfield/result.hpp>

namespace nearfield {

const char* to_string(Technique technique) noexcept {
    switch (technique) {
        case Technique::automatic:
            return "automatic";
        case Technique::raster:
            return "raster";
        case Technique::compute:
            return "compute";
        case Technique::cpu:
            return "cpu";
    }
    return "unknown";
}

const char* to_string(IntersectionStrategy strategy) noexcept {
    switch (strategy) {
        case IntersectionStrategy::stencil:
            return "stencil";
        case IntersectionStrategy::blend:
            return "blend";
        case IntersectionStrategy::logic_op:
            return "logic_op";
        case IntersectionStrategy::depth:
            return "depth";
    }
    return "unknown";
}

const char* to_string(ImpactState state) noexcept {
    switch (state) {
        case ImpactState::separated:
            return "separated";
        case ImpactState::hit:
            return "hit";
        case ImpactState::intersecting_at_start:
            return "intersecting_at_start";
        case ImpactState::bound_not_reached:
            return "bound_not_reached";
    }
    return "unknown";
}

}  // namespace nearfield
