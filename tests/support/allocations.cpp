#include <tests/support/allocations.hpp>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> allocations{0};
thread_local std::uint64_t allocations_of_this_thread = 0;
thread_local std::uint64_t successes_left = UINT64_MAX;
thread_local bool failed = false;
thread_local int unwatched = 0;

void* allocate(std::size_t size) noexcept {
    if (unwatched == 0) {
        ++allocations;
        ++allocations_of_this_thread;
        if (successes_left == 0) {
            return nullptr;
        }
        --successes_left;
    }
    return std::malloc(size == 0 ? 1 : size);
}

}  // namespace

void* operator new(std::size_t size) {
    if (void* const memory = allocate(size)) {
        return memory;
    }
    failed = true;
    throw std::bad_alloc();
}

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return allocate(size);
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

void operator delete(void* memory, const std::nothrow_t&) noexcept {
    std::free(memory);
}

namespace nearfield::test_support {

std::uint64_t allocation_count() noexcept {
    return allocations;
}

std::uint64_t allocation_count_of_this_thread() noexcept {
    return allocations_of_this_thread;
}

FailingAllocations::FailingAllocations(std::uint64_t successes) noexcept {
    failed = false;
    successes_left = successes;
}

FailingAllocations::~FailingAllocations() {
    successes_left = UINT64_MAX;
}

bool FailingAllocations::has_failed() noexcept {
    return failed;
}

UnwatchedAllocations::UnwatchedAllocations() noexcept {
    ++unwatched;
}

UnwatchedAllocations::~UnwatchedAllocations() {
    --unwatched;
}

}  // namespace nearfield::test_support
