#pragma once

#include <nearfield/context.hpp>

namespace nearfield {

/// What a host filled in, as this library has it (growable.hpp). Each throws Failure
/// (invalid_settings) that names the structure and the member that cannot be used.
[[nodiscard]] HostDevice adopted(const HostDevice& given);
[[nodiscard]] HeadlessOptions adopted(const HeadlessOptions& given);
[[nodiscard]] Submission adopted(const Submission& given);
[[nodiscard]] Recording adopted(const Recording& given);
/// Checks what is in it too.
[[nodiscard]] Settings adopted(const Settings& given);

}  // namespace nearfield
