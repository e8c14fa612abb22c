#include <tests/query/every_query.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/allocations.hpp>
#include <tests/support/host_frames.hpp>
#include <tests/support/host_gpu.hpp>
#include <tests/support/pair_tables.hpp>
#include <tests/support/watched_loader.hpp>

#include <array>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

/// The table "What each call costs" of docs/host_integration.md: each row is measured.

struct Cost {
    std::uint64_t allocations = 0;  ///< the library's own, on the heap
    int made = 0;                   ///< Vulkan objects
    int destroyed = 0;
    int pipelines = 0;
    int waits = 0;
    int submissions = 0;
    int jobs = 0;  ///< calls of JobSystem::run

    Cost& operator+=(const Cost& other) {
        allocations += other.allocations;
        made += other.made;
        destroyed += other.destroyed;
        pipelines += other.pipelines;
        waits += other.waits;
        submissions += other.submissions;
        jobs += other.jobs;
        return *this;
    }
};

Cost counted;  // entry points have no user data
std::uint64_t allocations_below = 0;

void count_call(const test_support::WatchedCall& call) {
    const bool is_pipeline =
        call.name == "vkCreateComputePipelines" || call.name == "vkCreateGraphicsPipelines";
    allocations_below += call.allocations;
    counted.made += call.makes() ? 1 : 0;
    counted.destroyed += call.destroys() ? 1 : 0;
    counted.pipelines += is_pipeline ? 1 : 0;
    counted.waits += call.name.starts_with("vkWait") || call.name.ends_with("WaitIdle") ? 1 : 0;
    counted.submissions += call.name == "vkQueueSubmit" ? 1 : 0;
}

void run_jobs(void*, std::uint32_t jobs, void (*job)(void* data, std::uint32_t number),
              void* data) {
    ++counted.jobs;
    for (std::uint32_t number = 0; number < jobs; ++number) {
        job(data, number);
    }
}

/// Of the first call, for which nothing was reserved, and of many like it after a warm-up.
struct Costs {
    Cost first;
    std::optional<Cost> steady;
};

std::string in_words(const Costs& costs) {
    const Cost& first = costs.first;
    const Cost& usual = costs.steady.value_or(first);
    const std::string memory = usual.allocations > 0   ? "allocates"
                               : first.allocations > 0 ? "grows"
                                                       : "no";
    std::string objects = usual.made > 0        ? "makes"
                          : first.made > 0      ? "grows"
                          : usual.destroyed > 0 ? "destroys"
                                                : "no";
    if (first.pipelines > 0) {
        objects += ", all pipelines";
    } else if (usual.made > 0 && usual.destroyed > 0) {
        objects += ", destroys";
    }
    const auto word = [](int count, const char* yes) { return count > 0 ? yes : "no"; };
    return memory + " | " + objects + " | " + word(usual.waits, "own fence") + " | " +
           word(usual.submissions, "once") + " | " + word(usual.jobs, "yes");
}

/// The rows of the documents' table, by call.
std::map<std::string, std::string> documented() {
    std::ifstream page(NEARFIELD_DOCUMENTS "/host_integration.md");
    std::map<std::string, std::string> rows;
    bool inside = false;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("#")) {
            inside = line == "## What each call costs";
        }
        if (!inside || !line.starts_with("| `")) {
            continue;
        }
        const std::size_t end = line.find(" | ");
        rows[line.substr(2, end - 2)] = line.substr(end + 3, line.size() - end - 5);
    }
    return rows;
}

class CallCosts : public QueryTest {
protected:
    void SetUp() override {
        loader_.emplace(host_device(), test_support::watched(host_device(), count_call));
        Random random(4400);
        rings_ = coast(random, 100, 0.5);
        other_rings_ = with_holes(random, 3);
    }
    void TearDown() override {
        context_.reset();
        loader_.reset();
        QueryTest::TearDown();
    }

