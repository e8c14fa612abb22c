#include <engine/base/shape_errors.hpp>

namespace nearfield {

ShapeHandle ShapeErrors::refuse(const Status& why) {
    if (refusals_.size() < kept) {
        refusals_.push_back(why);
    } else {
        refusals_[count_ % kept] = why;
    }
    // Numbers of refusals are from 1 on: 0 is that of a handle that names nothing.
    return {UINT32_MAX, ++count_, context_};
}

Status ShapeErrors::unknown(const std::string& where, ShapeHandle handle) const {
    const std::string shape = where + ": the shape of index " + std::to_string(handle.index);
    if (handle == ShapeHandle{}) {
        return {StatusCode::unknown_shape, where + ": the handle names no shape"};
    }
    if (handle.context != context_) {
        return {StatusCode::unknown_shape,
                shape + " is of another context (number " + std::to_string(handle.context) +
                    "; this one is number " + std::to_string(context_) + ")"};
    }
    if (handle.index != UINT32_MAX) {
        return {StatusCode::unknown_shape,
                shape + " was removed from this context, or never added to it"};
    }
    if (handle.generation == 0 || handle.generation > count_ ||
        count_ - handle.generation >= kept) {
        return {StatusCode::unknown_shape, where + ": the shape was refused by add_shape()"};
    }
    const Status& why = refusals_[(handle.generation - 1) % kept];
    return {why.code(), where + " was refused: " + why.message(), why.reasons()};
}

}  // namespace nearfield
