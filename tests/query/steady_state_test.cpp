#include <engine/gpu/functions.hpp>

#include <tests/query/query_test.hpp>
#include <tests/support/allocations.hpp>
#include <tests/support/fake_loader.hpp>

#include <string_view>
#include <vector>

namespace nearfield::test {
namespace {

// What the library asks of the driver, counted on the way there. The driver and the validation
// layers below allocate as they please: that is kept apart.

std::uint64_t allocations_below = 0;
std::vector<std::string> created;  // entry points called that make or destroy something

void note(std::string_view name) {
    for (const std::string_view verb : {"vkCreate", "vkAllocate", "vkDestroy", "vkFree", "vkMap"}) {
        if (name.starts_with(verb)) {
            created.emplace_back(name);
        }
    }
}

/// Stands between the library and one entry point; `Tag` tells those of one type apart.
template <class Tag, class Function>
struct Between;

template <class Tag, class Result, class... Arguments>
struct Between<Tag, Result(VKAPI_PTR*)(Arguments...)> {
    static inline Result(VKAPI_PTR* below)(Arguments...) = nullptr;

    static Result VKAPI_CALL call(Arguments... arguments) {
        const std::uint64_t before = test_support::allocation_count_of_this_thread();
        struct Account {
            std::uint64_t before;
            ~Account() {
                allocations_below += test_support::allocation_count_of_this_thread() - before;
            }
        } const account{before};
        note(Tag::name);
        return below(arguments...);
    }
};

#define NEARFIELD_TAG(function)                        \
    struct Tag_##function {                            \
        static constexpr const char* name = #function; \
    };
NEARFIELD_DEVICE_FUNCTIONS(NEARFIELD_TAG)
NEARFIELD_DEBUG_FUNCTIONS(NEARFIELD_TAG)
#undef NEARFIELD_TAG

template <class Tag, class Function>
void lay_between(const HostDevice& host, test_support::Lies& lies) {
    using Here = Between<Tag, Function>;
    Here::below = reinterpret_cast<Function>(host.get_instance_proc_addr(host.instance, Tag::name));
    if (Here::below != nullptr) {
        lies.entry_points[Tag::name] = reinterpret_cast<PFN_vkVoidFunction>(&Here::call);
    }
}

/// Between the library and every entry point of the host's device.
test_support::Lies between(const HostDevice& host) {
    test_support::Lies lies;
#define NEARFIELD_BETWEEN(function) lay_between<Tag_##function, PFN_##function>(host, lies);
    NEARFIELD_DEVICE_FUNCTIONS(NEARFIELD_BETWEEN)
    NEARFIELD_DEBUG_FUNCTIONS(NEARFIELD_BETWEEN)
#undef NEARFIELD_BETWEEN
    return lies;
}

class SteadyState : public QueryTest {
protected:
    /// One of each kind of query that a frame of a simulation asks.
    static Batch frame(ShapeHandle a, ShapeHandle b, Technique technique) {
        Batch batch;
        const Instance here{a, {}};
        const Instance there{b, {{0.7, 0.1}, 0.3}};
        const Instance apart{b, {{3.0, 0.1}, 0.3}};
        PenetrationQuery penetration;
        penetration.technique = technique;
        penetration.a = here;
        penetration.b = there;
        penetration.tolerance = 0.01;
        batch.add(penetration);
        penetration.points = PenetrationPoints::vertices;
        batch.add(penetration);
        ContactQuery contacts;
        contacts.technique = technique;
        contacts.a = here;
        contacts.b = there;
        contacts.tolerance = 0.02;
        contacts.contact_distance = 0.05;
        batch.add(contacts);
        DistanceFieldQuery field;
        field.technique = technique;
        field.b = there;
        field.tolerance = 0.05;
        field.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
        field.features = true;
        static constexpr Vector2 points[] = {{0.1, 0.2}, {-0.3, 0.4}};
        field.points = points;
        batch.add(field);
        IntersectionQuery intersection;
        intersection.technique = technique;
        intersection.a = here;
        intersection.b = there;
        intersection.tolerance = 0.02;
        for (const IntersectionKind kind :
             {IntersectionKind::volume_volume, IntersectionKind::boundary_boundary}) {
            intersection.kind = kind;
            batch.add(intersection);
        }
        SeparationQuery separation;
        separation.technique = technique;
        separation.a = here;
        separation.b = apart;
        separation.tolerance = 0.02;
        batch.add(separation);
        ClosestPointQuery closest;
        closest.technique = technique;
        closest.a = here;
        closest.b = apart;
        closest.tolerance = 0.02;
        batch.add(closest);
        return batch;
    }

    static void expect_steady(Technique technique);
};

void SteadyState::expect_steady(Technique technique) {
    const test_support::FakeLoader loader(host_device(), between(host_device()));
    Expected<Context> made = Context::create(loader.host());
    ASSERT_TRUE(made.ok()) << made.status().text();
    Context& watched = *made;
    EXPECT_FALSE(created.empty()) << "nothing is counted";

    Random random(31);
    const Rings rings_a = coast(random, 150, 0.5);
    const Rings rings_b = with_holes(random, 3);
    Expected<ShapeHandle> a = watched.add_shape(rings_a);
    Expected<ShapeHandle> b = watched.add_shape(rings_b);
    ASSERT_TRUE(a.ok() && b.ok());
    const Batch batch = frame(*a, *b, technique);
    Results results;
    const auto run = [&] {
        const Status updated = watched.update_shape(*a, rings_a);
        return updated.ok() ? watched.run(batch, results) : updated;
    };
    // The second frame knows how many samples there will be.
    for (int i = 0; i < 2; ++i) {
        const Status status = run();
        ASSERT_TRUE(status.ok()) << status.text();
    }
    for (std::size_t i = 0; i < results.results.size(); ++i) {
        std::visit(
            [&](const auto& result) {
                EXPECT_TRUE(result.status.ok()) << "query " << i << ": " << result.status.text();
                EXPECT_FALSE(result.regions.empty()) << "query " << i;
            },
            results.results[i]);
    }
    created.clear();
    allocations_below = 0;
    const std::uint64_t before = test_support::allocation_count_of_this_thread();
    for (int i = 0; i < 100; ++i) {
        if (!run().ok()) {
            ADD_FAILURE() << "frame " << i;
        }
    }
    const std::uint64_t all = test_support::allocation_count_of_this_thread() - before;
    EXPECT_EQ(created, std::vector<std::string>());
    EXPECT_EQ(all - allocations_below, 0U) << "in 100 frames";
}

TEST_F(SteadyState, AHundredFramesAllocateAndCreateNothing) {
    expect_steady(Technique::raster);
}

TEST_F(SteadyState, AHundredFramesOfTheComputeTechniqueAllocateAndCreateNothing) {
    expect_steady(Technique::compute);
}

}  // namespace
}  // namespace nearfield::test
