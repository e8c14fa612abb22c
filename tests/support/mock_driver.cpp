#include <tests/support/allocations.hpp>
#include <tests/support/mock_driver.hpp>
#include <tests/support/mock_driver_state.hpp>

#include <algorithm>
#include <stdexcept>

namespace nearfield::test_support {

MockDriver::State* mock_driver = nullptr;

namespace {

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

MockDriver::MockDriver() : state_(std::make_unique<State>()) {
    if (mock_driver != nullptr) {
        throw std::logic_error("there is a mock driver already");
    }
    state_->instance = ++state_->last;
    state_->physical_device = ++state_->last;
    state_->device = ++state_->last;
    state_->queue = ++state_->last;
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
    return host;
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
        names.emplace_back(object.made_by);
    }
    return names;
}

const std::vector<std::string>& MockDriver::breaches() const {
    return state_->breaches;
}

const std::vector<std::string>& MockDriver::work_after_loss() const {
    return state_->work_after_loss;
}

}  // namespace nearfield::test_support
