#include <tools/cli/frame_output.hpp>
#include <tools/common/interruptible.hpp>
#include <tools/common/library_error.hpp>
#include <tools/rendering/frame_image.hpp>
#include <unistd.h>

#include <cmath>
#include <iostream>

namespace nearfield::tools {

FrameOutput::FrameOutput(const SimulateArguments& arguments, const View& view, double frame_time)
    : arguments_(arguments) {
    const auto width = static_cast<std::uint32_t>(view.page().max.x);
    const auto height = static_cast<std::uint32_t>(view.page().max.y);
    if (arguments.image) {
        files_.emplace(*arguments.image);
    }
    if (arguments.video) {
        video_.emplace(*arguments.video, width, height,
                       static_cast<std::uint32_t>(std::round(1.0 / frame_time)));
    }
    if (files_ || video_) {
        device_.emplace();
        page_.emplace(device_->gpu, width, height);
    }
}

void FrameOutput::add(std::uint32_t frame, const std::function<void(Drawing&)>& draw) {
    const bool in_a_file = files_ && (frame % arguments_.every == 0 || frame == arguments_.frames);
    if (!in_a_file && !video_) {
        return;
    }
    drawing_.clear();
    draw(drawing_);
    const FrameImage image = page_->paint(drawing_);
    if (in_a_file) {
        files_->write(frame, png_of(image));
    }
    if (video_) {
        video_->add(image.pixels);
    }
}

void FrameOutput::finish() {
    if (video_) {
        video_->finish();
    }
}

int run_frames(std::uint32_t count, const std::function<void(std::uint32_t)>& run_frame) {
    const bool show_progress = isatty(STDERR_FILENO) == 1;
    for (std::uint32_t frame = 1; frame <= count; ++frame) {
        if (show_progress) {
            std::cerr << "\rframe " << frame << " of " << count << std::flush;
        }
        run_frame(frame);
        if (was_ctrl_c_pressed()) {
            break;
        }
    }
    if (show_progress) {
        std::cerr << '\n';
    }
    return was_ctrl_c_pressed() ? exit_status::stopped : exit_status::done;
}

}  // namespace nearfield::tools
