#include <engine/base/status_exception.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/plan/memory_budget.hpp>
#include <nearfield/jobs.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace nearfield::plan {
namespace {

// Signs, features, distances, hits and two stencils (8 bytes each where the stencil comes with
// depth); signs in white, signed features with their distances, gradients.
constexpr double bytes_per_pixel = 4.0 * 4.0 + 2.0 * 8.0 + 1.0 + 2.0 * 4.0 + 8.0;

// Memory per sample while all samples of a boundary are kept at once and none is planned: its
// position, the nearest feature, the potential contact.
constexpr double bytes_of_kept_sample = 256.0;

double bytes_of_images(const PlanLimits& limits) {
    return bytes_per_pixel * limits.largest_atlas * limits.largest_atlas;
}

/// A size in the largest unit that it fills, so that a small limit is not told as 0 MiB.
std::string memory_text(double bytes, double (*round)(double)) {
    constexpr double kibibyte = 1024.0;
    constexpr double mebibyte = 1024.0 * kibibyte;
    const double unit = bytes >= mebibyte ? mebibyte : bytes >= kibibyte ? kibibyte : 1.0;
    const char* const name = unit == mebibyte ? " MiB" : unit == kibibyte ? " KiB" : " bytes";
    return number(round(bytes / unit)) + name;
}

}  // namespace

PlanLimits with_affordable_atlas(PlanLimits limits) {
    while (limits.largest_atlas > smallest_atlas &&
           bytes_of_images(limits) > static_cast<double>(limits.memory) / 4.0) {
        limits.largest_atlas /= 2;
    }
    limits.largest_tile = std::min(limits.largest_tile, limits.largest_atlas);
    return limits;
}

MemoryBudget::MemoryBudget(const PlanLimits& limits, bool counts_closely)
    : limit_(static_cast<double>(limits.memory)),
      images_(bytes_of_images(limits)),
      for_results_(std::max(0.0, limit_ - images_)),
      max_to_keep_(for_results_ / 4.0 / bytes_of_kept_sample),
      counts_closely_(counts_closely) {}

std::uint32_t MemoryBudget::jobs_with_room() const {
    const double with_room = max_to_keep_ / std::max(1.0, max_kept_);
    return static_cast<std::uint32_t>(std::clamp(with_room, 1.0, 1.0 * max_jobs));
}

void QueryMemory::require(double bytes, double growth) {
    batch_.required_ += bytes;
    bytes_ += bytes;
    const double limit = batch_.for_results_;
    if (batch_.required_ <= limit) {
        return;
    }
    // The tolerance at which this query alone fits.
    const double smallest = tolerance_ * std::pow(bytes_ / limit, 1.0 / growth);
    const std::string hint = limit == 0.0 ? "; images take all of it"
                             : bytes_ > limit
                                 ? "; the smallest tolerance that fits is about " +
                                       number(static_cast<float>(smallest * 1.05))
                                 : "; together with the queries before it the batch is too large";
    const auto up = [](double value) { return std::ceil(value); };
    const auto down = [](double value) { return std::floor(value); };
    throw StatusException(
        {StatusCode::too_large,
         "query " + std::to_string(query_) + " with tolerance " + number(tolerance_) +
             " needs up to " + memory_text(batch_.images_ + batch_.required_, up) +
             ", more than the limit of " + memory_text(batch_.limit_, down) + hint});
}

bool QueryMemory::can_keep(double samples) {
    if (samples > batch_.max_to_keep_) {
        return false;
    }
    batch_.max_kept_ = std::max(batch_.max_kept_, samples);
    return true;
}

bool QueryMemory::fits_roughly(double samples_at_once, double bytes) {
    const bool is_to_be_close = batch_.counts_closely_ && bytes > 0.0;
    if (is_to_be_close || !can_keep(samples_at_once)) {
        return false;
    }
    batch_.rough_ += bytes;
    return true;
}

bool QueryMemory::fits(double samples_at_once, double bytes) {
    if (!can_keep(samples_at_once)) {
        return false;
    }
    require(bytes, 1.0);
    return true;
}

}  // namespace nearfield::plan
