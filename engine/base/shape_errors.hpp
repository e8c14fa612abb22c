#pragma once

#include <nearfield/shape.hpp>
#include <nearfield/status.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nearfield {

/// What is wrong with handles that name no shape of a context: they are of another one, or their
/// shape was removed, or refused when it was to be added.
class ShapeErrors {
public:
    explicit ShapeErrors(std::uint32_t context) : context_(context) {}

    /// The context's number, in the handles of its shapes.
    [[nodiscard]] std::uint32_t context() const { return context_; }

    /// Keeps the reason why a shape was refused, until many more are; returns a handle that stands
    /// for it and names no shape.
    [[nodiscard]] ShapeHandle refuse(const Status& why);

    /// The error for a handle that names no shape. `where`: for the message, which begins with it.
    [[nodiscard]] Status unknown(const std::string& where, ShapeHandle handle) const;

private:
    static constexpr std::size_t kept = 64;

    std::uint32_t context_;
    std::uint32_t count_ = 0;       // of all that were refused
    std::vector<Status> refusals_;  // the last ones: number n at n % kept
};

}  // namespace nearfield
