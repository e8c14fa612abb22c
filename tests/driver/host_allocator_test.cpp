#include <gtest/gtest.h>
#include <tests/driver/world.hpp>
#include <tests/support/driver_errors.hpp>
#include <tests/support/fake_loader.hpp>
#include <tests/support/host_allocator.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

using test_support::HostAllocator;
using test_support::MockDriver;
using test_support::name_of;

/// A world whose device memory comes from the host.
struct Hosted {
    explicit Hosted(Technique technique) : world(technique), allocator(world.driver().host()) {
        world.use_memory(allocator.functions());
    }
    ~Hosted() { static_cast<void>(world.take(World::Step::destroy)); }
    Hosted(const Hosted&) = delete;
    Hosted& operator=(const Hosted&) = delete;

    [[nodiscard]] std::size_t calls(std::string_view name) {
        const auto& calls = world.driver().calls();
        return static_cast<std::size_t>(std::count(calls.begin(), calls.end(), name));
    }
    void expect_to_leave_nothing() {
        EXPECT_TRUE(world.take(World::Step::destroy).ok());
        EXPECT_TRUE(allocator.given().empty());
        EXPECT_EQ(allocator.mistakes(), std::vector<std::string>{});
        allocator.close();
        EXPECT_EQ(world.driver().alive(), std::vector<std::string>{});
        EXPECT_EQ(world.driver().breaches(), std::vector<std::string>{});
    }

    World world;
    HostAllocator allocator;
};

TEST(HostDeviceMemory, IsAllThereIsAndGoesBack) {
    for (const Technique technique : device_techniques) {
        SCOPED_TRACE(to_string(technique));
        const std::vector<double> expected = World::undisturbed(technique);
        Hosted hosted(technique);
        hosted.world.take_all_before(World::Step::record_last);
        EXPECT_GT(hosted.allocator.given().size(), 10U);
        EXPECT_EQ(hosted.calls("vkAllocateMemory"), hosted.allocator.allocations());
        EXPECT_LE(hosted.calls("vkMapMemory"), hosted.allocator.allocations());
        EXPECT_FALSE(hosted.allocator.gaps_are_written());
        std::vector<double> numbers;
        EXPECT_TRUE(hosted.world.answer(numbers).ok());
        EXPECT_EQ(numbers, expected);
        hosted.expect_to_leave_nothing();
    }
}

TEST(HostDeviceMemory, IsCountedAndTrimmed) {
    Hosted hosted(device_techniques.front());
    hosted.world.take_all_before(World::Step::submit_last);
    Context& context = hosted.world.context();
    const std::uint64_t in_use = hosted.allocator.bytes();
    EXPECT_EQ(context.memory_use().in_use, in_use);
    EXPECT_GE(context.memory_use().peak, in_use);
    context.trim();
    EXPECT_LT(hosted.allocator.bytes(), in_use / 4);
    EXPECT_EQ(context.memory_use().in_use, hosted.allocator.bytes());
    std::vector<double> numbers;
    EXPECT_TRUE(hosted.world.answer(numbers).ok());
    EXPECT_EQ(context.memory_use().in_use, hosted.allocator.bytes());
    hosted.expect_to_leave_nothing();
}

/// The ranges flushed and invalidated, and the allocator that gave their memory.
HostAllocator* allocator_of_ranges = nullptr;
std::vector<const HostAllocator::Piece*> pieces_of_ranges;

VkResult VKAPI_CALL note_ranges(VkDevice, std::uint32_t count, const VkMappedMemoryRange* ranges) {
    for (std::uint32_t i = 0; i < count; ++i) {
        EXPECT_EQ(ranges[i].offset % 64, 0U);
        EXPECT_EQ(ranges[i].size % 64, 0U);
        pieces_of_ranges.push_back(
            allocator_of_ranges->find(ranges[i].memory, ranges[i].offset, ranges[i].size));
    }
    return VK_SUCCESS;
}

TEST(HostDeviceMemory, IsFlushedWithinItsPiecesWhereItIsNotCoherent) {
    Hosted hosted(Technique::compute);
    allocator_of_ranges = &hosted.allocator;
    pieces_of_ranges.clear();
    HostDevice host = hosted.world.driver().host();
    host.memory = hosted.allocator.functions();
    test_support::Lies lies;
    for (const char* const name : {"vkFlushMappedMemoryRanges", "vkInvalidateMappedMemoryRanges"}) {
        lies.entry_points[name] = reinterpret_cast<PFN_vkVoidFunction>(&note_ranges);
    }
    const test_support::FakeLoader loader(host, lies);
    {
        Expected<Context> context = Context::create(loader.host());
        ASSERT_TRUE(context.has_value()) << context.error().text();
        const std::vector<Ring> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        const Expected<ShapeHandle> shape = context->add_shape(square);
        ASSERT_TRUE(shape.has_value());
        Batch batch;
        IntersectionQuery query{{*shape, {}}, {*shape, {{0.5, 0.5}, 0.1}}, 0.01};
        query.technique = Technique::compute;
        batch.add(query);
        Results results;
        EXPECT_TRUE(context->run(batch, results).ok());
    }
    EXPECT_GE(pieces_of_ranges.size(), 3U);
    for (const HostAllocator::Piece* const piece : pieces_of_ranges) {
        EXPECT_NE(piece, nullptr) << "a range beyond what was given";
    }
    hosted.expect_to_leave_nothing();
}

