// The rows of the table of a GPU, and how each way does its work.

#include <nearfield/device_poses.hpp>
#include <nearfield/world.hpp>
#include <nearfield/world_pairs.hpp>

#include <tools/benchmark/crowds.hpp>
#include <tools/benchmark/objects.hpp>
#include <tools/benchmark/outlines.hpp>
#include <tools/benchmark/questions.hpp>
#include <tools/cli/gpu_times.hpp>
#include <tools/common/add_shape.hpp>
#include <tools/common/library_error.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/rendering/resources.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace nearfield::tools {
namespace {

constexpr double crowd_tolerance = 0.01;
constexpr std::size_t field_vertices = 8000;
constexpr double field_window = 3.0;  ///< side of the square around the coast line

/// One batch a frame, as of `nearfield bench --scene --keep`.
class BatchWork : public GpuWork {
public:
    BatchWork(Scene scene, Technique technique, Context& context) : scene_(std::move(scene)) {
        set_technique(scene_, technique);
        runner_.emplace(scene_, "bench", context);
    }

    void run_frame() override {
        runner_->run_frame(FrameInput::poses);
        runner_->require_results();
    }
    [[nodiscard]] const Timings& timings() const override { return runner_->timings(); }
    [[nodiscard]] std::uint64_t pairs() const override { return runner_->pair_count(); }
    [[nodiscard]] std::uint64_t found() const override {
        std::uint64_t found = 0;
        for (const SceneAnswer& answer : runner_->answers()) {
            if (const auto* const points = std::get_if<PenetrationResult>(&answer.result)) {
                found += points->count;
            }
        }
        return found;
    }

private:
    Scene scene_;
    std::optional<SceneRunner> runner_;
};

/// What becomes of the rows that the device finds.
enum class Rows : std::uint8_t {
    unread,
    read,      // each, by the host
    resident,  // they and their records stay on the device, from where the poses come too
};

/// A world of which the device finds the pairs.
class DevicePairWork : public GpuWork {
public:
    DevicePairWork(const Scene& scene, Rows rows, Context& context, const Gpu& gpu)
        : context_(context),
          world_(take(World::create(context))),
          table_({.tolerance = crowd_tolerance,
                  .summary_only = true,
                  .on_device = rows == Rows::resident},
                 {.hits_only = true, .technique = Technique::compute}),
          rows_(rows) {
        for (const SceneShape& shape : scene.shapes) {
            shapes_.push_back(take(add_shape(context, shape.rings, shape.deviation)));
        }
        for (const SceneInstance& instance : scene.instances) {
            poses_.push_back(instance.pose);
            handles_.push_back(
                take(world_.add({.shape = shapes_[instance.shape], .pose = instance.pose})));
        }
        if (rows == Rows::resident) {
            place_on_device(gpu);
        }
    }
    ~DevicePairWork() override {
        for (const ShapeHandle shape : shapes_) {
            static_cast<void>(context_.remove_shape(shape));  // fails only for an unknown shape
        }
    }
    DevicePairWork(const DevicePairWork&) = delete;
    DevicePairWork& operator=(const DevicePairWork&) = delete;

    void run_frame() override {
        if (rows_ == Rows::resident) {
            require(world_.update(table_, {.poses = &device_poses_}), "bench");
            return;
        }
        for (Pose& pose : poses_) {
            pose.translation.x =
                std::nextafter(pose.translation.x, std::numeric_limits<double>::infinity());
        }
        require(world_.move(handles_, poses_), "bench");
        require(world_.update(table_), "bench");
        if (rows_ == Rows::read) {
            found_ = 0;
            for (const PairRow<PenetrationQuery>& row : table_.rows()) {
                found_ += row.count;
            }
            require(table_.read_status(), "bench");
        }
    }
    [[nodiscard]] const Timings& timings() const override { return table_.timings(); }
    [[nodiscard]] std::uint64_t pairs() const override { return table_.candidates(); }
    [[nodiscard]] std::uint64_t found() const override { return found_; }

private:
    /// Puts the poses into a buffer, as the host's own commands would in each frame.
    void place_on_device(const Gpu& gpu) {
        constexpr auto usage = vk::BufferUsageFlagBits::eStorageBuffer;
        buffer_ = HostBuffer(gpu, poses_.size() * 4 * sizeof(float), usage);
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            const Pose& pose = poses_[i];
            const std::array<float, 4> element{
                static_cast<float>(pose.translation.x), static_cast<float>(pose.translation.y),
                static_cast<float>(std::cos(pose.angle)), static_cast<float>(std::sin(pose.angle))};
            std::memcpy(buffer_.bytes().data() + handles_[i].index * sizeof(element), &element,
                        sizeof(element));
        }
        device_poses_ = {.buffer = buffer_.get(),
                         .size = buffer_.bytes().size(),
                         .usage = static_cast<VkBufferUsageFlags>(usage)};
    }

