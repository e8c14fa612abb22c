#pragma once

#include <engine/base/status_exception.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <type_traits>

namespace nearfield {

/// Copies a structure that the host filled in and that may be older or newer than this library; its
/// `structure_size` gives its size. Missing members take their defaults; bytes of unknown members
/// must be zero. Throws StatusException (invalid_settings) for a size that no version has had.
/// `name`: the structure's name, for the message. `ends`: the sizes of earlier versions, each of
/// which ends just before a member that begins a word.
template <class Structure>
[[nodiscard]] Structure read_versioned(const Structure& given, const char* name,
                                       std::initializer_list<std::size_t> ends) {
    static_assert(std::is_trivially_copyable_v<Structure>);
    if (given.structure_size == sizeof(Structure)) {
        return given;
    }
    // Larger than any structure will ever be: such a size is an uninitialised member.
    constexpr std::size_t largest = 4096;
    const std::size_t size = given.structure_size;
    const auto refuse = [&](const std::string& reason) -> StatusException {
        return StatusException(
            {StatusCode::invalid_settings,
             std::string(name) + "::structure_size is " + std::to_string(size) + ": " + reason});
    };
    const bool is_older = std::find(ends.begin(), ends.end(), size) != ends.end();
    const bool is_newer =
        size > sizeof(Structure) && size <= largest && size % alignof(Structure) == 0;
    if (!is_older && !is_newer) {
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
