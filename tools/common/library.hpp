#pragma once

#include <nearfield/context.hpp>
#include <nearfield/status.hpp>
#include <nearfield/timings.hpp>

#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace nearfield::tools {

/// Exit statuses of the program.
namespace exit_status {
inline constexpr int done = 0;
inline constexpr int other_error = 1;
inline constexpr int bad_input = 2;
inline constexpr int no_device = 3;
inline constexpr int stopped = 130;  ///< by Ctrl-C: 128 and the number of SIGINT, as of a shell
}  // namespace exit_status

/// How the program ends after an error of the library.
[[nodiscard]] int exit_status_of(StatusCode code) noexcept;

/// The library refused or failed.
class LibraryError : public std::runtime_error {
public:
    LibraryError(const Status& status, const std::string& message)
        : std::runtime_error(message), code_(status.code()) {}

    [[nodiscard]] StatusCode code() const noexcept { return code_; }
    [[nodiscard]] int program_status() const noexcept { return exit_status_of(code_); }

private:
    StatusCode code_;
};

/// Throws LibraryError if the status is an error. `subject` (such as a file name) precedes its
/// text.
void require(const Status& status, const std::string& subject = {});

/// Returns the value or throws LibraryError.
template <class Value>
[[nodiscard]] Value take(Expected<Value> expected, const std::string& subject = {}) {
    require(expected.error(), subject);
    return std::move(*expected);
}

/// Adds a shape. Where rings are refused, the status names all of them, not only the first (twenty,
/// then how many more): number, first vertex and reason.
[[nodiscard]] Expected<ShapeHandle> add_shape(Context& context, std::span<const Ring> rings,
                                              double deviation);

/// Adds the times of what was done after that; those of passes by name.
void add_timings(const Timings& more, Timings& sum);

}  // namespace nearfield::tools
