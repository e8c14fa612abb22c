#include <engine/base/interruption.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/render/pair_search_buffers.hpp>
#include <engine/render/search_memory.hpp>

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

namespace nearfield::render {
namespace {

constexpr std::array<const char*, passes::PairSearch::set_count> names_of_pair_sets{
    "nearfield pair set of instances", "nearfield pair set of points",
    "nearfield pair set of rows"};

/// Of each stage, where there is no memory for the usual ones.
constexpr std::uint32_t least_capacity = 64;
/// In place of the number of pairs until the device has counted them.
constexpr std::uint32_t not_counted = UINT32_MAX;

constexpr std::uint64_t bytes_of_counts = plan::words_of_counts * sizeof(std::uint32_t);

/// Rows, one more, and the numbers of those that the CPU decides.
std::uint64_t bytes_of_rows(std::uint32_t rows) {
    return (std::uint64_t{rows} + 1) * sizeof(plan::PairRowData) +
           std::uint64_t{rows} * sizeof(std::uint32_t);
}

}  // namespace

PairSearchBuffers::PairSearchBuffers(const gpu::Device& device, const passes::ComputeLayout& layout,
                                     const plan::PairQuestion& question, bool timestamps)
    : device_(&device),
      layout_(&layout),
      kind_(question.kind()),
      submission_(device),
      timestamps_(device,
                  passes::PairPoses::max_passes + passes::PairSearch::max_passes +
                      passes::ExportPairs::max_passes,
                  timestamps),
      poses_(device, layout),
      outputs_(device, layout),
      world_(device),
      scratch_(device, scratch_usage, gpu::Direction::none, "nearfield pair scratch"),
      arguments_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                 gpu::Direction::none, "nearfield pair arguments"),
      records_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::readback,
               "nearfield pair points"),
      // The host hardly reads rows that are resident: they lie in memory of the device.
      rows_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
            question.resident ? gpu::Direction::upload : gpu::Direction::readback,
            "nearfield pair rows"),
      // Some devices read arguments much faster where the host does not.
      count_memory_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::readback,
                    "nearfield pair counts"),
      sets_(device, layout, names_of_pair_sets) {
    arguments_.reserve(argument_bytes(plan::stages_of_pairs));
    count_memory_.reserve(bytes_of_counts);
    item_.capacities = first_capacities(kind_);
    for (std::size_t i = 0; i < needed_.size(); ++i) {
        needed_[i] = std::min(least_capacity, item_.capacities[i]);
    }
    for (std::size_t i = 0; i < item_.sets.size(); ++i) {
        item_.sets[i] = sets_[i];
    }
}

PairSearchBuffers::~PairSearchBuffers() {
    if (is_submitted_) {
        submission_.wait_to_the_end();
    }
}

/// Where everything is in the scratch memory, and how large it and its two companions are.
PairSearchBuffers::Bytes PairSearchBuffers::place_arrays() {
    plan::SearchPush& push = item_.push;
    push.instances = world_.count();
    const auto [edges, points, found, pairs, items, rows] = item_.capacities;
    ScratchLayout layout;
    push.boxes = layout.units(units_of_boxes(push.instances));
    push.lists = layout.units(plan::units_of_list * std::uint64_t{push.instances});
    push.pairs = layout.words(2 * std::uint64_t{pairs});
    push.directions = layout.units(plan::units_of_direction * std::uint64_t{pairs});
    push.summaries = layout.units(2 * std::uint64_t{pairs});
    push.verdicts = layout.words(pairs);
    push.frames = layout.units(pairs);
    push.first_directions = layout.sums(items);
    // Two sums for each block of instances, which begin whole units.
    constexpr std::uint64_t more = std::uint64_t{8} * plan::search_block;
    const std::uint64_t instances = 2 * std::uint64_t{push.instances} + more;
    layout.add_stages(items, edges, points, std::max<std::uint64_t>(pairs, instances), push);
    Bytes bytes{layout.bytes(), records_bytes(), bytes_of_rows(rows)};
    if (outputs_.is_set()) {
        bytes.resident_records = PairOutputs::bytes_of_records(found);
        bytes.resident_rows = PairOutputs::bytes_of_pairs(rows);
    }
    return bytes;
}

