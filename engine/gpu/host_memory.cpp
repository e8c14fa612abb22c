#include <engine/base/status_exception.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/host_memory.hpp>

#include <cstddef>
#include <cstdint>
#include <string>

namespace nearfield::gpu {
namespace {

/// The contradiction between the host's answer and the request; empty if there is none.
std::string contradiction(const MemoryAllocation& given, const MemoryRequest& request) {
    const VkMemoryRequirements& needs = request.requirements;
    if (given.memory == VK_NULL_HANDLE) {
        return "memory is null";
    }
    if (given.memory_type >= VK_MAX_MEMORY_TYPES ||
        ((needs.memoryTypeBits >> given.memory_type) & 1U) == 0) {
        return "memory_type is " + std::to_string(given.memory_type) +
               ", which is not among the allowed types " + std::to_string(needs.memoryTypeBits) +
               " (bit mask)";
    }
    if (given.offset % needs.alignment != 0) {
        return "offset is " + std::to_string(given.offset) +
               ", which is not a multiple of the alignment " + std::to_string(needs.alignment);
    }
    if ((request.required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) == 0) {
        return {};
    }
    if (given.mapped == nullptr) {
        return "mapped is null, and the host has to see this memory";
    }
    constexpr std::uintptr_t alignment = 64;  // every mapping has it, at aligned offsets
    if (reinterpret_cast<std::uintptr_t>(given.mapped) % alignment != 0) {
        return "mapped is no multiple of 64, so it is not where the byte at offset is";
    }
    return {};
}

}  // namespace

// Delegates: once the other constructor is done, the destructor gives the memory back if this one
// throws.
HostMemory::HostMemory(const MemoryFunctions& functions, const MemoryRequest& request)
    : HostMemory(functions) {
    const VkResult result = functions_.allocate(functions_.user, &request, &allocation_);
    constexpr const char* call = "HostDevice::memory.allocate";
    check(result, call, request.name);
    if (result != VK_SUCCESS) {
        throw StatusException({StatusCode::invalid_settings,
                               std::string(call) + " returned " + to_string(result) + " for " +
                                   request.name + ", which is neither success nor an error"});
    }
    given_ = true;
    if (const std::string reason = contradiction(allocation_, request); !reason.empty()) {
        throw StatusException(
            {StatusCode::invalid_settings, std::string(call) +
                                               " gave memory that contradicts the request for " +
                                               request.name + ": " + reason});
    }
}

HostMemory::~HostMemory() {
    if (given_) {
        functions_.free(functions_.user, &allocation_);
    }
}

}  // namespace nearfield::gpu
