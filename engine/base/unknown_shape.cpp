#include <engine/base/unknown_shape.hpp>

namespace nearfield {

Status unknown_shape(const std::string& where, ShapeHandle handle, std::uint32_t context) {
    const std::string shape = where + ": the shape of index " + std::to_string(handle.index);
    std::string why;
    if (handle == ShapeHandle{}) {
        why = where + ": the handle names no shape";
    } else if (handle.context != context) {
        why = shape + " is of another context (number " + std::to_string(handle.context) +
              "; this one is number " + std::to_string(context) + ")";
    } else {
        why = shape + " was removed from this context, or never added to it";
    }
    return {StatusCode::unknown_shape, why};
}

}  // namespace nearfield