void PairSearchBuffers::lay_out() {
    const std::uint64_t reached = device_->limits().maxStorageBufferRange;
    const auto fit = [&](const Bytes& bytes) {
        return bytes.largest() <= reached && bytes.sum() <= memory_limit_;
    };
    Bytes bytes = place_arrays();
    if (!fit(bytes)) {
        item_.capacities = needed_;
        bytes = place_arrays();
    }
    if (!fit(bytes)) {
        throw StatusException(
            {StatusCode::too_large, "the pairs of the world need " + std::to_string(bytes.sum()) +
                                        " bytes on the device, " + std::to_string(bytes.largest()) +
                                        " of them in one buffer; Settings::memory_limit is " +
                                        std::to_string(memory_limit_) + ", and shaders reach " +
                                        std::to_string(reached) + " of a buffer"});
    }
    scratch_bytes_ = bytes.scratch;
    reserve_with_texels(*device_, scratch_, scratch_texels_, bytes.scratch,
                        "nearfield pair scratch texels");
    records_.reserve(bytes.records);
    rows_.reserve(bytes.rows);
    if (outputs_.is_set()) {
        outputs_.reserve(item_.capacities[plan::row_total], item_.capacities[plan::record_total]);
    }
    item_.shapes = world_.shapes();
    item_.instances = world_.instances();
    item_.scratch = scratch_.handle();
    item_.arguments = arguments_.handle();
    item_.records = records_.handle();
    item_.rows = rows_.handle();
    item_.counts = count_memory_.handle();
    bind();
    laid_out_world_ = world_.revision();
    is_laid_out_ = true;
}

void PairSearchBuffers::bind() const {
    using Layout = passes::ComputeLayout;
    layout_->begin_updates();
    for (std::size_t i = 0; i < item_.sets.size(); ++i) {
        const auto write = [&](Layout::Binding binding, VkBuffer buffer, std::uint64_t bytes) {
            layout_->write_buffer(item_.sets[i], binding, buffer, 0, bytes);
        };
        write(Layout::tiles, item_.shapes, world_.shape_bytes());
        write(Layout::geometry, item_.scratch, scratch_bytes_);
        layout_->write_texels(item_.sets[i], Layout::texels, world_.texels());
        layout_->write_texels(item_.sets[i], Layout::scratch_texels, scratch_texels_.get());
        if (i == passes::PairSearch::of_rows) {
            write(Layout::points, item_.rows, bytes_of_rows(item_.capacities[plan::row_total]));
            write(Layout::output, item_.counts, bytes_of_counts);
            continue;
        }
        if (i == passes::PairSearch::of_points) {
            write(Layout::points, item_.records, records_bytes());
        } else {
            write(Layout::points, item_.instances, world_.instance_bytes());
        }
        write(Layout::output, item_.arguments, argument_bytes(plan::stages_of_pairs));
    }
    layout_->end_updates();
}

/// Lets the commands that follow be about the present memory, and about where poses come from and
/// results go. Whatever can fail is done here, before anything is recorded.
void PairSearchBuffers::prepare(bool takes_poses) {
    checkpoint();
    if (!is_laid_out_) {
        is_bound_ = false;
        lay_out();
    }
    // A device that is lost leaves no counts of an earlier search.
    std::memset(count_memory_.data(), 0, bytes_of_counts);
    count_memory_.flush();
    const std::uint32_t revision = takes_poses ? poses_.revision() : 0;
    if (!is_bound_ || bound_poses_ != revision || bound_outputs_ != outputs_.revision()) {
        is_bound_ = is_recorded_ = false;
        bind_ends(takes_poses);
        bound_poses_ = revision;
        bound_outputs_ = outputs_.revision();
        is_bound_ = true;
    }
}

/// Where poses come from, and where results go.
void PairSearchBuffers::bind_ends(bool takes_poses) {
    if (takes_poses) {
        poses_.bind({item_.shapes, world_.shape_bytes()}, world_.texels(),
                    {item_.instances, world_.instance_bytes()}, item_.push.instances);
    }
    if (outputs_.is_set()) {
        outputs_.bind({.search = item_,
                       .shapes = {item_.shapes, world_.shape_bytes()},
                       .instances = {item_.instances, world_.instance_bytes()},
                       .scratch = {item_.scratch, scratch_bytes_},
                       .rows = {item_.rows, bytes_of_rows(item_.capacities[plan::row_total])},
                       .texels = world_.texels(),
                       .scratch_texels = scratch_texels_.get()});
    }
}

void PairSearchBuffers::write_commands(VkCommandBuffer commands, bool takes_poses) {
    timestamps_.reset(commands);
    if (takes_poses) {
        poses_.record(commands, timestamps_);
    }
    passes_->record(commands, timestamps_, item_);
    if (outputs_.is_set()) {
        outputs_.record(commands, timestamps_);
    }
}

