#pragma once

#include <nearfield/context.hpp>

#include <cstdint>
#include <functional>
#include <ostream>
#include <span>
#include <string>

namespace nearfield::hash {

/// Makes a context. Whatever its device and its jobs, Technique::cpu answers with the same bits.
using MakeContext = std::function<Context(const Settings&)>;

/// A part of the answers.
struct Section {
    std::string name;
    /// The hash of all answers. Throws tools::LibraryError if a call fails.
    std::function<std::uint64_t(const MakeContext&)> hash;
    bool quick = true;  ///< takes seconds at most, also on an emulated processor
};

/// All sections, in the order in which they are printed.
[[nodiscard]] std::span<const Section> sections();

/// Prints the hash of each section, a line each. `quick`: of the quick sections alone.
void print_hashes(const MakeContext& make_context, bool quick, std::ostream& stream);

/// A context without a device.
[[nodiscard]] Context cpu_context(const Settings& settings);

// What the sections hash.

/// `count` random pairs from pair `first` on, by all queries.
[[nodiscard]] std::uint64_t hash_pairs(const MakeContext& make_context, std::uint32_t first,
                                       std::uint32_t count);
/// A world that changes, by all its queries.
[[nodiscard]] std::uint64_t hash_world(const MakeContext& make_context);
}  // namespace nearfield::hash
