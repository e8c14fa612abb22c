#include <engine/base/status_exception.hpp>
#include <engine/gpu/buffer_parts.hpp>

#include <string>

namespace nearfield {

void require_range(const gpu::Device& device, std::uint64_t bytes, const char* what) {
    const std::uint64_t most = device.limits().maxStorageBufferRange;
    if (bytes > most) {
        throw StatusException(
            {StatusCode::too_large,
             std::string(what) + " of one tile batch take " + std::to_string(bytes) +
                 " bytes; a storage buffer of this device holds " + std::to_string(most)});
    }
}

}  // namespace nearfield
