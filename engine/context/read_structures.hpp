#pragma once

#include <nearfield/context.hpp>

namespace nearfield {

/// Convert the host's structures, of any version, to this library's version (versioned.hpp). Each
/// throws StatusException (invalid_settings) that names the structure and the unusable member.
[[nodiscard]] HostDevice read_versioned(const HostDevice& given);
[[nodiscard]] HeadlessOptions read_versioned(const HeadlessOptions& given);
[[nodiscard]] Submission read_versioned(const Submission& given);
[[nodiscard]] Recording read_versioned(const Recording& given);
[[nodiscard]] Limits read_versioned(const Limits& given);
/// Checks the members, too.
[[nodiscard]] Settings read_versioned(const Settings& given);

}  // namespace nearfield