/// The commands stay the same as long as the memory does, and where poses come from and results go.
void PairSearchBuffers::submit(bool takes_poses, Timings& timings) {
    const Stopwatch start;
    prepare(takes_poses);
    if (is_recorded_) {
        submission_.submit_again();
    } else {
        write_commands(submission_.begin(true), takes_poses);
        submission_.submit();
    }
    is_submitted_ = is_recorded_ = true;
    timings.record += start.milliseconds();
}

PairCounts PairSearchBuffers::read_counts() const {
    count_memory_.invalidate();
    PairCounts counts{};
    std::memcpy(counts.data(), count_memory_.data(), sizeof(counts));
    return counts;
}

void PairSearchBuffers::read_undecided() {
    std::uint32_t count = 0;
    std::memcpy(&count, count_memory_.data() + plan::undecided_rows * sizeof(count), sizeof(count));
    const auto* const numbers =
        reinterpret_cast<const std::uint32_t*>(rows_data() + 1 + item_.capacities[plan::row_total]);
    undecided_.assign(numbers, numbers + std::min(count, counts_[plan::row_total]));
    std::sort(undecided_.begin(), undecided_.end());
}

/// What there was room for.
void PairSearchBuffers::read_results() {
    if (poses_.is_set()) {
        poses_.finish();
    }
    rows_.invalidate();
    read_undecided();
    if (records_.data() != nullptr) {
        records_.invalidate();
    }
}

/// Makes room for what the device has counted, and a little more if that fits.
void PairSearchBuffers::grow(const PairCounts& counts) {
    require_countable(counts);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        needed_[i] = std::max(needed_[i], counts[i]);
    }
    item_.capacities = grown(counts, item_.capacities);
    is_laid_out_ = false;
}

void PairSearchBuffers::upload(const passes::PairSearch& passes, const plan::SearchShapes& shapes,
                               std::uint64_t memory_limit) {
    passes_ = &passes;
    memory_limit_ = memory_limit;
    if (std::exchange(is_for_host_, false)) {
        const auto counts = executed_counts();
        if (counts && !have_room(*counts, item_.capacities)) {
            grow(*counts);
        }
    }
    world_.upload(shapes);
    is_laid_out_ = is_laid_out_ && laid_out_world_ == world_.revision();
}

void PairSearchBuffers::begin(const passes::PairSearch& passes, const plan::SearchShapes& shapes,
                              std::uint64_t memory_limit, Timings& timings) {
    upload(passes, shapes, memory_limit);
    submit(poses_.is_set(), timings);
}

void PairSearchBuffers::finish(Timings& timings) {
    for (;;) {
        const Stopwatch waiting;
        submission_.wait();
        is_submitted_ = false;
        counts_ = read_counts();
        timings.device += waiting.milliseconds();
        timestamps_.collect(timings.passes);
        if (have_room(counts_, item_.capacities)) {
            break;
        }
        grow(counts_);
        // The places that the poses gave are still there; the host may have overwritten the poses.
        submit(false, timings);
    }
    read_results();
}

void PairSearchBuffers::record(VkCommandBuffer commands, const passes::PairSearch& passes,
                               const plan::SearchShapes& shapes, std::uint64_t memory_limit,
                               Timings& timings) {
    upload(passes, shapes, memory_limit);
    const Stopwatch start;
    prepare(poses_.is_set());
    std::memcpy(count_memory_.data() + plan::pair_total * sizeof(not_counted), &not_counted,
                sizeof(not_counted));
    count_memory_.flush();
    device_->begin_label(commands, "nearfield");
    write_commands(commands, poses_.is_set());
    device_->end_label(commands);
    is_for_host_ = true;
    timings.record += start.milliseconds();
}

/// Of the commands that were recorded for the host; none if the device has not executed them.
std::optional<PairCounts> PairSearchBuffers::executed_counts() const {
    const PairCounts counts = read_counts();
    return counts[plan::pair_total] == not_counted ? std::nullopt : std::optional(counts);
}

void PairSearchBuffers::collect(Timings& timings) {
    const std::optional<PairCounts> counts = executed_counts();
    if (!counts) {
        throw StatusException(
            {StatusCode::not_executed,
             "the frame of this table counts as complete, but the device did not execute the "
             "commands recorded for it; was the command buffer submitted?"});
    }
    timestamps_.collect(timings.passes);
    require_countable(*counts);
    if (!have_room(*counts, item_.capacities)) {
        throw StatusException(overflow(*counts, item_.capacities));
    }
    counts_ = *counts;
    read_results();
}

}  // namespace nearfield::render
