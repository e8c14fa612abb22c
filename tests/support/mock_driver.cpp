#include <tests/support/allocations.hpp>
#include <tests/support/mock_driver.hpp>
#include <tests/support/mock_driver_state.hpp>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace nearfield::test_support {

MockDriver::State* mock_driver = nullptr;

namespace {

constexpr std::string_view the_host = "the host";

MockDriver::State& state_of(void* user) {
    return *static_cast<MockDriver::State*>(user);
}

void* VKAPI_CALL host_allocate(void* user, std::size_t bytes, std::size_t,
                               VkSystemAllocationScope) {
    void* const block = std::malloc(bytes);
    state_of(user).host_blocks.insert(block);
    return block;
}

void VKAPI_CALL host_free(void* user, void* block) {
    if (block != nullptr && state_of(user).host_blocks.erase(block) == 0) {
        state_of(user).breach("vkFree", "a block that the host's allocator did not give out");
    }
    std::free(block);
}

bool starts_with_any(std::string_view call, std::initializer_list<std::string_view> beginnings) {
    return std::any_of(beginnings.begin(), beginnings.end(),
                       [call](std::string_view beginning) { return call.starts_with(beginning); });
}

/// Entry points that say so where the device is lost.
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
    }
    return error;
}

void MockDriver::State::breach(std::string_view call, const std::string& what) {
    breaches.push_back(std::string(call) + ": " + what);
}

void MockDriver::State::use_allocator(std::string_view call, const VkAllocationCallbacks* used) {
    if (used == nullptr || used->pUserData != this || used->pfnAllocation != &host_allocate ||
        used->pfnFree != &host_free) {
        breach(call, "not the host's allocation callbacks");
        return;
    }
    allocator = used;
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
        return;  // nothing is at work any more
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

/// What commands leave in the buffers that they write. Counts that the host set to 0 stay 0.
void MockDriver::State::write_results(Number commands, const std::set<Number>& used) {
    for (const Number number_used : used) {
        const MockObject& buffer = objects[number_used];
        if (!buffer.written || !buffer.bound) {
            continue;
        }
        for (std::uint32_t& word : objects[buffer.needs.at(0)].words) {
            word = word == 0 ? 0 : MockDriver::device_word;
        }
    }
    for (const MockFill& fill : objects[commands].fills) {
        const auto buffer = objects.find(fill.buffer);
        if (buffer == objects.end() || !buffer->second.bound) {
            continue;
        }
        const std::span words = objects[buffer->second.needs.at(0)].words;
        if (fill.first_word + fill.words <= words.size()) {  // else it is not mapped
            std::fill_n(words.begin() + static_cast<std::ptrdiff_t>(fill.first_word), fill.words,
                        fill.value);
        }
    }
}

MockDriver::MockDriver() : state_(std::make_unique<State>()) {
    if (mock_driver != nullptr) {
        throw std::logic_error("there is a mock driver already");
    }
    state_->instance = ++state_->last;
    state_->physical_device = ++state_->last;
    state_->device = ++state_->last;
    state_->queue = ++state_->last;
    state_->make<VkFence>(the_host, state_->device);
    state_->host_fence = state_->last;
    state_->callbacks.pUserData = state_.get();
    state_->callbacks.pfnAllocation = &host_allocate;
    state_->callbacks.pfnFree = &host_free;
    mock_driver = state_.get();
}

MockDriver::~MockDriver() {
    mock_driver = nullptr;
}

HostDevice MockDriver::host() const {
    HostDevice host;
    host.instance = handle<VkInstance>(state_->instance);
    host.physical_device = handle<VkPhysicalDevice>(state_->physical_device);
    host.device = handle<VkDevice>(state_->device);
    host.queue = handle<VkQueue>(state_->queue);
    host.get_instance_proc_addr = &mock_instance_function;
    host.debug_utils = true;
    host.logic_op = true;
    host.allocator = &state_->callbacks;
    return host;
}

VkSemaphore MockDriver::make_semaphore(bool signalled) {
    const UnwatchedAllocations here;
    const auto semaphore = state_->make<VkSemaphore>(the_host, state_->device);
    state_->objects[number(semaphore)].signalled = signalled;
    return semaphore;
}

bool MockDriver::is_signalled(VkSemaphore semaphore) const {
    return state_->objects.at(number(semaphore)).signalled;
}

VkCommandBuffer MockDriver::begin_commands() {
    const UnwatchedAllocations here;
    const auto commands = state_->make<VkCommandBuffer>(the_host, state_->device);
    state_->objects[number(commands)].commands = MockObject::Commands::recording;
    return commands;
}

void MockDriver::submit(VkCommandBuffer commands) {
    const UnwatchedAllocations here;
    if (state_->lost) {
        return;
    }
    state_->change(the_host, number(commands), MockObject::Commands::recording,
                   MockObject::Commands::executable);
    state_->execute(the_host, number(commands), state_->objects[state_->host_fence].in_use);
}

void MockDriver::finish_submissions() {
    const UnwatchedAllocations here;
    state_->finish(state_->objects[state_->host_fence]);
}

const std::vector<std::string_view>& MockDriver::calls() const {
    return state_->calls;
}

void MockDriver::forget_calls() {
    state_->calls.clear();
}

void MockDriver::fail(std::string_view call, std::size_t successes, VkResult result,
                      Failing failing) {
    state_->failing = call;
    state_->successes_left = successes;
    state_->error = result;
    state_->how = failing;
    state_->has_failed = false;
}

void MockDriver::work_again() {
    state_->failing.clear();
}

void MockDriver::hide(std::string_view call) {
    state_->hidden = call;
}

bool MockDriver::has_failed() const {
    return state_->has_failed;
}

std::vector<std::string> MockDriver::alive() const {
    std::vector<std::string> names;
    for (const auto& [number, object] : state_->objects) {
        if (object.made_by != the_host) {
            names.emplace_back(object.made_by);
        }
    }
    names.insert(names.end(), state_->host_blocks.size(), "the host's allocator");
    return names;
}

const std::vector<std::string>& MockDriver::breaches() const {
    return state_->breaches;
}

const std::vector<std::string>& MockDriver::work_after_loss() const {
    return state_->work_after_loss;
}

}  // namespace nearfield::test_support