    /// Another context with the same shapes.
    void make_context() {
        Settings settings;
        settings.jobs = {nullptr, 4, run_jobs};
        std::optional<Expected<Context>> made;
        measure("`Context::create`",
                [&] { made.emplace(Context::create(loader_->host(), settings)); });
        ASSERT_TRUE(made->has_value()) << made->error().text();
        context_.emplace(std::move(**made));
        a_ = *context_->add_shape(rings_);
        b_ = *context_->add_shape(other_rings_);
    }

    /// Adds to the costs of this name what the call costs.
    template <class Call>
    void measure(const std::string& name, const Call& call) {
        counted = {};
        allocations_below = 0;
        const std::uint64_t before = test_support::allocation_count_of_this_thread();
        call();
        counted.allocations =
            test_support::allocation_count_of_this_thread() - before - allocations_below;
        const Cost cost = counted;
        EXPECT_LE(cost.submissions, is_steady_ ? 1 : 9) << name;
        const auto [found, is_first] = costs_.try_emplace(name);
        Costs& costs = found->second;
        if (is_first) {
            costs.first = cost;
        } else if (is_steady_) {
            costs.steady = costs.steady.value_or(Cost{}) += cost;
        }
    }

    /// Every query that can be recorded, and a field in an image of the host's. Only its address
    /// is kept of `target`.
    void ask(const FieldTarget& target) {
        batch_ = every_query(a_, b_, 0);
        DistanceFieldQuery field;
        field.b = {b_, {}};
        field.tolerance = 0.1;
        field.rectangle = Rectangle{{-1.0, -1.0}, {1.0, 1.0}};
        field.on_device = true;
        field.target = &target;
        field_ = batch_.add(field);
    }

    void measure_layout() {
        measure("`field_grid`, `target_size`", [&] {
            const auto& field = std::get<DistanceFieldQuery>(batch_.queries()[field_.index]);
            EXPECT_TRUE(context_->field_grid(field).has_value());
            EXPECT_TRUE(context_->target_size(PenetrationQuery{field.b, field.b, 0.1}).has_value());
            EXPECT_TRUE(
                context_->target_size(ContactQuery{field.b, field.b, 0.1, 0.1}).has_value());
            EXPECT_TRUE(
                context_->target_size(IntersectionQuery{field.b, field.b, 0.1}).has_value());
        });
        measure("`layout_on_device`",
                [&] { EXPECT_TRUE(context_->layout_on_device(batch_, field_).has_value()); });
    }

    void measure_shapes(const Rings& update) {
        const std::array<Instance, 2> instances{{{a_, {}}, {b_, {}}}};
        ShapeHandle added;
        measure("`add_shape`", [&] { added = *context_->add_shape(rings_); });
        measure("`update_shape`", [&] { EXPECT_TRUE(context_->update_shape(added, update).ok()); });
        measure("`remove_shape`", [&] { EXPECT_TRUE(context_->remove_shape(added).ok()); });
        measure("`find_overlapping_boxes`",
                [&] { EXPECT_EQ(context_->find_overlapping_boxes(instances, 1.0)->size(), 1U); });
    }

    void measure_recorded(test_support::HostFrames& host) {
        const std::uint64_t frame = frame_++;
        const VkCommandBuffer commands = host.begin(frame);
        Ticket ticket;
        measure("`record`", [&] {
            ticket = *context_->record(batch_, {.commands = commands, .frame = frame});
        });
        host.submit(frame);
        host.wait(frame);
        measure("`frame_completed`, `is_ready`", [&] {
            context_->frame_completed(frame);
            EXPECT_TRUE(context_->is_ready(ticket));
        });
        measure("`collect` of a recorded batch",
                [&] { EXPECT_TRUE(context_->collect(ticket, results_).ok()); });
    }

