#pragma once

#include <nearfield/context.hpp>

#include <tools/input/scene.hpp>
#include <tools/output/answer.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nearfield::tools {

/// Reads the option --technique, where it is given.
[[nodiscard]] std::optional<Technique> parse_technique_option(
    const std::optional<std::string>& name);

/// Asks all queries of a scene for a technique, where one is given.
void set_technique(Scene& scene, std::optional<Technique> technique);

/// A scene in a context, run frame by frame.
class SceneRunner {
public:
    /// `file` is for the messages. Throws LibraryError where a shape is refused.
    SceneRunner(const Scene& scene, std::string file, Context& context);
    /// Takes its shapes out of the context.
    ~SceneRunner();
    SceneRunner(const SceneRunner&) = delete;
    SceneRunner& operator=(const SceneRunner&) = delete;

    /// One whole frame: shapes (which may have deformed), poses and queries in, results out.
    /// Returns its milliseconds. Throws LibraryError where the batch as a whole fails.
    double run_frame();

    /// Throws LibraryError where a query of the last frame was refused.
    void require_results() const;

    /// The answers of the last frame in the order of the scene's queries, and where one asks for
    /// all pairs in the order of its pairs. Valid until the next frame.
    [[nodiscard]] std::vector<SceneAnswer> answers() const;
    /// What answered the queries of the last frame; "mixed" where it is not the same for all,
    /// "none" where there are none.
    [[nodiscard]] std::string_view technique() const;
    /// Queries of the last frame, every pair of "all pairs" counted.
    [[nodiscard]] std::size_t query_count() const noexcept { return entries_.size(); }
    [[nodiscard]] const Timings& timings() const noexcept { return results_.timings; }

private:
    /// A query of the batch: which of the scene's, between which instances.
    struct Entry {
        std::size_t query = 0;
        std::size_t a = 0;
        std::size_t b = 0;
    };

    void add(std::size_t query, std::size_t a, std::size_t b);
    void add_all_pairs(std::size_t query);
    /// Of times of impact.
    void add_moving_pairs(std::size_t query);
    [[nodiscard]] std::string place_of(const SceneShape& shape) const;

    const Scene& scene_;
    std::string file_;
    Context& context_;
    std::vector<ShapeHandle> shapes_;
    std::vector<Instance> instances_;
    std::vector<InstancePair> pairs_;
    std::vector<Entry> entries_;
    Batch batch_;
    Results results_;
};

}  // namespace nearfield::tools
