#include <tests/support/allocations.hpp>
#include <tests/support/mock_entry.hpp>

#include <algorithm>
#include <iterator>
#include <tuple>

/// The behaviour of entry points according to their signatures, and the table of all by name.

namespace nearfield::test_support {
namespace mock {
namespace {

template <class Tag, class... Arguments>
constexpr bool has_own = requires(Arguments... arguments) {
    perform(Tag{}, arguments...);
};

template <class Last>
constexpr bool makes_handle =
    std::is_pointer_v<Last> && !std::is_const_v<std::remove_pointer_t<Last>> &&
    VulkanHandle<std::remove_pointer_t<Last>>;

/// Commands that only a queue family that draws has; those that bind something have a bind point.
constexpr bool is_of_drawing(std::string_view call) {
    constexpr std::string_view commands[] = {"RenderPass", "vkCmdDraw",       "VertexBuffers",
                                             "vkCmdSet",   "vkCmdBeginQuery", "vkCmdEndQuery"};
    return std::any_of(std::begin(commands), std::end(commands), [call](std::string_view part) {
        return call.find(part) != std::string_view::npos;
    });
}

template <class Argument>
bool binds_for_drawing(Argument argument) {
    if constexpr (std::is_same_v<Argument, VkPipelineBindPoint>) {
        return argument == VK_PIPELINE_BIND_POINT_GRAPHICS;
    } else {
        return false;
    }
}

template <class Tag, class First, class... Rest>
auto act(First first, Rest... rest) {
    if constexpr (Tag::name.starts_with("vkCmd")) {
        if (is_of_drawing(Tag::name) || (binds_for_drawing(rest) || ...)) {
            driver().expect_drawing(Tag::name);
        }
        const MockObject* const commands = driver().find(Tag::name, first);
        if (commands != nullptr && commands->commands != MockObject::Commands::recording) {
            driver().breach(Tag::name, "a command buffer that is not being recorded");
        }
    }
    if constexpr (has_own<Tag, First, Rest...>) {
        return perform(Tag{}, first, rest...);
    } else if constexpr (Tag::name.starts_with("vkCmd")) {
        (use(Tag::name, first, rest), ...);
    } else if constexpr (Tag::name.starts_with("vkCreate")) {
        const auto& made = std::get<sizeof...(Rest) - 1>(std::tie(rest...));
        *made = driver().make<std::remove_reference_t<decltype(*made)>>(Tag::name, number(first));
        return VK_SUCCESS;
    } else {
        static_assert(Tag::name.starts_with("vkDestroy"),
                      "an entry point that needs an overload of perform()");
        driver().destroy(Tag::name, number(first), std::get<0>(std::tie(rest...)));
    }
}

/// A failing call leaves garbage in place of a new handle, except where the specification requires
/// null handles.
template <class Tag, class... Arguments>
void spoil(Arguments... arguments) {
    const auto& last = std::get<sizeof...(Arguments) - 1>(std::tie(arguments...));
    using Last = std::remove_cvref_t<decltype(last)>;
    if constexpr (makes_handle<Last>) {
        constexpr bool null = Tag::name.ends_with("Pipelines") || Tag::name.ends_with("Sets") ||
                              Tag::name.ends_with("CommandBuffers");
        if (last != nullptr) {  // otherwise it only queries the count
            *last = handle<std::remove_pointer_t<Last>>(null ? 0 : 0xBAD);
        }
    }
}

/// For any argument: handles it if it is a pointer to allocation callbacks.
template <class Argument>
void note_allocator(std::string_view call, Argument argument) {
    if constexpr (std::is_same_v<Argument, const VkAllocationCallbacks*>) {
        driver().use_allocator(call, argument);
    }
}

template <class Tag, class Function>
struct Entry;

template <class Tag, class Result, class... Arguments>
struct Entry<Tag, Result(VKAPI_PTR*)(Arguments...)> {
    static constexpr bool returns_result = std::is_same_v<Result, VkResult>;

    static Result VKAPI_CALL call(Arguments... arguments) {
        const UnwatchedAllocations here;
        [[maybe_unused]] const VkResult error = driver().enter(Tag::name);
        driver().allocator = nullptr;
        (note_allocator(Tag::name, arguments), ...);
        if constexpr (returns_result) {
            if (error != VK_SUCCESS) {
                spoil<Tag>(arguments...);
                return error;
            }
        }
        return act<Tag>(arguments...);
    }
};

struct Known {
    EntryPoint entry;
    PFN_vkVoidFunction function;
};

template <class Tag, class Function>
Known known(bool of_device) {
    using Here = Entry<Tag, Function>;
    return {{Tag::name, Here::returns_result, of_device},
            reinterpret_cast<PFN_vkVoidFunction>(&Here::call)};
}

/// The functions that the library fetches from a host's device.
const std::vector<Known>& all_known() {
    static const std::vector<Known> all{
#define NEARFIELD_OF_INSTANCE(function) known<Tag_##function, PFN_##function>(false),
#define NEARFIELD_OF_DEVICE(function) known<Tag_##function, PFN_##function>(true),
        NEARFIELD_INSTANCE_FUNCTIONS(NEARFIELD_OF_INSTANCE)
            NEARFIELD_DEBUG_FUNCTIONS(NEARFIELD_OF_INSTANCE)
                NEARFIELD_DEVICE_FUNCTIONS(NEARFIELD_OF_DEVICE)
#undef NEARFIELD_OF_INSTANCE
#undef NEARFIELD_OF_DEVICE
    };
    return all;
}

const std::vector<Known>& known_to_headless() {
    static const std::vector<Known> all{
#define NEARFIELD_OF_INSTANCE(function) known<Tag_##function, PFN_##function>(false),
        NEARFIELD_HEADLESS_FUNCTIONS(NEARFIELD_OF_INSTANCE)
#undef NEARFIELD_OF_INSTANCE
    };
    return all;
}

}  // namespace

PFN_vkVoidFunction find_entry_point(std::string_view name) {
    if (driver().hidden == name) {
        return nullptr;
    }
    for (const auto* const list : {&all_known(), &known_to_headless()}) {
        for (const Known& candidate : *list) {
            if (candidate.entry.name == name) {
                return candidate.function;
            }
        }
    }
    return nullptr;
}

}  // namespace mock

PFN_vkVoidFunction VKAPI_CALL mock_instance_function(VkInstance, const char* name) {
    const UnwatchedAllocations here;
    return mock::find_entry_point(name);
}

const std::vector<EntryPoint>& entry_points() {
    static const std::vector<EntryPoint> all = [] {
        std::vector<EntryPoint> entries;
        for (const mock::Known& known : mock::all_known()) {
            entries.push_back(known.entry);
        }
        return entries;
    }();
    return all;
}

}  // namespace nearfield::test_support
