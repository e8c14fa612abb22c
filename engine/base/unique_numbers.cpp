#include <engine/base/unique_numbers.hpp>
#include <nearfield/query.hpp>

#include <atomic>

namespace nearfield {

std::uint32_t next_owner_number() noexcept {
    static std::atomic<std::uint32_t> last = 0;
    return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

std::uint64_t next_revision() noexcept {
    static std::atomic<std::uint64_t> last = 0;
    return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

std::uint64_t Batch::next_number() noexcept {
    return next_revision();
}

}  // namespace nearfield
