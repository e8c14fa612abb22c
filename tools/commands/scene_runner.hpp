#pragma once

#include <nearfield/context.hpp>

#include <tools/input/scene.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// A scene in a context, run frame by frame.
class SceneRunner {
public:
    /// `file` is for the messages. Throws LibraryError where a shape is refused.
    SceneRunner(const Scene& scene, std::string file, Context& context);

    /// One whole frame: shapes (which may have deformed), poses and queries in, results out.
    /// Returns its milliseconds. Throws LibraryError where the batch as a whole fails.
    double run_frame();

    /// Throws LibraryError where a query of the last frame was refused.
    void require_results() const;

    /// Of the last frame, in the order of the scene's queries.
    [[nodiscard]] const Results& results() const noexcept { return results_; }
    [[nodiscard]] const Timings& timings() const noexcept { return results_.timings; }

private:
    [[nodiscard]] Instance instance(std::size_t index) const;
    [[nodiscard]] std::string place_of(const SceneShape& shape) const;

    const Scene& scene_;
    std::string file_;
    Context& context_;
    std::vector<ShapeHandle> shapes_;
    Batch batch_;
    Results results_;
};

}  // namespace nearfield::tools
