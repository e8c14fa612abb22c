#pragma once

#include <engine/failure.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <type_traits>

namespace nearfield {

/// A copy of a structure that a host filled in, which may be older or newer than this library: its
/// `structure_size` says how much of it there is. What is missing has its default; what is unknown
/// has to be zero. Throws Failure (invalid_settings) for a size that never was one. `name`: of the
/// structure, for the message. `ends`: where it may have ended before it grew to what it is here,
/// which is in front of a member that begins a word.
template <class Structure>
[[nodiscard]] Structure adopted(const Structure& given, const char* name,
                                std::initializer_list<std::size_t> ends) {
    static_assert(std::is_trivially_copyable_v<Structure>);
    // More than any structure will ever have: what claims it was not initialised.
    constexpr std::size_t largest = 4096;
    const std::size_t size = given.structure_size;
    const auto refuse = [&](const std::string& reason) -> Failure {
        return Failure({StatusCode::invalid_settings, std::string(name) + "::structure_size is " +
                                                          std::to_string(size) + ": " + reason});
    };
    const bool is_older = std::find(ends.begin(), ends.end(), size) != ends.end();
    const bool is_newer =
        size > sizeof(Structure) && size <= largest && size % alignof(Structure) == 0;
    if (size != sizeof(Structure) && !is_older && !is_newer) {
        throw refuse("no version of nearfield has a " + std::string(name) +
                     " of that size; leave the member as it is (" +
                     std::to_string(sizeof(Structure)) + " here)");
    }
    const auto* const bytes = reinterpret_cast<const std::byte*>(&given);
    for (std::size_t i = sizeof(Structure); i < size; ++i) {
        if (bytes[i] != std::byte{0}) {
            throw refuse("it comes from a newer version, and byte " + std::to_string(i) +
                         " asks for something that this version does not have");
        }
    }
    Structure copy;
    std::memcpy(static_cast<void*>(&copy), bytes, std::min(size, sizeof(Structure)));
    copy.structure_size = sizeof(Structure);
    return copy;
}

}  // namespace nearfield
