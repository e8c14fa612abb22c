#include <tests/query/all_numbers.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/fake_loader.hpp>
#include <tests/support/vulkan_host.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

// As much as the largest element that a shader appends, a point that a search found.
constexpr VkDeviceSize guard_bytes = 16;

template <class Function>
Function driver(const char* name) {
    return reinterpret_cast<Function>(test_support::true_device_function(name));
}

/// What shaders write behind the ranges that descriptors give them. Drivers may drop such writes,
/// so the ranges that reach the driver are longer than those of the library. Entry points carry no
/// user data, so there is one.
class Guards {
public:
    static test_support::Lies lies() {
        using test_support::erased;
        state() = {};
        test_support::Lies lies;
        lies.memory = [](VkPhysicalDeviceMemoryProperties& properties) {
            state().types = properties;
        };
        lies.entry_points = {
            {"vkCreateBuffer", erased(&create)},     {"vkBindBufferMemory", erased(&bind)},
            {"vkAllocateMemory", erased(&allocate)}, {"vkFreeMemory", erased(&free)},
            {"vkMapMemory", erased(&map)},           {"vkUpdateDescriptorSets", erased(&update)},
            {"vkQueueSubmit", erased(&submit)},      {"vkWaitForFences", erased(&wait)}};
        return lies;
    }

    static int submissions() { return state().submissions; }
    static int watched() { return state().watched; }
    static int overwritten() { return state().overwritten; }

private:
    struct Place {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        VkDeviceSize offset = 0;
    };
    struct Range {
        VkBuffer buffer = VK_NULL_HANDLE;
        VkDeviceSize first = 0;
        VkDeviceSize end = 0;
    };
    using Bytes = std::array<std::byte, guard_bytes>;
    struct Guard {
        const std::byte* at = nullptr;
        Bytes before{};
    };
    struct State {
        std::map<VkBuffer, Place> places;
        VkPhysicalDeviceMemoryProperties types{};
        std::map<VkDeviceMemory, std::byte*> mapped;  ///< its first byte
        std::vector<Range> ranges;                    ///< of the coming submission
        std::vector<Guard> guards;                    ///< of that which is running
        int submissions = 0;
        int watched = 0;
        int overwritten = 0;
    };
    static State& state() {
        static State state;
        return state;
    }

    static VkResult VKAPI_CALL create(VkDevice device, const VkBufferCreateInfo* info,
                                      const VkAllocationCallbacks* allocator, VkBuffer* buffer) {
        VkBufferCreateInfo longer = *info;
        longer.size += guard_bytes;
        return driver<PFN_vkCreateBuffer>("vkCreateBuffer")(device, &longer, allocator, buffer);
    }

    static VkResult VKAPI_CALL bind(VkDevice device, VkBuffer buffer, VkDeviceMemory memory,
                                    VkDeviceSize offset) {
        state().places[buffer] = {memory, offset};
        return driver<PFN_vkBindBufferMemory>("vkBindBufferMemory")(device, buffer, memory, offset);
    }

