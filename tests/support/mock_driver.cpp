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

/// No driver of this kind requests a reallocation.
void* VKAPI_CALL host_reallocate(void* user, void*, std::size_t, std::size_t,
                                 VkSystemAllocationScope) {
    state_of(user).breach("vkReallocation", "memory that the driver wants larger");
    return nullptr;
}

void VKAPI_CALL host_free(void* user, void* block) {
    if (block != nullptr && state_of(user).host_blocks.erase(block) == 0) {
        state_of(user).breach("vkFree", "a block that the host's allocator did not give out");
    }
    std::free(block);
}

}  // namespace

void MockDriver::State::use_allocator(std::string_view call, const VkAllocationCallbacks* used) {
    if (headless) {
        if (used != nullptr) {
            breach(call, "allocation callbacks where there is no host");
        }
        return;
    }
    if (used == nullptr || used->pUserData != this || used->pfnAllocation != &host_allocate ||
        used->pfnFree != &host_free) {
        breach(call, "not the host's allocation callbacks");
        return;
    }
    allocator = used;
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
    state_->callbacks.pfnReallocation = &host_reallocate;
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
    host.queue_family = state_->family;
    host.get_instance_proc_addr = &mock_instance_function;
    host.debug_utils = true;
    host.logic_op = true;
    host.timeline_semaphore = state_->timeline_semaphores;
    host.allocator = &state_->callbacks;
    return host;
}

void MockDriver::set_queue_families(std::vector<VkQueueFlags> families, std::uint32_t used) {
    state_->families = std::move(families);
    state_->family = used;
}

void MockDriver::set_device_type(VkPhysicalDeviceType type) {
    state_->device_type = type;
}

void MockDriver::set_storage_range(std::uint32_t bytes) {
    state_->storage_range = bytes;
}

std::size_t MockDriver::shared_objects() const {
    return state_->shared_objects;
}

void MockDriver::go_without_host() {
    state_->headless = true;
}

VkSemaphore MockDriver::make_semaphore(bool signalled) {
    const UnwatchedAllocations here;
    const auto semaphore = state_->make<VkSemaphore>(the_host, state_->device);
    state_->objects[number(semaphore)].signalled = signalled;
    return semaphore;
}

VkImage MockDriver::make_image() {
    const UnwatchedAllocations here;
    const auto image = state_->make<VkImage>(the_host, state_->device);
    state_->objects[number(image)].bound = true;
    return image;
}

VkImageView MockDriver::make_view(VkImage image) {
    const UnwatchedAllocations here;
    const auto view = state_->make<VkImageView>(the_host, state_->device);
    state_->objects[number(view)].needs[0] = number(image);
    return view;
}

VkBuffer MockDriver::make_buffer(std::uint64_t bytes) {
    const UnwatchedAllocations here;
    const auto buffer = state_->make<VkBuffer>(the_host, state_->device);
    MockObject& object = state_->objects[number(buffer)];
    object.bound = true;
    object.bytes = bytes;
    object.written = bytes > 0;
    return buffer;
}

/// Objects of the host have memory that the driver does not see.
bool MockDriver::has_memory(std::uint64_t object) const {
    const auto found = state_->objects.find(object);
    if (found == state_->objects.end() || !found->second.bound) {
        return false;
    }
    const auto memory = found->second.needs.find(0);
    return memory == found->second.needs.end() || state_->objects.contains(memory->second);
}

bool MockDriver::has_memory(VkBuffer buffer, std::uint64_t offset, std::uint64_t bytes) const {
    return has_memory(number(buffer)) && offset + bytes <= state_->objects.at(number(buffer)).bytes;
}

bool MockDriver::has_memory(VkImage image, VkImageView view) const {
    const auto found = state_->objects.find(number(view));
    return has_memory(number(image)) && found != state_->objects.end() &&
           found->second.needs.at(0) == number(image);
}

bool MockDriver::is_signalled(VkSemaphore semaphore) const {
    return state_->objects.at(number(semaphore)).signalled;
}

void MockDriver::enable_timeline_semaphores(bool enabled) {
    state_->timeline_semaphores = enabled;
}

VkSemaphore MockDriver::make_timeline_semaphore(std::uint64_t value) {
    const UnwatchedAllocations here;
    const auto semaphore = state_->make<VkSemaphore>(the_host, state_->device);
    state_->objects[number(semaphore)].value = value;
    return semaphore;
}

std::uint64_t MockDriver::value_of(VkSemaphore semaphore) const {
    return state_->objects.at(number(semaphore)).value.value();
}

const std::vector<MockDriver::Submitted>& MockDriver::submissions() const {
    return state_->submissions;
}

void MockDriver::let_shaders_find(const Finding& finding) {
    state_->finding = finding;
}

VkCommandBuffer MockDriver::begin_commands() {
    const UnwatchedAllocations here;
    state_->allocator = nullptr;  // that was the last call's
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
