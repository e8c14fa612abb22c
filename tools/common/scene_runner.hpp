#pragma once

#include <nearfield/context.hpp>

#include <tools/io/answer.hpp>
#include <tools/io/scene.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nearfield::tools {

/// Parses the option --technique, if given.
[[nodiscard]] std::optional<Technique> parse_technique_option(
    const std::optional<std::string>& name);

/// Sets the technique of all queries in a scene, if given.
void set_technique(Scene& scene, std::optional<Technique> technique);

/// Runs a scene in a context frame by frame.
class SceneRunner {
public:
    /// `file` is used in messages. Throws LibraryError if a shape is rejected.
    SceneRunner(const Scene& scene, std::string file, Context& context);
    /// Removes its shapes from the context.
    ~SceneRunner();
    SceneRunner(const SceneRunner&) = delete;
    SceneRunner& operator=(const SceneRunner&) = delete;

    /// Runs one whole frame: shapes (which may have deformed), poses and queries in, results out.
    /// Returns the time in milliseconds. Throws LibraryError if the batch as a whole fails.
    double run_frame();

    /// Throws LibraryError if a query of the last frame was rejected.
    void require_results() const;

    /// The answers of the last frame in the order of the scene's queries; a query for all pairs has
    /// its answers in pair order. Valid until the next frame.
    [[nodiscard]] std::vector<SceneAnswer> answers() const;
    /// The technique that answered the queries of the last frame; "mixed" if there were several,
    /// "none" if there were no queries.
    [[nodiscard]] std::string_view technique() const;
    /// The number of queries in the last frame, counting every pair of "all pairs".
    [[nodiscard]] std::size_t query_count() const noexcept { return entries_.size(); }
    [[nodiscard]] const Timings& timings() const noexcept { return results_.timings; }

private:
    /// A query of the batch: its index in the scene, and its instances.
    struct Entry {
        std::size_t query = 0;
        std::size_t a = 0;
        std::size_t b = 0;
    };

    void add(std::size_t query, std::size_t a, std::size_t b);
    void add_all_pairs(std::size_t query);
    /// For time-of-impact queries.
    void add_moving_pairs(std::size_t query);
    [[nodiscard]] std::string place_of(const SceneShape& shape) const;

    const Scene& scene_;
    std::string file_;
    Context& context_;
    std::vector<ShapeHandle> shapes_;
    std::vector<Instance> instances_;
    std::vector<Entry> entries_;
    Batch batch_;
    Results results_;
};

}  // namespace nearfield::tools
