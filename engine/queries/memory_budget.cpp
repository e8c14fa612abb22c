#include <engine/base/status_exception.hpp>
#include <engine/queries/check_query.hpp>
#include <engine/queries/memory_budget.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace nearfield::queries {
namespace {

// Signs, features, distances, hits and two stencils (8 bytes each where the stencil comes with
// depth); signs in white, signed features with their distances, gradients.
constexpr double bytes_per_pixel = 4.0 * 4.0 + 2.0 * 8.0 + 1.0 + 2.0 * 4.0 + 8.0;

// Points of a query, which results count in 32 bits.
constexpr double max_numbered_points = 1U << 30U;

double bytes_of_images(const QueryLimits& limits) {
    return bytes_per_pixel * limits.largest_atlas * limits.largest_atlas;
}

/// A size in the largest unit that it fills, so that a small limit is not told as 0 MiB.
std::string memory_text(double bytes, double (*round)(double)) {
    constexpr double kibibyte = 1024.0;
    constexpr double mebibyte = 1024.0 * kibibyte;
    const double unit = bytes >= mebibyte ? mebibyte : bytes >= kibibyte ? kibibyte : 1.0;
    const char* const name = unit == mebibyte ? " MiB" : unit == kibibyte ? " KiB" : " bytes";
    return geometry::number(round(bytes / unit)) + name;
}

}  // namespace

QueryLimits with_affordable_atlas(QueryLimits limits) {
    while (limits.largest_atlas > smallest_atlas &&
           bytes_of_images(limits) > static_cast<double>(limits.memory) / 4.0) {
        limits.largest_atlas /= 2;
    }
    limits.largest_tile = std::min(limits.largest_tile, limits.largest_atlas);
    return limits;
}

MemoryBudget::MemoryBudget(const QueryLimits& limits)
    : limit_(static_cast<double>(limits.memory)),
      images_(bytes_of_images(limits)),
      for_results_(std::max(0.0, limit_ - images_)) {}

void QueryMemory::require(double bytes, double growth) {
    bytes_ += bytes;
    const double required = batch_.required_.fetch_add(bytes) + bytes;
    if (required > batch_.for_results_) {
        refuse(required, growth);
    }
}

bool QueryMemory::fits_alone(double kept, double points) const {
    return points <= max_numbered_points && kept * points <= batch_.for_results_;
}

void QueryMemory::require_alone(double kept, double points) {
    if (fits_alone(kept, points)) {
        return;
    }
    if (kept * points > batch_.for_results_) {
        bytes_ = kept * points;
        refuse(bytes_, 1.0);
    }
    const double smallest = tolerance_ * points / max_numbered_points;
    throw StatusException({StatusCode::too_large,
                           "query " + std::to_string(query_) + " with tolerance " +
                               geometry::number(tolerance_) + " has up to " +
                               geometry::number(points) +
                               " points, more than can be numbered; the smallest tolerance that "
                               "fits is about " +
                               geometry::number(static_cast<float>(smallest * 1.05))});
}

void QueryMemory::refuse(double required, double growth) const {
    const double limit = batch_.for_results_;
    // The tolerance at which this query alone fits.
    const double smallest = tolerance_ * std::pow(bytes_ / limit, 1.0 / growth);
    const std::string hint = limit == 0.0 ? "; images take all of it"
                             : bytes_ > limit
                                 ? "; the smallest tolerance that fits is about " +
                                       geometry::number(static_cast<float>(smallest * 1.05))
                                 : "; together with the queries before it the batch is too large";
    const auto up = [](double value) { return std::ceil(value); };
    const auto down = [](double value) { return std::floor(value); };
    throw StatusException(
        {StatusCode::too_large,
         "query " + std::to_string(query_) + " with tolerance " + geometry::number(tolerance_) +
             " needs up to " + memory_text(batch_.images_ + required, up) +
             ", more than the limit of " + memory_text(batch_.limit_, down) + hint});
}

}  // namespace nearfield::queries