    void measure_submitted() {
        Ticket ticket;
        measure("`submit`", [&] { ticket = *context_->submit(batch_); });
        measure("`on_device`, `memory_use`, `device_name`", [&] {
            EXPECT_TRUE(context_->on_device(ticket, field_).has_value());
            EXPECT_GT(context_->memory_use().in_use, 0U);
            EXPECT_FALSE(context_->device_name().empty());
        });
        measure("`collect` of a submitted batch",
                [&] { EXPECT_TRUE(context_->collect(ticket, results_).ok()); });
    }

    void measure_run() {
        measure("`run`", [&] { EXPECT_TRUE(context_->run(batch_, results_).ok()); });
    }

    /// A world of forty instances, and tables of its pairs by either technique.
    void make_world() {
        world_.emplace(*context_);
        for (int i = 0; i < 40; ++i) {
            const auto added =
                world_->add({.shape = i % 2 == 0 ? a_ : b_, .pose = {{0.35 * i, 0.0}}});
            ASSERT_TRUE(added.has_value()) << added.error().text();
            instances_.push_back(*added);
        }
        const ContactQuery contacts{.tolerance = 0.05, .contact_distance = 0.05};
        by_cpu_.emplace(contacts, PairTableOptions{.hits_only = true, .technique = Technique::cpu});
        by_device_.emplace(contacts, test::on_device);
    }

    void measure_instances(int frame) {
        const InstanceHandle first = instances_.front();
        InstanceHandle added;
        measure("`World::add`", [&] { added = *world_->add({.shape = a_}); });
        measure("`move`, `set_filter`, `remove`, `size`, `instance`", [&] {
            EXPECT_TRUE(world_->move(first, {{0.01 * (frame % 4), 0.0}, 0.2}).ok());
            EXPECT_TRUE(world_->set_filter(first, 1, frame % 2 == 0 ? 1 : 3).ok());
            EXPECT_TRUE(world_->remove(added).ok());
            EXPECT_EQ(world_->size(), 40U);
            EXPECT_TRUE(world_->instance(first).has_value());
        });
    }

    /// The lists of a table grow until those of rows that are gone take as much memory as others.
    void let_lists_grow() {
        for (int i = 0; i < 200; ++i) {
            EXPECT_TRUE(world_->move(instances_.front(), {{0.01 * (i % 4), 0.0}, 0.2}).ok());
            EXPECT_TRUE(world_->update(*by_cpu_).ok());
        }
    }

    void measure_tables(test_support::HostFrames& host) {
        for (std::size_t i = 0; i < instances_.size(); ++i) {  // all, for several jobs
            const double angle = 0.3 * static_cast<double>(frame_ % 4);
            const Pose pose{{0.35 * static_cast<double>(i), 0.0}, angle};
            EXPECT_TRUE(world_->move(instances_[i], pose).ok());
        }
        measure("`World::update` by cpu", [&] { EXPECT_TRUE(world_->update(*by_cpu_).ok()); });
        measure("`World::update` by compute",
                [&] { EXPECT_TRUE(world_->update(*by_device_).ok()); });
        measure("`World::submit` of a table",
                [&] { EXPECT_TRUE(world_->submit(*by_device_).ok()); });
        measure("`collect` of a submitted table", [&] { EXPECT_TRUE(by_device_->collect().ok()); });
        const std::uint64_t frame = frame_++;
        const VkCommandBuffer commands = host.begin(frame);
        measure("`World::record`", [&] {
            EXPECT_TRUE(world_->record(*by_device_, {.commands = commands, .frame = frame}).ok());
        });
        host.submit(frame);
        host.wait(frame);
        context_->frame_completed(frame);
        measure("`collect` of a recorded table", [&] { EXPECT_TRUE(by_device_->collect().ok()); });
        measure("`rows`, `row`, `points`, `manifold`", [&] {
            for (const auto& row : by_device_->rows()) {
                EXPECT_FALSE(by_device_->points(row).empty());
                EXPECT_FALSE(by_device_->manifold(row).empty());
            }
        });
        measure("`PairTable::is_ready`, `is_recorded`, `size`, `candidates`", [&] {
            EXPECT_TRUE(by_device_->is_ready());
            EXPECT_TRUE(world_->is_recorded(*by_device_));
            EXPECT_GT(by_device_->candidates(), by_cpu_->size() / 2);
        });
    }

