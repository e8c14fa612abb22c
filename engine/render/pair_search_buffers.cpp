#include <engine/base/interruption.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/render/pair_search_buffers.hpp>
#include <engine/render/search_memory.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace nearfield::render {
namespace {

constexpr std::array<const char*, 1> name_of_instance_set{"nearfield pair set of instances"};

/// In place of the number of pairs until the device has counted them.
constexpr std::uint32_t not_counted = UINT32_MAX;

constexpr std::uint32_t passes_of_parts(std::size_t parts) {
    return passes::PairPoses::max_passes + passes::PairSearch::passes_of_boxes +
           static_cast<std::uint32_t>(parts) *
               (passes::PairSearch::max_passes_of_part + passes::ExportPairs::max_passes);
}

}  // namespace

PairSearchBuffers::PairSearchBuffers(const gpu::Device& device, const passes::ComputeLayout& layout,
                                     const plan::PairQuestion& question, bool timestamps)
    : device_(&device),
      layout_(&layout),
      question_(question),
      submission_(device),
      timestamps_(device, passes_of_parts(1), timestamps),
      poses_(device, layout),
      outputs_(device, layout),
      world_(device),
      scratch_(device, scratch_usage, gpu::Direction::none, "nearfield pair scratch"),
      arguments_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                 gpu::Direction::none, "nearfield pair arguments"),
      sets_(device, layout, name_of_instance_set),
      parts_(question) {
    arguments_.reserve(argument_bytes(plan::stages_of_pairs));
}

PairSearchBuffers::~PairSearchBuffers() {
    if (is_submitted_) {
        submission_.wait_to_the_end();
    }
}

std::uint32_t PairSearchBuffers::candidates() const {
    std::uint32_t all = 0;
    for (std::size_t i = 0; has_results_ && i < parts_.count(); ++i) {
        all += memories_[i]->candidates();
    }
    return all;
}

std::uint32_t PairSearchBuffers::row_count() const {
    const PairPartMemory& last = *memories_[parts_.count() - 1];
    return last.first_row() + last.row_count();
}

const PairPartMemory& PairSearchBuffers::part_of(std::uint32_t row) const {
    const auto end = memories_.begin() + static_cast<std::ptrdiff_t>(parts_.count());
    const auto next = std::upper_bound(
        memories_.begin() + 1, end, row,
        [](std::uint32_t number, const auto& part) { return number < part->first_row(); });
    return **(next - 1);
}

PairLimits PairSearchBuffers::limits() const {
    return {.reach = device_->limits().maxStorageBufferRange, .memory = memory_limit_};
}

void PairSearchBuffers::make_parts() {
    while (memories_.size() < parts_.count()) {
        memories_.push_back(std::make_unique<PairPartMemory>(*device_, *layout_, question_));
    }
    memories_.resize(parts_.count());
    timestamps_.reserve(passes_of_parts(parts_.count()));
}

void PairSearchBuffers::lay_out() {
    parts_.fit(limits());
    make_parts();
    plan::SearchPush push{};
    std::uint32_t rows = 0;
    std::uint32_t records = 0;
    scratch_bytes_ = 0;
    for (std::size_t i = 0; i < parts_.count(); ++i) {
        const PairCounts& room = parts_[i].capacities;
        const PairBytes bytes = place_pair_arrays(question_.kind(), world_.count(), room, push);
        scratch_bytes_ = std::max(scratch_bytes_, bytes.scratch);
        memories_[i]->lay_out(parts_[i], world_.count());
        rows += room[plan::row_total];
        records += room[plan::record_total];
    }
    reserve_with_texels(*device_, scratch_, scratch_texels_, scratch_bytes_,
                        "nearfield pair scratch texels");
    if (outputs_.is_set()) {
        outputs_.reserve(rows, records);
    }
    bind();
    laid_out_world_ = world_.revision();
    is_laid_out_ = true;
}

void PairSearchBuffers::bind() const {
    using Layout = passes::ComputeLayout;
    layout_->begin_updates();
    const VkDescriptorSet set = sets_[0];
    layout_->write_buffer(set, Layout::tiles, world_.shapes(), 0, world_.shape_bytes());
    layout_->write_buffer(set, Layout::geometry, scratch_.handle(), 0, scratch_bytes_);
    layout_->write_buffer(set, Layout::points, world_.instances(), 0, world_.instance_bytes());
    layout_->write_buffer(set, Layout::output, arguments_.handle(), 0,
                          argument_bytes(plan::stages_of_pairs));
    layout_->write_texels(set, Layout::texels, world_.texels());
    layout_->write_texels(set, Layout::scratch_texels, scratch_texels_.get());
    for (const auto& part : memories_) {
        part->bind({.of_instances = set,
                    .shapes = world_.shapes(),
                    .shape_bytes = world_.shape_bytes(),
                    .texels = world_.texels(),
                    .instances = world_.instances(),
                    .scratch = scratch_.handle(),
                    .scratch_bytes = scratch_bytes_,
                    .scratch_texels = scratch_texels_.get(),
                    .arguments = arguments_.handle()});
    }
    layout_->end_updates();
}

