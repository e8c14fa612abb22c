#pragma once

#include <tools/cli/simulate.hpp>
#include <tools/drawing/view.hpp>
#include <tools/io/frame_files.hpp>
#include <tools/io/video_file.hpp>
#include <tools/rendering/page.hpp>

#include <cstdint>
#include <functional>
#include <optional>

namespace nearfield::tools {

/// What paints pictures.
struct PaintingDevice {
    GpuInstance instance;
    Gpu gpu{instance};
};

/// The pictures of a run, in files or a video, if any are requested, and the device that paints
/// them.
class FrameOutput {
public:
    /// Throws InputError if a file cannot be written, NoGpu if there is no device to paint on.
    FrameOutput(const SimulateArguments& arguments, const View& view, double frame_time);

    /// The device that paints; null if no picture is requested.
    [[nodiscard]] const Gpu* gpu() const { return device_ ? &device_->gpu : nullptr; }

    /// Paints a frame if it is requested. `draw` is called only then.
    void add(std::uint32_t frame, const std::function<void(Drawing&)>& draw);
    void finish();

private:
    const SimulateArguments& arguments_;
    std::optional<FrameFiles> files_;
    std::optional<VideoFile> video_;
    std::optional<PaintingDevice> device_;
    std::optional<OffscreenPage> page_;
    Drawing drawing_;
};

/// Runs frames 1, 2, ... until the last one or Ctrl-C, and shows the progress on a terminal;
/// returns the exit status.
[[nodiscard]] int run_frames(std::uint32_t count,
                             const std::function<void(std::uint32_t)>& run_frame);

}  // namespace nearfield::tools