    /// All memory that the host can see is mapped, also what the library leaves to the device.
    static VkResult VKAPI_CALL allocate(VkDevice device, const VkMemoryAllocateInfo* info,
                                        const VkAllocationCallbacks* allocator,
                                        VkDeviceMemory* memory) {
        VkResult result =
            driver<PFN_vkAllocateMemory>("vkAllocateMemory")(device, info, allocator, memory);
        const VkMemoryType& type = state().types.memoryTypes[info->memoryTypeIndex];
        if (result == VK_SUCCESS &&
            (type.propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
            void* data = nullptr;
            result =
                driver<PFN_vkMapMemory>("vkMapMemory")(device, *memory, 0, VK_WHOLE_SIZE, 0, &data);
            state().mapped[*memory] = static_cast<std::byte*>(data);
        }
        return result;
    }

    static void VKAPI_CALL free(VkDevice device, VkDeviceMemory memory,
                                const VkAllocationCallbacks* allocator) {
        state().mapped.erase(memory);
        driver<PFN_vkFreeMemory>("vkFreeMemory")(device, memory, allocator);
    }

    static VkResult VKAPI_CALL map(VkDevice /*device*/, VkDeviceMemory memory, VkDeviceSize offset,
                                   VkDeviceSize /*size*/, VkMemoryMapFlags /*flags*/, void** data) {
        *data = state().mapped.at(memory) + offset;
        return VK_SUCCESS;
    }

    static void VKAPI_CALL update(VkDevice device, std::uint32_t count,
                                  const VkWriteDescriptorSet* writes, std::uint32_t copy_count,
                                  const VkCopyDescriptorSet* copies) {
        std::vector<VkWriteDescriptorSet> longer(writes, writes + count);
        std::vector<VkDescriptorBufferInfo> buffers(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            if (longer[i].descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) {
                EXPECT_EQ(longer[i].descriptorCount, 1U);
                buffers[i] = *longer[i].pBufferInfo;
                const VkDeviceSize end = buffers[i].offset + buffers[i].range;
                state().ranges.push_back({buffers[i].buffer, buffers[i].offset, end});
                buffers[i].range += guard_bytes;
                longer[i].pBufferInfo = &buffers[i];
            }
        }
        driver<PFN_vkUpdateDescriptorSets>("vkUpdateDescriptorSets")(device, count, longer.data(),
                                                                     copy_count, copies);
    }

    static VkResult VKAPI_CALL submit(VkQueue queue, std::uint32_t count,
                                      const VkSubmitInfo* submissions, VkFence fence) {
        ++state().submissions;
        set_guards();
        return driver<PFN_vkQueueSubmit>("vkQueueSubmit")(queue, count, submissions, fence);
    }

    static VkResult VKAPI_CALL wait(VkDevice device, std::uint32_t count, const VkFence* fences,
                                    VkBool32 all, std::uint64_t timeout) {
        const VkResult result =
            driver<PFN_vkWaitForFences>("vkWaitForFences")(device, count, fences, all, timeout);
        for (const Guard& guard : state().guards) {
            state().overwritten += std::memcmp(guard.at, guard.before.data(), guard_bytes) != 0;
        }
        state().guards.clear();
        return result;
    }

    /// Behind every range of memory that the host sees, unless another range begins there.
    static void set_guards() {
        const std::vector<Range>& ranges = state().ranges;
        for (const Range& range : ranges) {
            const Place place = state().places[range.buffer];
            const auto memory = state().mapped.find(place.memory);
            const bool is_free =
                std::none_of(ranges.begin(), ranges.end(), [&](const Range& other) {
                    return other.buffer == range.buffer && other.first < range.end + guard_bytes &&
                           other.end > range.end;
                });
            if (memory != state().mapped.end() && is_free) {
                Guard guard{memory->second + place.offset + range.end};
                std::memcpy(guard.before.data(), guard.at, guard_bytes);
                state().guards.push_back(guard);
                ++state().watched;
            }
        }
        state().ranges.clear();
    }
};

/// Results of more elements than there is room for at first: shaders count them, but write none
/// behind the room.
class Room : public testing::Test {
protected:
    void SetUp() override {
        expected_.emplace(make(host_.device()));
        loader_.emplace(host_.device(), Guards::lies());
        context_.emplace(make(loader_->host()));
    }
    void TearDown() override {
        context_.reset();
        loader_.reset();
        expected_.reset();
        EXPECT_EQ(host_.close(), std::vector<std::string>{});
    }

    static Context make(const HostDevice& device) {
        Expected<Context> made = Context::create(device, on_demand());
        EXPECT_TRUE(made.has_value()) << made.error().text();
        return std::move(*made);
    }

    /// Runs a query alone; returns the number of submissions that it takes. `query(context)` has
    /// shapes of that context.
    template <class Make>
    int run(const Make& query) {
        const int before = Guards::submissions();
        const auto result = run_alone(*context_, query(*context_));
        EXPECT_TRUE(result.status.ok()) << result.status.text();
        EXPECT_GT(result.count, 4096U);
        Results found;
        Results wanted;
        found.results.emplace_back(result);
        wanted.results.emplace_back(run_alone(*expected_, query(*expected_)));
        EXPECT_EQ(all_numbers(found), all_numbers(wanted));
        return Guards::submissions() - before;
    }

