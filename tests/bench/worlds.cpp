// Queries of a world, answered by the device and by the CPU: all pairs of a world in which
// everything moves; all pairs where few instances move, by a table that keeps the rest and by a
// batch that does not; and many rays, points and poses.

#include <nearfield/nearfield.hpp>

#include <tests/bench/bench.hpp>
#include <tests/support/polygons.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace nearfield::bench {
namespace {

/// A world of stars of 50 vertices and radius 1, scattered over a square.
class Crowd {
public:
    Crowd(Context& context, std::uint32_t count, double side, std::uint32_t shapes = 20)
        : random_(count), side_(side), world_(take(World::create(context))) {
        std::vector<ShapeHandle> stars;
        for (std::uint32_t i = 0; i < shapes; ++i) {
            stars.push_back(take(context.add_shape(test::star(random_, 50, 0.5))));
        }
        for (std::uint32_t i = 0; i < count; ++i) {
            instances_.push_back({stars[i % shapes], {place(), random_.between(0.0, 6.0)}});
            handles_.push_back(
                take(world_.add({.shape = stars[i % shapes], .pose = instances_.back().pose})));
        }
    }

    [[nodiscard]] World& world() { return world_; }
    [[nodiscard]] test::Random& random() { return random_; }
    [[nodiscard]] const std::vector<Instance>& instances() const { return instances_; }
    /// Anywhere in the square.
    [[nodiscard]] Vector2 place() {
        return {random_.between(0.0, side_), random_.between(0.0, side_)};
    }
    /// Moves the next ones, or all of them, a little.
    void move(std::size_t count) {
        moved_.clear();
        poses_.clear();
        for (std::size_t i = 0; i < count; ++i) {
            next_ = (next_ + 37) % instances_.size();
            Pose& pose = instances_[next_].pose;
            pose.translation.x += pose.translation.x < 0.5 * side_ ? 1e-3 : -1e-3;
            pose.angle += 1e-3;
            moved_.push_back(handles_[next_]);
            poses_.push_back(pose);
        }
        require(world_.move(moved_, poses_));
    }
    void move() { move(instances_.size()); }

private:
    test::Random random_;
    double side_;
    World world_;
    std::vector<InstanceHandle> handles_;
    std::vector<Instance> instances_;
    std::vector<InstanceHandle> moved_;
    std::vector<Pose> poses_;
    std::size_t next_ = 0;
};

/// Square and number of a crowd.
struct CrowdSize {
    std::uint32_t count;
    double side;
};

std::string name_of(const CrowdSize& size) {
    return std::to_string(size.count) + " in " + std::to_string(static_cast<int>(size.side));
}

/// A number of a row, so that none is left out.
template <class Query>
double number_of(const PairRow<Query>& row) {
    if constexpr (requires { row.deepest; }) {
        return row.count > 0 ? row.deepest.depth : 0.0;
    } else if constexpr (requires { row.count; }) {
        return row.count;
    } else if constexpr (requires { row.distance; }) {
        return row.distance;
    } else {
        return row.error_bound;
    }
}

/// Time: of the update, and of the reading of all rows. `upload`: with recording, what the CPU does
/// of the update.
template <class Query>
void add_pairs(const std::string& name, const CrowdSize& size, const Query& query, int frames) {
    for (const Technique technique : {Technique::compute, Technique::cpu}) {
        const std::string full =
            "pairs/" + name_of(size) + ", " + name + "/" + to_string(technique);
        add(full, frames, [=](State& state) {
            Context context = take(Context::create_headless());
            Crowd crowd(context, size.count, size.side);
            PairTable<Query> table(query,
                                   {.reach = 0.05, .hits_only = true, .technique = technique});
            run(
                state, [&] { crowd.move(); },
                [&]() -> Numbers {
                    require(crowd.world().update(table));
                    const double updated = processor_milliseconds();
                    double sum = 0.0;
                    for (const PairRow<Query>& row : table.rows()) {
                        sum += number_of(row);
                    }
                    require(table.read_status());
                    const double read = processor_milliseconds();
                    if (!std::isfinite(sum)) {
                        throw std::runtime_error("depths are not finite");
                    }
                    const Timings& timings = table.timings();
                    return {{"candidates", table.candidates()},
                            {"rows", table.size()},
                            {"left", table.left_to_cpu()},
                            {"upload ms", timings.plan + timings.record + timings.decode},
                            {"read ms", read - updated}};
                });
        })->UseRealTime();
    }
}

/// Worlds of several sizes.
template <class Query>
void add_all_pairs(const std::string& name, const Query& query) {
    add_pairs(name, {1'000, 50.0}, query, 20);
    add_pairs(name, {1'000, 16.0}, query, 10);
    add_pairs(name, {1'000, 7.5}, query, 5);
    add_pairs(name, {40'000, 320.0}, query, 5);
}

const bool pairs_are_added = [] {
    add_all_pairs("intersection test", IntersectionTestQuery{});
    add_all_pairs("separation", SeparationQuery{.tolerance = 0.03});
    ContactQuery contacts{.tolerance = 0.03, .contact_distance = 0.05, .summary_only = false};
    add_pairs("contacts with records", {1'000, 50.0}, contacts, 20);
    contacts.summary_only = true;
    add_all_pairs("contacts", contacts);
    for (const PenetrationPoints points :
         {PenetrationPoints::vertices, PenetrationPoints::boundary}) {
        const std::string name =
            points == PenetrationPoints::vertices ? "penetration, vertices" : "penetration";
        PenetrationQuery query{.tolerance = 0.03, .points = points, .summary_only = false};
        add_pairs(name + " with records", {1'000, 50.0}, query, 20);
        add_pairs(name + " with records", {1'000, 16.0}, query, 5);
        query.summary_only = true;
        add_all_pairs(name, query);
    }
    return true;
}();

/// Of 1,000 stars, each a shape of its own, with about 5,000 pairs whose boxes overlap, ten move in
/// a frame.
constexpr CrowdSize mostly_still{1'000, 36.5};
constexpr std::size_t moving = 10;
constexpr int frames_of_tables = 400;

/// Penetration has two queries a pair, the others one.
template <class Query>
void add_queries(Batch& batch, Query query, const Instance& a, const Instance& b) {
    query.a = a;
    query.b = b;
    batch.add(query);
    if constexpr (std::is_same_v<Query, PenetrationQuery>) {
        query.a = b;
        query.b = a;
        batch.add(query);
    }
}

template <class Query>
void add_tables(const std::string& name, const Query& query) {
    add("few move/" + name + "/batch", frames_of_tables, [query](State& state) {
        Context context = take(Context::create_cpu());
        Crowd crowd(context, mostly_still.count, mostly_still.side, mostly_still.count);
        Batch batch;
        Results results;
        run(state, [&]() -> Numbers {
            crowd.move(moving);
            batch.clear();
            for (const InstancePair& pair :
                 take(context.find_overlapping_boxes(crowd.instances(), 0.0))) {
                add_queries(batch, query, crowd.instances()[pair.first],
                            crowd.instances()[pair.second]);
            }
            require(context.run(batch, results));
            return {};
        });
    });
    for (const bool hits_only : {false, true}) {
        add("few move/" + name + (hits_only ? "/hits" : "/table"), frames_of_tables,
            [=](State& state) {
                Context context = take(Context::create_cpu());
                Crowd crowd(context, mostly_still.count, mostly_still.side, mostly_still.count);
                PairTable<Query> table(query,
                                       {.hits_only = hits_only, .technique = Technique::cpu});
                run(state, [&]() -> Numbers {
                    crowd.move(moving);
                    require(crowd.world().update(table));
                    return {{"candidates", table.candidates()}};
                });
            });
    }
}

const bool tables_are_added = [] {
    add_tables("intersection test", IntersectionTestQuery());
    PenetrationQuery vertices{.tolerance = 0.01, .points = PenetrationPoints::vertices};
    add_tables("penetrating vertices, both ways", vertices);
    vertices.summary_only = false;
    add_tables("the same with records", vertices);
    add_tables("separation", SeparationQuery{.tolerance = 0.01});
    return true;
}();

constexpr WorldOptions by_device{.technique = Technique::compute};

/// Questions of one kind about a crowd whose instances move or not: `Questions` makes its inputs,
/// has the device answer them and asks the CPU. Time: until the answers are there.
template <class Questions>
void add_questions(const std::string& name, const CrowdSize& size, const Questions& made) {
    for (const std::size_t count : {1'000U, 30'000U, 1'000'000U}) {
        for (const bool moves : {false, true}) {
            for (const bool device : {true, false}) {
                const std::string full = "questions/" + name_of(size) +
                                         (moves ? " that move, " : ", ") + std::to_string(count) +
                                         " " + name + (device ? "/compute" : "/cpu");
                add(full, count > 100'000 ? 5 : 25, [=](State& state) {
                    Context context =
                        take(Context::create_headless({}, Settings{.pipelines_on_demand = true}));
                    Crowd crowd(context, size.count, size.side);
                    Questions questions = made;
                    questions.make(context, crowd, count);
                    WorldRequest request;
                    run(
                        state, [&] { crowd.move(moves ? crowd.instances().size() : 0); },
                        [&]() -> Numbers {
                            if (!device) {
                                require(questions.ask(crowd.world()));
                                return {};
                            }
                            require(questions.submit(crowd.world(), request));
                            require(request.collect(questions.answers));
                            const Timings& timings = request.timings();
                            return {{"left", request.left_to_cpu()},
                                    {"upload ms", timings.plan + timings.record},
                                    {"wait ms", timings.device},
                                    {"answers ms", timings.decode}};
                        });
                })->UseRealTime();
            }
        }
    }
}

struct Rays {
    double length = 0.0;
    std::vector<Segment> segments = {};
    std::vector<RayHit> answers = {};

    void make(Context& /*context*/, Crowd& crowd, std::size_t count) {
        while (segments.size() < count) {
            const Vector2 from = crowd.place();
            const double angle = crowd.random().between(0.0, 6.3);
            segments.push_back(
                {from, {from.x + length * std::cos(angle), from.y + length * std::sin(angle)}});
        }
        answers.resize(count);
    }
    Status submit(World& world, WorldRequest& request) const {
        return world.submit(request, segments, by_device);
    }
    Status ask(World& world) { return world.cast_rays(segments, answers); }
};

struct Nearest {
    NearestQuery query = {};
    std::vector<Vector2> points = {};
    std::vector<NearestHit> answers = {};

    void make(Context& /*context*/, Crowd& crowd, std::size_t count) {
        while (points.size() < count) {
            points.push_back(crowd.place());
        }
        answers.resize(count);
    }
    Status submit(World& world, WorldRequest& request) const {
        return world.submit(request, query, points, by_device);
    }
    Status ask(World& world) { return world.find_nearest(query, points, answers); }
};

struct Poses {
    ShapeHandle robot = {};
    std::vector<Pose> poses = {};
    std::vector<std::uint8_t> answers = {};

    void make(Context& context, Crowd& crowd, std::size_t count) {
        robot = take(context.add_shape(
            test::scaled_and_moved(test::star(crowd.random(), 20, 0.5), 0.3, {})));
        while (poses.size() < count) {
            const Vector2 at = crowd.place();
            poses.push_back({at, 17.0 * at.x});
        }
        answers.resize(count);
    }
    Status submit(World& world, WorldRequest& request) const {
        return world.submit(request, robot, poses, by_device);
    }
    Status ask(World& world) { return world.test_poses(robot, poses, answers); }
};

const bool questions_are_added = [] {
    for (const CrowdSize size : {CrowdSize{1'000, 50.0}, CrowdSize{42'000, 325.0}}) {
        add_questions("rays of 3", size, Rays{3.0});
        add_questions("rays of 30", size, Rays{30.0});
        add_questions("poses", size, Poses{});
        add_questions("points, nearest within 0.25", size, Nearest{{.max_distance = 0.25}});
        add_questions("points, nearest", size, Nearest{{.max_distance = 1e30}});
    }
    return true;
}();

}  // namespace
}  // namespace nearfield::bench
