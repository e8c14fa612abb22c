#include <tests/support/allocations.hpp>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> allocations{0};
thread_local std::uint64_t allocations_of_this_thread = 0;

void* allocate(std::size_t size) noexcept {
    ++allocations;
    ++allocations_of_this_thread;
    return std::malloc(size == 0 ? 1 : size);
}

}  // namespace

void* operator new(std::size_t size) {
    if (void* const memory = allocate(size)) {
        return memory;
    }
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

}  // namespace nearfield::test_support
