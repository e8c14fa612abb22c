#include <engine/gpu/functions.hpp>

#include <tests/support/allocations.hpp>
#include <tests/support/watched_loader.hpp>

#include <type_traits>
#include <utility>

namespace nearfield::test_support {
namespace {

std::function<void(const WatchedCall&)> watcher;

/// Handles are pointers; created handles are returned through a pointer to one.
template <class Argument>
constexpr bool is_result =
    std::is_pointer_v<Argument>&& std::is_pointer_v<std::remove_pointer_t<Argument>> &&
    !std::is_const_v<std::remove_pointer_t<Argument>> &&
    !std::is_void_v<std::remove_pointer_t<std::remove_pointer_t<Argument>>>;

template <class Argument>
void note(WatchedCall& call, Argument argument) {
    if constexpr (std::is_same_v<Argument, const VkAllocationCallbacks*>) {
        call.takes_allocator = true;
        call.allocator = argument;
    } else if constexpr (std::is_same_v<Argument, VkPipelineCache>) {
        call.pipeline_cache = argument;
    } else if constexpr (is_result<Argument>) {
        call.made = reinterpret_cast<std::uint64_t>(*argument);
    }
}

/// Intercepts the library's calls of one entry point; `Tag` distinguishes entry points of the same
/// type.
template <class Tag, class Function>
struct Watched;

template <class Tag, class Result, class... Arguments>
struct Watched<Tag, Result(VKAPI_PTR*)(Arguments...)> {
    static inline Result(VKAPI_PTR* below)(Arguments...) = nullptr;

    static Result VKAPI_CALL call(Arguments... arguments) {
        const std::uint64_t before = allocation_count_of_this_thread();
        const auto watch = [&] {
            WatchedCall seen;
            seen.name = Tag::name;
            seen.allocations = allocation_count_of_this_thread() - before;
            (note(seen, arguments), ...);
            watcher(seen);
        };
        if constexpr (std::is_void_v<Result>) {
            below(arguments...);
            watch();
        } else {
            const Result result = below(arguments...);
            watch();
            return result;
        }
    }
};

#define NEARFIELD_WATCHED_TAG(function)                \
    struct WatchedTag_##function {                     \
        static constexpr const char* name = #function; \
    };
NEARFIELD_DEVICE_FUNCTIONS(NEARFIELD_WATCHED_TAG)
NEARFIELD_DEBUG_FUNCTIONS(NEARFIELD_WATCHED_TAG)
#undef NEARFIELD_WATCHED_TAG

template <class Tag, class Function>
void watch_one(const HostDevice& host, Lies& lies) {
    using Here = Watched<Tag, Function>;
    Here::below = reinterpret_cast<Function>(host.get_instance_proc_addr(host.instance, Tag::name));
    if (Here::below != nullptr) {
        lies.entry_points[Tag::name] = reinterpret_cast<PFN_vkVoidFunction>(&Here::call);
    }
}

}  // namespace

Lies watched(const HostDevice& host, std::function<void(const WatchedCall&)> watch) {
    watcher = std::move(watch);
    Lies lies;
#define NEARFIELD_WATCH(function) watch_one<WatchedTag_##function, PFN_##function>(host, lies);
    NEARFIELD_DEVICE_FUNCTIONS(NEARFIELD_WATCH)
    NEARFIELD_DEBUG_FUNCTIONS(NEARFIELD_WATCH)
#undef NEARFIELD_WATCH
    return lies;
}

}  // namespace nearfield::test_support