/// A way in which a host's allocator can fail, and the words by which it is named.
struct Mistake {
    const char* words;
    StatusCode code = StatusCode::invalid_settings;
    std::function<VkResult(const MemoryRequest&, MemoryAllocation&)> make;
    bool only_mapped = false;
};

std::vector<Mistake> all_mistakes() {
    const auto error = [](VkResult result, StatusCode code) {
        return Mistake{name_of(result), code,
                       [result](const MemoryRequest&, MemoryAllocation&) { return result; }};
    };
    const auto bad = [](const char* words, auto change, bool only_mapped = false) {
        return Mistake{words, StatusCode::invalid_settings,
                       [change](const MemoryRequest& request, MemoryAllocation& given) {
                           change(request, given);
                           return VK_SUCCESS;
                       },
                       only_mapped};
    };
    return {
        error(VK_ERROR_OUT_OF_DEVICE_MEMORY, StatusCode::out_of_memory),
        error(VK_ERROR_OUT_OF_HOST_MEMORY, StatusCode::out_of_memory),
        error(VK_ERROR_TOO_MANY_OBJECTS, StatusCode::device_error),
        {"returned VK_INCOMPLETE", StatusCode::invalid_settings,
         [](const MemoryRequest&, MemoryAllocation&) { return VK_INCOMPLETE; }},
        bad("memory is null", [](const auto&, auto& given) { given.memory = VK_NULL_HANDLE; }),
        bad("memory_type is 77, which is not among the allowed types",
            [](const auto&, auto& given) { given.memory_type = 77; }),
        bad(
            "memory_type is 0, which is not among the allowed types 6 (bit mask)",
            [](const auto&, auto& given) { given.memory_type = 0; }, true),
        bad("which is not a multiple of the alignment",
            [](const auto& request, auto& given) {
                given.offset += request.requirements.alignment / 2;
            }),
        bad(
            "mapped is null", [](const auto&, auto& given) { given.mapped = nullptr; }, true),
        bad(
            "mapped is no multiple of 64",
            [](const auto&, auto& given) {
                given.mapped = static_cast<std::byte*>(given.mapped) + 32;
            },
            true),
    };
}

/// Makes one answer of the allocator in a step wrong, and the first answer when the step is tried
/// again; returns whether there was such an answer.
bool try_mistake(Technique technique, const Mistake& mistake, World::Step step, std::size_t number,
                 const std::vector<double>& expected) {
    Hosted hosted(technique);
    hosted.world.take_all_before(step);
    std::size_t left = number;
    bool made = false;
    std::string name;
    hosted.allocator.bend = [&](const MemoryRequest& request, MemoryAllocation& given) {
        const bool mapped = (request.required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0;
        if (made || (mistake.only_mapped && !mapped) || left-- > 0) {
            return VK_SUCCESS;
        }
        made = true;
        name = request.name;
        return mistake.make(request, given);
    };
    for (const bool is_again : {false, true}) {
        made = false;
        left = is_again ? 0 : number;
        const Status status = hosted.world.take(step);
        if (!made) {
            EXPECT_FALSE(is_again) << "what was refused is not asked for again";
            hosted.expect_to_leave_nothing();
            return false;
        }
        EXPECT_EQ(status.code(), mistake.code) << status.text();
        for (const std::string& words :
             {std::string(mistake.words), name, std::string("HostDevice::memory.allocate")}) {
            EXPECT_NE(status.message().find(words), std::string::npos) << status.text();
        }
    }
    if (hosted.world.has_context()) {
        const Status again = hosted.world.take(step);
        EXPECT_TRUE(again.ok()) << again.text();
        std::vector<double> numbers;
        const Status next = hosted.world.answer(numbers);
        EXPECT_TRUE(next.ok()) << next.text();
        EXPECT_EQ(numbers, expected);
    }
    hosted.expect_to_leave_nothing();
    return true;
}

TEST(HostDeviceMemory, ThatIsRefusedOrContradictsTheRequestIsNamedAndLeaksNothing) {
    for (const Technique technique : device_techniques) {
        const std::vector<double> expected = World::undisturbed(technique);
        // The first mistake is made in every answer of a step, the others in the first few.
        std::size_t answers = SIZE_MAX;
        for (const Mistake& mistake : all_mistakes()) {
            std::size_t tried = 0;
            for (const World::Step step : {World::Step::submit_first, World::Step::submit_larger,
                                           World::Step::record, World::Step::record_last}) {
                for (std::size_t number = 0; number < answers; ++number) {
                    SCOPED_TRACE(::testing::Message()
                                 << to_string(technique) << ": " << mistake.words << " as answer "
                                 << number << " in: " << to_string(step));
                    if (!try_mistake(technique, mistake, step, number, expected)) {
                        break;
                    }
                    ASSERT_FALSE(::testing::Test::HasFailure());
                    ++tried;
                }
            }
            EXPECT_GT(tried, 5U) << mistake.words;
            answers = 3;
        }
    }
}

}  // namespace
}  // namespace nearfield::test
