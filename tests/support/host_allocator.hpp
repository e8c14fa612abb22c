#pragma once

#include <nearfield/host.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <string>
#include <vector>

namespace nearfield::test_support {

/// A host's allocator of device memory, as an engine has one: pieces of a few large allocations,
/// which stay mapped where the host sees them. Gaps between the pieces hold a pattern. For one
/// thread.
class HostAllocator {
public:
    /// A piece that was given and not taken back.
    struct Piece {
        MemoryRequest request;  ///< without the name
        MemoryAllocation allocation;
        std::string name;
    };

    explicit HostAllocator(const HostDevice& host);
    ~HostAllocator() { close(); }
    HostAllocator(const HostAllocator&) = delete;
    HostAllocator& operator=(const HostAllocator&) = delete;

    /// Frees all memory. Everything must have been given back.
    void close();

    /// For HostDevice::memory.
    [[nodiscard]] MemoryFunctions functions();

    /// If set, may change the answer to a request, or return an error; then nothing is given.
    std::function<VkResult(const MemoryRequest&, MemoryAllocation&)> bend;

    [[nodiscard]] const std::list<Piece>& given() const { return given_; }
    /// Bytes of all pieces.
    [[nodiscard]] std::uint64_t bytes() const;
    /// The number of its own vkAllocateMemory calls.
    [[nodiscard]] std::size_t allocations() const { return blocks_.size(); }
    /// The number of pieces given so far.
    [[nodiscard]] std::size_t requests() const { return requests_; }
    /// What the library did wrong with the functions, as text.
    [[nodiscard]] const std::vector<std::string>& mistakes() const { return mistakes_; }
    /// A host-visible gap between pieces was written.
    [[nodiscard]] bool gaps_are_written() const;
    /// The piece of which a range of memory is a part; null if there is none.
    [[nodiscard]] const Piece* find(VkDeviceMemory memory, std::uint64_t offset,
                                    std::uint64_t bytes) const;

private:
    struct Block {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        std::uint32_t type = 0;
        std::uint64_t bytes = 0;
        std::byte* data = nullptr;  // null unless the host sees it
    };

    template <class Function>
    [[nodiscard]] Function function(const char* name) const;
    VkResult allocate(const MemoryRequest& request, MemoryAllocation& allocation);
    void free(const MemoryAllocation& allocation);
    void check_request(const MemoryRequest& request);
    [[nodiscard]] std::uint32_t choose_type(const MemoryRequest& request) const;
    [[nodiscard]] std::uint64_t find_gap(const Block& block,
                                         const VkMemoryRequirements& needs) const;
    [[nodiscard]] const Block& add_block(std::uint32_t type, std::uint64_t bytes);
    void paint(const Block& block, std::uint64_t offset, std::uint64_t bytes) const;

    HostDevice host_;
    VkPhysicalDeviceMemoryProperties memory_{};
    VkDeviceSize atom_ = 0;
    std::list<Block> blocks_;
    std::list<Piece> given_;
    std::size_t requests_ = 0;
    std::vector<std::string> mistakes_;
};

}  // namespace nearfield::test_support
