#include <tools/io/frame_files.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/output_file.hpp>

#include <cctype>

namespace nearfield::tools {

FrameFiles::FrameFiles(const std::string& pattern) {
    const auto refuse = [&pattern](const std::string& reason) {
        throw InputError("--image: \"" + pattern + "\": " + reason);
    };
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        std::string& part = numbered_ ? after_ : before_;
        if (pattern[i] != '%') {
            part += pattern[i];
        } else if (i + 1 < pattern.size() && pattern[i + 1] == '%') {
            part += pattern[++i];
        } else {
            std::size_t end = i + 1;
            while (end < pattern.size() && std::isdigit(static_cast<unsigned char>(pattern[end]))) {
                ++end;
            }
            if (end == pattern.size() || pattern[end] != 'd' || end - i > 3) {
                refuse(
                    "after % stands d, or 0 and the number of digits and d; %% is a per cent sign");
            }
            if (numbered_) {
                refuse("has more than one frame number");
            }
            digits_ = end > i + 1 ? std::stoul(pattern.substr(i + 1, end - i - 1)) : 0;
            numbered_ = true;
            i = end;
        }
    }
    // Fails before the work begins if the file cannot be written; leaves nothing behind.
    const OutputFile first(path_of(0));
}

std::string FrameFiles::path_of(std::uint64_t frame) const {
    if (!numbered_) {
        return before_;
    }
    std::string number = std::to_string(frame);
    if (number.size() < digits_) {
        number.insert(0, digits_ - number.size(), '0');
    }
    return before_ + number + after_;
}

void FrameFiles::write(std::uint64_t frame, const std::string& bytes) const {
    OutputFile file(path_of(frame));
    file.stream() << bytes;
    file.commit();
}

}  // namespace nearfield::tools
