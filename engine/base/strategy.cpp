#include <nearfield/query.hpp>

namespace nearfield {

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

}  // namespace nearfield
