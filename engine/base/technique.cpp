#include <nearfield/query.hpp>

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

}  // namespace nearfield