    void measure_questions() {
        const std::vector<Segment> segments(4000, Segment{{-1.0, 0.2}, {30.0, 0.1}});
        std::vector<RayHit> hits(segments.size());
        const WorldOptions by_cpu{.technique = Technique::cpu};
        const WorldOptions by_device{.technique = Technique::compute};
        measure("`cast_rays`, `find_nearest`, `test_poses` by cpu",
                [&] { EXPECT_TRUE(world_->cast_rays(segments, hits, by_cpu).ok()); });
        measure("`cast_rays`, `find_nearest`, `test_poses` by compute",
                [&] { EXPECT_TRUE(world_->cast_rays(segments, hits, by_device).ok()); });
        measure("`World::submit` of a request",
                [&] { EXPECT_TRUE(world_->submit(request_, segments, by_device).ok()); });
        measure("`WorldRequest::collect`", [&] { EXPECT_TRUE(request_.collect(hits).ok()); });
    }

    void measure_ends() {
        request_ = {};
        by_device_.reset();
        by_cpu_.reset();
        world_.reset();
        measure("`trim`", [&] { context_->trim(); });
        ASSERT_TRUE(context_->submit(batch_).has_value());
        measure("`~Context`", [&] { context_.reset(); });
    }

    void expect_documented() const {
        const std::map<std::string, std::string> table = documented();
        EXPECT_GT(table.size(), 10U);
        for (const auto& [call, costs] : costs_) {
            ASSERT_TRUE(table.contains(call)) << call << ": " << in_words(costs);
            EXPECT_EQ(table.at(call), in_words(costs)) << call;
        }
        for (const auto& [call, words] : table) {
            EXPECT_TRUE(costs_.contains(call)) << call << " is not measured";
        }
    }

    bool is_steady_ = false;
    Rings rings_;

private:
    std::optional<test_support::FakeLoader> loader_;
    std::optional<Context> context_;
    Rings other_rings_;
    ShapeHandle a_;
    ShapeHandle b_;
    Batch batch_;
    QueryHandle<DistanceFieldQuery> field_;
    Results results_;
    std::uint64_t frame_ = 0;
    std::optional<World> world_;
    std::vector<InstanceHandle> instances_;
    std::optional<PairTable<ContactQuery>> by_cpu_;
    std::optional<PairTable<ContactQuery>> by_device_;
    WorldRequest request_;
    std::map<std::string, Costs> costs_;
};

TEST_F(CallCosts, AreThoseOfTheDocuments) {
    test_support::HostGpu gpu(host_device());
    test_support::HostFrames host(host_device(), 1);
    FieldTarget target;
    ImageTarget& image = target.signed_distance;
    image.format = VK_FORMAT_R32_SFLOAT;
    image.extent = {64, 64};
    image.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    const test_support::HostGpu::Image made =
        gpu.make_image(image.format, image.extent, image.usage);
    image.image = made.image;
    image.view = made.view;
    const auto measure_first = [&](const auto& call) {
        make_context();
        ask(target);
        call();
    };
    measure_first([&] { measure_layout(); });
    measure_first([&] { measure_recorded(host); });
    measure_first([&] { measure_submitted(); });
    measure_first([&] { measure_run(); });
    Random random(4500);
    measure_shapes(coast(random, 400, 0.5));  // grows
    make_world();
    for (int frame = 0; frame < 40; ++frame) {
        is_steady_ = frame >= 20;
        measure_shapes(rings_);
        measure_layout();
        measure_recorded(host);
        measure_submitted();
        measure_run();
        measure_instances(frame);
        measure_tables(host);
        measure_questions();
        if (frame == 0) {
            let_lists_grow();
        }
    }
    measure_ends();
    expect_documented();
}

}  // namespace
}  // namespace nearfield::test
