#include <nearfield/version.hpp>

#include <string_view>

namespace nearfield {
namespace {

#define NEARFIELD_TEXT_OF(number) #number
#define NEARFIELD_TEXT(major, minor, patch) \
    NEARFIELD_TEXT_OF(major) "." NEARFIELD_TEXT_OF(minor) "." NEARFIELD_TEXT_OF(patch)
static_assert(std::string_view(NEARFIELD_VERSION) == NEARFIELD_TEXT(NEARFIELD_VERSION_MAJOR,
                                                                    NEARFIELD_VERSION_MINOR,
                                                                    NEARFIELD_VERSION_PATCH));

constexpr Version headers{NEARFIELD_VERSION_MAJOR, NEARFIELD_VERSION_MINOR, NEARFIELD_VERSION_PATCH,
                          NEARFIELD_ABI_VERSION, NEARFIELD_VERSION};

}  // namespace

Version version() noexcept {
    return headers;
}

}  // namespace nearfield
