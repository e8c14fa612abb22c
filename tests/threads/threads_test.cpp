#include <engine/gpu/headless.hpp>
#include <nearfield/vulkan.hpp>

#include <gtest/gtest.h>
#include <tests/support/techniques.hpp>

#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace nearfield::test {
namespace {

constexpr int frames = 4;
constexpr int threads = 3;

const std::vector<Vector2> ring_a{{0, 0}, {3, 0}, {3, 2}, {2, 1}, {1, 2}, {0, 2}};
const std::vector<Vector2> ring_b{{0, 0}, {2, 0.2}, {2.5, 1.5}, {1, 2.5}, {-0.5, 1}};

/// A thread's work on its own context: shapes added and changed, pairs found, batches run, and
/// others in flight two at a time.
class Simulation {
public:
    explicit Simulation(Context context) : context_(std::move(context)) {}

    /// All depths and distances of the results; the text of an error if there was one.
    std::vector<double> run() {
        const Expected<ShapeHandle> a = context_.add_shape({{ring_a}});
        const Expected<ShapeHandle> b = context_.add_shape({{ring_b}});
        if (!a || !b) {
            error_ = "a shape was refused";
            return {};
        }
        a_ = *a;
        b_ = *b;
        Ticket former;
        for (int frame = 0; frame < frames && error_.empty(); ++frame) {
            find_overlapping_boxes(frame);
            const Ticket ticket = submit(frame);
            collect(former);
            former = ticket;
            Results results;
            expect(context_.run(batch(frame, Technique::cpu), results));
            note(results);
            expect(context_.update_shape(b_, {{frame % 2 == 0 ? ring_a : ring_b}}));
        }
        collect(former);
        return numbers_;
    }

    [[nodiscard]] const std::string& error() const { return error_; }

private:
    [[nodiscard]] Batch batch(int frame, Technique technique) const {
        const Instance here{a_, {}};
        const Instance there{b_, {{1.2, 0.1 * frame}, 0.3}};
        Batch batch;
        batch.add(PenetrationQuery{here, there, 0.1, {}, false, technique});
        batch.add(SeparationQuery{here, {b_, {{6.0, 0.1 * frame}, 0.3}}, 0.1, technique});
        batch.add(IntersectionQuery{here, there, 0.1, IntersectionKind::volume_volume, false,
                                    IntersectionStrategy::stencil, technique});
        return batch;
    }
    void expect(const Status& status) {
        if (!status.ok() && error_.empty()) {
            error_ = status.text();
        }
    }
    void find_overlapping_boxes(int frame) {
        const Instance instances[] = {{a_, {}}, {b_, {{0.5 * frame, 0.0}, 0.0}}};
        const auto pairs = context_.find_overlapping_boxes(instances, 0.1);
        expect(pairs.error());
        numbers_.push_back(pairs ? static_cast<double>(pairs->size()) : -1.0);
    }
    Ticket submit(int frame) {
        const Expected<Ticket> ticket = context_.submit(
            batch(frame, frame % 2 == 0 ? device_techniques.front() : Technique::compute));
        expect(ticket.error());
        return ticket.has_value() ? *ticket : Ticket{};
    }
    void collect(Ticket ticket) {
        if (ticket == Ticket{}) {
            return;
        }
        static_cast<void>(context_.is_ready(ticket));
        Results results;
        expect(context_.collect(ticket, results));
        note(results);
    }
    void note(const Results& results) {
        for (const AnyResult& any : results.results) {
            if (const auto* const depths = std::get_if<PenetrationResult>(&any)) {
                expect(depths->status);
                numbers_.push_back(depths->deepest.depth);
            } else if (const auto* const gap = std::get_if<SeparationResult>(&any)) {
                expect(gap->status);
                numbers_.push_back(gap->distance);
            } else if (const auto* const common = std::get_if<IntersectionResult>(&any)) {
                expect(common->status);
                numbers_.push_back(static_cast<double>(common->count));
            }
        }
    }

    Context context_;
    ShapeHandle a_;
    ShapeHandle b_;
    std::vector<double> numbers_;
    std::string error_;
};

/// Runs a simulation on each of several threads, which call `make`. All must give the same results.
template <class Make>
void expect_same_on_threads(const Make& make) {
    std::vector<std::vector<double>> found(threads);
    std::vector<std::string> errors(threads);
    std::vector<std::thread> running;
    for (std::size_t i = 0; i < found.size(); ++i) {
        running.emplace_back([&make, &numbers = found[i], &error = errors[i]] {
            Expected<Context> made = make();
            if (!made) {
                error = made.error().text();
                return;
            }
            Simulation simulation(std::move(*made));
            numbers = simulation.run();
            error = simulation.error();
        });
    }
    for (std::thread& thread : running) {
        thread.join();
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(errors[i], "");
        EXPECT_GT(found[i].size(), 3U * frames);
        EXPECT_EQ(found[i], found[0]) << "thread " << i;
    }
}

TEST(Threads, HaveContextsOnOneDeviceAndOneQueue) {
    const gpu::HeadlessDevice device({});
    std::mutex queue;
    HostDevice host = device.host();
    host.queue_access.user = &queue;
    host.queue_access.lock = [](void* user) { static_cast<std::mutex*>(user)->lock(); };
    host.queue_access.unlock = [](void* user) { static_cast<std::mutex*>(user)->unlock(); };
    Settings settings;
    settings.pipelines_on_demand = true;
    expect_same_on_threads([&] { return Context::create(host, settings); });
}

TEST(Threads, HaveContextsOnDevicesOfTheirOwn) {
    Settings settings;
    settings.pipelines_on_demand = true;
    expect_same_on_threads([&] { return Context::create_headless({}, settings); });
}

}  // namespace
}  // namespace nearfield::test