    Context& context_;
    HostBuffer buffer_;  // destroyed after the table
    World world_;
    PairTable<PenetrationQuery> table_;
    Rows rows_;
    DevicePoses device_poses_;
    std::vector<ShapeHandle> shapes_;
    std::vector<InstanceHandle> handles_;
    std::vector<Pose> poses_;
    std::uint64_t found_ = 0;
};

/// A field by compute that stays on the device.
class ResidentFieldWork : public GpuWork {
public:
    ResidentFieldWork(std::size_t cells, Context& context) : context_(context) {
        const QueryRequest request = benchmark::square_field({}, field_window, cells);
        const std::vector<Ring> rings{benchmark::coast(1, field_vertices)};
        shape_ = take(add_shape(context, rings, 0.0));
        batch_.add(DistanceFieldQuery{.b = {shape_, {}},
                                      .tolerance = request.tolerance,
                                      .rectangle = request.rectangle,
                                      .values = false,
                                      .technique = Technique::compute,
                                      .on_device = true,
                                      .features_on_device = false});
    }
    ~ResidentFieldWork() override {
        static_cast<void>(context_.remove_shape(shape_));  // fails only for an unknown shape
    }
    ResidentFieldWork(const ResidentFieldWork&) = delete;
    ResidentFieldWork& operator=(const ResidentFieldWork&) = delete;

    void run_frame() override {
        require(context_.run(batch_, results_), "bench");
        require(std::get<DistanceFieldResult>(results_.results.front()).status, "bench");
    }
    [[nodiscard]] const Timings& timings() const override { return results_.timings; }
    [[nodiscard]] std::uint64_t pairs() const override { return 0; }
    [[nodiscard]] std::uint64_t found() const override { return 0; }

private:
    Context& context_;
    ShapeHandle shape_;
    Batch batch_;
    Results results_;
};

GpuRowPlan::Way batch_way(const char* name, Technique technique, std::function<Scene()> scene) {
    return {name, technique != Technique::cpu,
            [technique, scene = std::move(scene)](Context& context, const Gpu&) {
                return std::make_unique<BatchWork>(scene(), technique, context);
            }};
}

GpuRowPlan crowd_row(std::size_t objects) {
    const auto scene = [objects] {
        QueryRequest request = benchmark::boundary_penetration(crowd_tolerance);
        request.records = false;
        return benchmark::asked(benchmark::crowd_scene(objects), request, benchmark::Pairs::all);
    };
    const auto of_world = [objects](Rows rows) {
        return [objects, rows](Context& context, const Gpu& gpu) {
            return std::make_unique<DevicePairWork>(benchmark::crowd_scene(objects), rows, context,
                                                    gpu);
        };
    };
    return {"crowd of " + std::to_string(objects) + " objects",
            true,
            0,
            {batch_way("cpu", Technique::cpu, scene),
             batch_way("raster", Technique::raster, scene),
             batch_way("compute", Technique::compute, scene),
             {"device pairs", true, of_world(Rows::unread)},
             {"device pairs, read", true, of_world(Rows::read)},
             {"device pairs, resident", true, of_world(Rows::resident)}}};
}

GpuRowPlan field_row(std::size_t cells) {
    const auto scene = [cells] {
        Scene alone;
        benchmark::add_object(alone, {benchmark::coast(1, field_vertices)}, {});
        return benchmark::asked(std::move(alone), benchmark::square_field({}, field_window, cells),
                                0, 0);
    };
    return {"field " + std::to_string(cells) + " x " + std::to_string(cells),
            false,
            std::uint64_t{cells} * cells,
            {batch_way("cpu", Technique::cpu, scene),
             batch_way("raster", Technique::raster, scene),
             batch_way("compute", Technique::compute, scene),
             {"compute, resident", true, [cells](Context& context, const Gpu&) {
                  return std::make_unique<ResidentFieldWork>(cells, context);
              }}}};
}

}  // namespace

std::vector<GpuRowPlan> gpu_rows() {
    std::vector<GpuRowPlan> rows;
    for (const std::size_t objects : {420U, 1000U, 4200U, 12'500U, 42'000U}) {
        rows.push_back(crowd_row(objects));
    }
    for (const std::size_t cells : {256U, 512U, 1024U, 2048U, 4096U}) {
        rows.push_back(field_row(cells));
    }
    return rows;
}

}  // namespace nearfield::tools