    /// Of results that stay on the device, the first of so many elements says that there is no
    /// room; the next one has it.
    template <class Make>
    void expect_overflow(const Make& query) {
        for (Context* context : {&*context_, &*expected_}) {
            const auto result = run_alone(*context, query(*context));
            EXPECT_EQ(result.status.code(), StatusCode::overflow) << result.status.text();
        }
    }

    /// What earlier queries needed.
    void forget() { context_->trim(); }

    static void expect_nothing_behind() {
        EXPECT_GT(Guards::watched(), 0);
        EXPECT_EQ(Guards::overwritten(), 0);
    }

private:
    test_support::VulkanHost host_;
    std::optional<Context> expected_;
    std::optional<test_support::FakeLoader> loader_;
    std::optional<Context> context_;
};

ShapeHandle added(Context& context, const Rings& rings) {
    const Expected<ShapeHandle> shape = context.add_shape(rings);
    EXPECT_TRUE(shape.has_value()) << shape.error().text();
    return *shape;
}

/// Two squares that share about 20,000 cells. There is room for an eighth of them and 4,096 at
/// first.
IntersectionQuery squares(Context& context, Technique technique) {
    const ShapeHandle square = added(context, rectangle({0, 0}, {1, 1}));
    IntersectionQuery query{{square, {}}, {square, {}}, 0.005};
    query.technique = technique;
    return query;
}

TEST_F(Room, OfSamplesOfImages) {
    for (const IntersectionStrategy strategy :
         {IntersectionStrategy::stencil, IntersectionStrategy::blend,
          IntersectionStrategy::depth}) {
        SCOPED_TRACE(static_cast<int>(strategy));
        const auto query = [&](Context& context) {
            IntersectionQuery drawn = squares(context, Technique::raster);
            drawn.strategy = strategy;
            return drawn;
        };
        EXPECT_EQ(run(query), 2);
        EXPECT_EQ(run(query), 1);  // now it knows
        forget();
    }
    expect_nothing_behind();
}

TEST_F(Room, OfSamplesOfMasks) {
    const auto query = [](Context& context) { return squares(context, Technique::compute); };
    EXPECT_EQ(run(query), 2);
    EXPECT_EQ(run(query), 1);
    expect_nothing_behind();
}

/// A square within another one: about 10,000 points along its boundary, each of them a record.
template <class Query>
Query square_inside(Context& context) {
    const ShapeHandle a = added(context, rectangle({0, 0}, {1, 1}));
    const ShapeHandle b = added(context, rectangle({-1, -1}, {2, 2}));
    return {{a, {}}, {b, {}}, 4e-4};
}

TEST_F(Room, OfFoundPoints) {
    const auto query = [](Context& context) {
        auto searched = square_inside<PenetrationQuery>(context);
        searched.technique = Technique::compute;
        return searched;
    };
    EXPECT_GT(run(query), 1);
    EXPECT_EQ(run(query), 1);
    expect_nothing_behind();
}

TEST_F(Room, OfResidentRecords) {
    run([](Context& context) {
        auto query = square_inside<PenetrationQuery>(context);
        query.technique = Technique::compute;
        query.on_device = true;
        return query;
    });
    const auto contacts = [](Context& context) {
        auto query = square_inside<ContactQuery>(context);
        query.contact_distance = 2.0;  // of both boundaries
        query.technique = Technique::compute;
        query.on_device = true;
        return query;
    };
    expect_overflow(contacts);
    run(contacts);
    expect_nothing_behind();
}

TEST_F(Room, OfResidentSamples) {
    for (const bool stored : {true, false}) {
        SCOPED_TRACE(stored);
        run([&](Context& context) {
            IntersectionQuery query = squares(context, Technique::compute);
            query.on_device = true;
            query.samples_on_device = stored;
            return query;
        });
    }
    expect_nothing_behind();
}

}  // namespace
}  // namespace nearfield::test
