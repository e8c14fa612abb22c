#include <nearfield/result.hpp>

namespace nearfield {

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