/// Lets the commands that follow be about the present memory, and about where poses come from and
/// results go. Whatever can fail is done here, before anything is recorded.
void PairSearchBuffers::prepare(bool takes_poses, std::uint32_t pairs) {
    checkpoint();
    if (!is_laid_out_) {
        is_bound_ = false;
        lay_out();
    }
    for (const auto& part : memories_) {
        part->clear_counts(pairs);
    }
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
        poses_.bind({world_.shapes(), world_.shape_bytes()}, world_.texels(),
                    {world_.instances(), world_.instance_bytes()}, world_.count());
    }
    if (outputs_.is_set()) {
        outputs_.bind({.shapes = {world_.shapes(), world_.shape_bytes()},
                       .instances = {world_.instances(), world_.instance_bytes()},
                       .scratch = {scratch_.handle(), scratch_bytes_},
                       .texels = world_.texels(),
                       .scratch_texels = scratch_texels_.get()});
        for (std::size_t i = 0; i < memories_.size(); ++i) {
            const passes::PairSearch::Item& search = memories_[i]->item();
            outputs_.bind(i, {.search = search, .rows = {search.rows, memories_[i]->row_bytes()}});
        }
    }
}

void PairSearchBuffers::write_commands(VkCommandBuffer commands, bool takes_poses) {
    timestamps_.reset(commands);
    if (takes_poses) {
        poses_.record(commands, timestamps_);
    }
    passes_->record_boxes(commands, timestamps_, memories_.front()->item());
    for (std::size_t i = 0; i < memories_.size(); ++i) {
        passes_->record(commands, timestamps_, memories_[i]->item());
        if (outputs_.is_set()) {
            outputs_.record(i, commands, timestamps_);
        }
    }
}

/// The commands stay the same as long as the memory does, and where poses come from and results go.
void PairSearchBuffers::submit(bool takes_poses, Timings& timings) {
    const Stopwatch start;
    prepare(takes_poses, 0);
    if (is_recorded_) {
        submission_.submit_again();
    } else {
        write_commands(submission_.begin(true), takes_poses);
        submission_.submit();
    }
    is_submitted_ = is_recorded_ = true;
    timings.record += start.milliseconds();
}

void PairSearchBuffers::read_counts() {
    counts_.clear();
    for (const auto& part : memories_) {
        counts_.push_back(part->read_counts());
    }
}

bool PairSearchBuffers::had_room() const {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        if (!have_room(counts_[i], parts_[i].capacities)) {
            return false;
        }
    }
    return true;
}

/// Whether the device has executed the commands that were recorded for the host.
bool PairSearchBuffers::were_executed() const {
    return std::none_of(counts_.begin(), counts_.end(), [](const PairCounts& counts) {
        return counts[plan::pair_total] == not_counted;
    });
}

/// What there was room for.
void PairSearchBuffers::read_results() {
    if (poses_.is_set()) {
        poses_.finish();
    }
    undecided_.clear();
    std::uint32_t rows = 0;
    for (std::size_t i = 0; i < memories_.size(); ++i) {
        memories_[i]->read_results(rows, undecided_);
        rows += memories_[i]->row_count();
        parts_.note(i, counts_[i]);
    }
    has_results_ = true;
}

/// Makes room for what the device has counted.
void PairSearchBuffers::grow() {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        require_searchable(counts_[i]);
        if (have_room(counts_[i], parts_[i].capacities)) {
            parts_.note(i, counts_[i]);
        } else {
            parts_.grow(i, counts_[i]);
        }
    }
    is_laid_out_ = false;
}

void PairSearchBuffers::upload(const passes::PairSearch& passes, const plan::SearchShapes& shapes,
                               std::uint64_t memory_limit) {
    passes_ = &passes;
    memory_limit_ = memory_limit;
    const bool had_results = std::exchange(has_results_, false);
    if (std::exchange(is_for_host_, false)) {
        read_counts();
        if (were_executed() && !had_room()) {
            grow();
        }
    }
    if (had_results && parts_.join(limits())) {
        is_laid_out_ = false;
    }
    world_.upload(shapes);
    if (parts_.set_instances(world_.count()) || laid_out_world_ != world_.revision()) {
        is_laid_out_ = false;
    }
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
        read_counts();
        timings.device += waiting.milliseconds();
        timestamps_.collect(timings.passes);
        if (had_room()) {
            break;
        }
        grow();
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
    prepare(poses_.is_set(), not_counted);
    device_->begin_label(commands, "nearfield");
    write_commands(commands, poses_.is_set());
    device_->end_label(commands);
    is_for_host_ = true;
    timings.record += start.milliseconds();
}

void PairSearchBuffers::collect(Timings& timings) {
    read_counts();
    if (!were_executed()) {
        throw StatusException(
            {StatusCode::not_executed,
             "the frame of this table counts as complete, but the device did not execute the "
             "commands recorded for it; was the command buffer submitted?"});
    }
    timestamps_.collect(timings.passes);
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        require_searchable(counts_[i]);
        if (!have_room(counts_[i], parts_[i].capacities)) {
            throw StatusException(overflow(counts_[i], parts_[i].capacities));
        }
    }
    read_results();
}

}  // namespace nearfield::render
