#pragma once

#include <nearfield/context.hpp>
#include <nearfield/query.hpp>
#include <nearfield/shape.hpp>

#include <cstdint>
#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace nearfield::hash {

/// Random numbers by integer arithmetic alone (splitmix64), so that they are the same everywhere.
class Integers {
public:
    explicit Integers(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        state_ += 0x9E3779B97F4A7C15;
        std::uint64_t z = state_;
        z = (z ^ z >> 30U) * 0xBF58476D1CE4E5B9;
        z = (z ^ z >> 27U) * 0x94D049BB133111EB;
        return z ^ z >> 31U;
    }
    /// From 0 to `count` - 1.
    std::uint32_t below(std::uint32_t count) {
        return static_cast<std::uint32_t>((next() >> 32U) * count >> 32U);
    }
    /// A multiple of 2^-52 in [low, low + length).
    double from(double low, double length) {
        return low + length * (static_cast<double>(next() >> 12U) * 0x1p-52);
    }

private:
    std::uint64_t state_;
};

/// Two shapes, and how large their details are.
struct Pair {
    std::vector<Ring> a;
    std::vector<Ring> b;
    Pose pose_a;
    Pose pose_b;
    double tolerance = 0.0;
};

/// A random shape of up to about 40 vertices, within 1 or so of the origin: a star, a spiky star,
/// one with a hole, a ring that crosses itself, or a polygon on a lattice.
[[nodiscard]] std::vector<Ring> any_shape(Integers& integers);

/// A random pair that overlaps, touches or is close. Half of the pairs are degenerate: a shape with
/// itself, also moved by its own coordinates or by almost nothing, and shapes on one lattice. Some
/// are far from the origin.
[[nodiscard]] Pair any_pair(Integers& integers);

/// Two shapes of a context at their poses.
struct PlacedPair {
    Instance a;
    Instance b;
    double tolerance = 0.0;
};

/// Appends every kind of query that Technique::cpu answers, with every option that makes a
/// difference to it. `points`: where fields are asked at points; they must outlive the batch.
/// `max_work`: of separation vectors.
void ask_everything(const PlacedPair& pair, std::span<const Vector2> points, std::uint64_t max_work,
                    Batch& batch);

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
