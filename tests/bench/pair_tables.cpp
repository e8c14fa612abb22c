// Measures queries of all pairs of a world in which few instances move, by a table that keeps the
// rest and by a batch that does not, and prints a table in Markdown.

#include <nearfield/nearfield.hpp>

#include <tests/bench/clocks.hpp>
#include <tests/bench/take.hpp>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <stdexcept>
#include <vector>

namespace {

using nearfield::bench::median;
using nearfield::bench::processor_milliseconds;
using nearfield::bench::require;
using nearfield::bench::take;

using nearfield::Batch;
using nearfield::Context;
using nearfield::Instance;
using nearfield::InstanceHandle;
using nearfield::InstancePair;
using nearfield::IntersectionTestQuery;
using nearfield::PairTable;
using nearfield::PenetrationPoints;
using nearfield::PenetrationQuery;
using nearfield::Pose;
using nearfield::Results;
using nearfield::SeparationQuery;
using nearfield::Technique;
using nearfield::World;

constexpr std::size_t count = 1000;
constexpr std::size_t moving = 10;
constexpr double side = 36.5;  // so that about 5,000 pairs of boxes overlap
constexpr int frames = 400;

/// Stars of 50 vertices and radius 1, each a shape of its own, scattered over a square. Others move
/// in every frame.
class Crowd {
public:
    explicit Crowd(Context& context) : world_(take(World::create(context))) {
        nearfield::test::Random random(5);
        for (std::size_t i = 0; i < count; ++i) {
            const Pose pose{{random.between(0.0, side), random.between(0.0, side)},
                            random.between(0.0, 6.0)};
            const auto shape = take(context.add_shape(nearfield::test::star(random, 50, 0.5)));
            handles_.push_back(take(world_.add({.shape = shape, .pose = pose})));
            instances_.push_back({shape, pose});
        }
    }

    World& world() { return world_; }
    [[nodiscard]] const std::vector<Instance>& instances() const { return instances_; }

    /// Chooses those that move and where to.
    void next_frame() {
        moved_.clear();
        poses_.clear();
        for (std::size_t i = 0; i < moving; ++i) {
            next_ = (next_ + 37) % count;
            Pose& pose = instances_[next_].pose;
            pose.translation.x += pose.translation.x < 0.5 * side ? 0.02 : -0.02;
            pose.angle += 0.05;
            moved_.push_back(handles_[next_]);
            poses_.push_back(pose);
        }
    }
    void move() { require(world_.move(moved_, poses_)); }

private:
    World world_;
    std::vector<InstanceHandle> handles_;
    std::vector<Instance> instances_;
    std::vector<InstanceHandle> moved_;
    std::vector<Pose> poses_;
    std::size_t next_ = 0;
};

/// Penetration has two queries a pair, the others one.
template <class Query>
void add_queries(Batch& batch, const Query& query, const Instance& a, const Instance& b) {
    Query asked = query;
    asked.a = a;
    asked.b = b;
    batch.add(asked);
}

template <>
void add_queries(Batch& batch, const PenetrationQuery& query, const Instance& a,
                 const Instance& b) {
    for (const bool reversed : {false, true}) {
        PenetrationQuery asked = query;
        asked.a = reversed ? b : a;
        asked.b = reversed ? a : b;
        batch.add(asked);
    }
}

template <class Query>
double batch_time(Context& context, Crowd& crowd, const Query& query) {
    Batch batch;
    Results results;
    std::vector<double> times;
    for (int frame = 0; frame < frames; ++frame) {
        crowd.next_frame();
        const double start = processor_milliseconds();
        batch.clear();
        for (const InstancePair& pair :
             take(context.find_overlapping_boxes(crowd.instances(), 0.0))) {
            add_queries(batch, query, crowd.instances()[pair.first],
                        crowd.instances()[pair.second]);
        }
        require(context.run(batch, results));
        times.push_back(processor_milliseconds() - start);
        crowd.move();
    }
    return median(times);
}

template <class Query>
double table_time(Crowd& crowd, PairTable<Query>& table) {
    require(crowd.world().update(table));
    std::vector<double> times;
    for (int frame = 0; frame < frames; ++frame) {
        crowd.next_frame();
        const double start = processor_milliseconds();
        crowd.move();
        require(crowd.world().update(table));
        times.push_back(processor_milliseconds() - start);
    }
    return median(times);
}

template <class Query>
void print_row(Context& context, Crowd& crowd, const char* name, const Query& query) {
    PairTable<Query> all(query, {.technique = Technique::cpu});
    PairTable<Query> hits(query, {.hits_only = true, .technique = Technique::cpu});
    const double of_batch = batch_time(context, crowd, query);
    const double of_all = table_time(crowd, all);
    const double of_hits = table_time(crowd, hits);
    std::printf("| %s | %u | %.3g | %.3g (%.1f %%) | %.3g (%.1f %%) |\n", name, all.candidates(),
                of_batch, of_all, 100.0 * of_all / of_batch, of_hits, 100.0 * of_hits / of_batch);
}

}  // namespace

int main() {
    Context context = take(Context::create_cpu());
    Crowd crowd(context);
    std::printf("| query | candidates | batch | table | hits |\n|---|---|---|---|---|\n");
    print_row(context, crowd, "intersection test", IntersectionTestQuery());
    const PenetrationQuery vertices{.tolerance = 0.01, .points = PenetrationPoints::vertices};
    print_row(context, crowd, "penetrating vertices, both ways", vertices);
    PenetrationQuery records = vertices;
    records.summary_only = false;
    print_row(context, crowd, "the same with records", records);
    print_row(context, crowd, "separation", SeparationQuery{.tolerance = 0.01});
    return 0;
}
