#include <tests/support/mock_driver_state.hpp>

#include <algorithm>
#include <initializer_list>

namespace nearfield::test_support {
namespace {

bool starts_with_any(std::string_view call, std::initializer_list<std::string_view> beginnings) {
    return std::any_of(beginnings.begin(), beginnings.end(),
                       [call](std::string_view beginning) { return call.starts_with(beginning); });
}

/// True for entry points that report a lost device.
bool says_loss(std::string_view call) {
    return call == "vkQueueSubmit" || call == "vkWaitForFences" || call == "vkGetFenceStatus" ||
           call == "vkGetQueryPoolResults";
}

}  // namespace

VkResult MockDriver::State::enter(std::string_view call) {
    calls.push_back(call);
    if (lost && !starts_with_any(call, {"vkDestroy", "vkFree", "vkWait"})) {
        work_after_loss.emplace_back(call);
    }
    if (lost && says_loss(call)) {
        return VK_ERROR_DEVICE_LOST;
    }
    if (call != failing) {
        return VK_SUCCESS;
    }
    if (successes_left > 0) {
        --successes_left;
        return VK_SUCCESS;
    }
    has_failed = true;
    lost = lost || (error == VK_ERROR_DEVICE_LOST && says_loss(call));
    if (how == Failing::once) {
        failing.clear();
    } else if (how == Failing::twice) {
        how = Failing::once;
    }
    return error;
}

void MockDriver::State::breach(std::string_view call, const std::string& what) {
    breaches.push_back(std::string(call) + ": " + what);
}

void MockDriver::State::make(std::string_view call, Number parent, const std::type_info& type) {
    MockObject& object = objects[++last];
    object.made_by = call;
    object.type = &type;
    object.parent = parent;
    if (allocator != nullptr) {
        constexpr std::size_t bytes = 16;
        object.host_memory = allocator->pfnAllocation(allocator->pUserData, bytes, alignof(void*),
                                                      VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
    }
}

MockObject* MockDriver::State::find(std::string_view call, Number wanted,
                                    const std::type_info& type) {
    const auto found = objects.find(wanted);
    if (found == objects.end()) {
        breach(call, "a handle of nothing that is there");
        return nullptr;
    }
    if (*found->second.type != type) {
        breach(call, "a handle of another type, made by " + std::string(found->second.made_by));
        return nullptr;
    }
    return &found->second;
}

void MockDriver::State::expect_unused(std::string_view call, Number wanted) {
    if (lost) {
        return;  // nothing is executing any more
    }
    for (const auto& [fence, object] : objects) {
        if (object.in_use.contains(wanted)) {
            breach(call, "a submission still uses what " + std::string(objects[wanted].made_by) +
                             " made");
        }
    }
}

void MockDriver::State::destroy(std::string_view call, Number device_of_call, Number gone,
                                const std::type_info& type) {
    if (gone == 0) {
        return;
    }
    const MockObject* const object = find(call, gone, type);
    if (object == nullptr) {
        return;
    }
    if (object->parent != device_of_call) {
        breach(call, "an object of another parent");
    }
    if (!object->in_use.empty() && !lost) {
        breach(call, "a fence of a submission that is not done");
    }
    expect_unused(call, gone);
    std::vector<Number> children;
    for (const auto& [child, other] : objects) {
        if (other.parent == gone) {
            children.push_back(child);
        }
    }
    for (const Number child : children) {
        expect_unused(call, child);
        objects.erase(child);
    }
    if (allocator != nullptr) {
        allocator->pfnFree(allocator->pUserData, object->host_memory);
    }
    objects.erase(gone);
}

void MockDriver::State::expect_drawing(std::string_view call) {
    if ((families[family] & VK_QUEUE_GRAPHICS_BIT) == 0) {
        breach(call, "something of drawing, on a queue family that does not");
    }
}

void MockDriver::State::expect_families(std::string_view call, VkSharingMode mode,
                                        std::span<const std::uint32_t> shared_by) {
    if (mode != VK_SHARING_MODE_CONCURRENT) {
        return;
    }
    ++shared_objects;
    const std::set<std::uint32_t> different(shared_by.begin(), shared_by.end());
    if (different.size() != shared_by.size() || different.size() < 2 ||
        *different.rbegin() >= families.size() || !different.contains(family)) {
        breach(call, "families that cannot share it");
    }
}

void MockDriver::State::expect_childless(std::string_view call, Number parent) {
    for (const auto& [number, object] : objects) {
        if (object.parent == parent) {
            breach(call, "what " + std::string(object.made_by) + " made is still there");
        }
    }
}

void MockDriver::State::add_needs(Number wanted, std::set<Number>& all) const {
    const auto found = objects.find(wanted);
    if (found == objects.end() || !all.insert(wanted).second) {
        return;
    }
    for (const auto& [place, needed] : found->second.needs) {
        add_needs(needed, all);
    }
}

void MockDriver::State::finish(MockObject& fence) {
    for (const Number used : fence.in_use) {
        const auto found = objects.find(used);
        if (found != objects.end() && found->second.commands == MockObject::Commands::pending) {
            found->second.commands = MockObject::Commands::executable;
        }
    }
    fence.in_use.clear();
}

void MockDriver::State::change(std::string_view call, Number commands, MockObject::Commands from,
                               MockObject::Commands to) {
    MockObject* const object = find(call, commands, typeid(VkCommandBuffer));
    if (object != nullptr && object->commands != from) {
        breach(call, "a command buffer in another state");
    } else if (object != nullptr) {
        object->commands = to;
    }
}

void MockDriver::State::execute(std::string_view call, Number commands, std::set<Number>& used) {
    change(call, commands, MockObject::Commands::executable, MockObject::Commands::pending);
    for (const auto& [place, needed] : objects[commands].needs) {
        if (!objects.contains(needed)) {
            breach(call, "commands refer to something that is gone");
        }
    }
    add_needs(commands, used);
    write_results(commands, used);
}

/// Writes the results of commands to their buffers. Counts that the host set to 0 stay 0, except
/// those that shaders are to find.
void MockDriver::State::write_results(Number commands, const std::set<Number>& used) {
    for (const Number number_used : used) {
        const MockObject& buffer = objects[number_used];
        if (!buffer.written || !buffer.bound) {
            continue;
        }
        for (std::uint32_t& word : words_of(number_used)) {
            word = word == 0 ? 0 : MockDriver::device_word;
        }
    }
    write_counts(used);
    for (const MockWrite& one : objects[commands].writes) {
        write(one);
    }
}

void MockDriver::State::write_counts(const std::set<Number>& used) {
    std::vector<std::span<std::uint32_t>> all;
    for (const Number number_used : used) {
        const MockObject& set = objects[number_used];
        const auto range = finding ? set.ranges.find(finding->binding) : set.ranges.end();
        if (range == set.ranges.end()) {
            continue;
        }
        const auto [first, count] = range->second;
        const std::span words = words_of(set.needs.at(finding->binding));
        if (words.empty()) {
            continue;
        }
        const bool is_known = std::any_of(all.begin(), all.end(), [&](const auto& other) {
            return other.data() == words.data() + first;
        });
        if (!is_known && first + finding->word < words.size() && words[first] == 0) {
            all.push_back(words.subspan(first, std::min(count, words.size() - first)));
        }
    }
    for (const std::span<std::uint32_t> found : all) {
        std::fill(found.begin(), found.end(), 0);
        found[finding->word] =
            finding->count / (finding->is_divided ? static_cast<std::uint32_t>(all.size()) : 1);
    }
}

std::span<std::uint32_t> MockDriver::State::words_of(Number buffer) {
    const auto found = objects.find(buffer);
    // Objects of the host have memory that the driver does not see.
    if (found == objects.end() || !found->second.bound || !found->second.needs.contains(0)) {
        return {};
    }
    MockObject& memory = objects[found->second.needs.at(0)];
    if (memory.words.empty()) {
        memory.content.resize(memory.bytes);
        memory.words = {reinterpret_cast<std::uint32_t*>(memory.content.data()),
                        memory.bytes / sizeof(std::uint32_t)};
        std::fill(memory.words.begin(), memory.words.end(), MockDriver::resident_word);
    }
    return memory.words.subspan(found->second.offset / sizeof(std::uint32_t),
                                found->second.bytes / sizeof(std::uint32_t));
}

void MockDriver::State::write(const MockWrite& write) {
    const std::span words = words_of(write.buffer);
    if (write.first_word + write.words > words.size()) {
        return;  // reported when recorded
    }
    const auto begin = words.begin() + static_cast<std::ptrdiff_t>(write.first_word);
    if (write.from == 0) {
        std::fill_n(begin, write.words, write.value);
        return;
    }
    const std::span source = words_of(write.from);
    if (write.first_word_from + write.words <= source.size()) {
        std::copy_n(source.begin() + static_cast<std::ptrdiff_t>(write.first_word_from),
                    write.words, begin);
    }
}

}  // namespace nearfield::test_support
