#pragma once

#include <nearfield/world.hpp>

#include <tests/driver/world.hpp>

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace nearfield::test {

/// A nearfield::World on the mock driver, which has the device asked about its instances in steps.
class DeviceWorld {
public:
    enum class Step {
        first,   ///< makes all
        moved,   ///< makes nothing
        larger,  ///< more of everything, and a larger shape
    };
    static constexpr Step steps[] = {Step::first, Step::moved, Step::larger};

    /// `storage_range`: how much of a buffer shaders reach.
    explicit DeviceWorld(std::uint32_t storage_range = 1U << 30U);
    virtual ~DeviceWorld() = default;
    DeviceWorld(const DeviceWorld&) = delete;
    DeviceWorld& operator=(const DeviceWorld&) = delete;

    [[nodiscard]] test_support::MockDriver& driver() { return life_.driver(); }
    /// Has the device answer. The second half of submit().
    [[nodiscard]] virtual Status ask() = 0;
    /// Lets the device begin.
    [[nodiscard]] virtual Status submit() = 0;

    /// Asks in all steps before this one, and changes what the host changes before it.
    void ask_all_before(Step step);
    virtual void expect_to_work();
    /// After a failure.
    virtual void expect_nothing() const {}
    void expect_an_answering_context();
    void expect_to_be_lost();
    void expect_to_leave_nothing();

protected:
    [[nodiscard]] World& life() { return life_; }
    [[nodiscard]] nearfield::World& world() { return *world_; }
    [[nodiscard]] ShapeHandle shape() const { return shape_; }
    /// Instances of a regular polygon.
    void add(int count, int corners);

private:
    /// Before the last step.
    virtual void enlarge() = 0;
    /// Destroys what was submitted.
    virtual void forget() = 0;
    void prepare(Step step);

    World life_{Technique::compute};
    std::optional<nearfield::World> world_;
    ShapeHandle shape_;
    std::vector<InstanceHandle> instances_;
};

using MakeDeviceWorld = std::function<std::unique_ptr<DeviceWorld>()>;

/// Has each call of each step fail with each of its errors: the status names it, nothing leaks, and
/// everything works afterwards. `check(step, count)` is given how often each call was made.
void expect_to_survive_failing_calls(
    const MakeDeviceWorld& make,
    const std::function<void(DeviceWorld::Step, std::map<std::string_view, std::size_t>&)>& check);

/// Has each allocation of each step fail, likewise.
void expect_to_survive_scarce_memory(const MakeDeviceWorld& make);

}  // namespace nearfield::test
