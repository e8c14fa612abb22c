#include <tools/io/report_target.hpp>

#include <iostream>

namespace nearfield::tools {

ReportTarget::ReportTarget(const std::optional<std::string>& json) : standard_output_(json == "-") {
    if (json && !standard_output_) {
        file_.emplace(*json);
    }
}

std::ostream* ReportTarget::json() noexcept {
    if (standard_output_) {
        return &std::cout;
    }
    return file_ ? &file_->stream() : nullptr;
}

std::ostream& ReportTarget::summary() noexcept {
    return standard_output_ ? std::cerr : std::cout;
}

void ReportTarget::commit() {
    if (file_) {
        file_->commit();
    }
}

}  // namespace nearfield::tools
