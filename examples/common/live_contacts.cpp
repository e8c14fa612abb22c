#include "live_contacts.hpp"

#include "value_of.hpp"

namespace nearfield::examples {
namespace {

Settings settings(std::uint32_t frames_in_flight) {
    Settings settings;
    settings.batches_in_flight = frames_in_flight;
    settings.techniques = {.raster = false};
    settings.pipelines_on_demand = true;  // the window opens sooner
    return settings;
}

void require_ok(const Status& status) {
    if (!status.ok()) {
        throw std::runtime_error(status.text());
    }
}

}  // namespace

LiveContacts::LiveContacts(const HostDevice& host, std::uint32_t frames_in_flight,
                           const Scene& scene)
    : context_(value_of(Context::create(host, settings(frames_in_flight)))),
      frames_in_flight_(frames_in_flight),
      snapshot_{0, scene.poses(), {}} {
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
        shapes_[i] = value_of(context_.add_shape(scene.bodies()[i].rings));
    }
}

LiveContacts::~LiveContacts() {
    context_.frame_completed(last_frame_);
}

void LiveContacts::record(VkCommandBuffer commands, std::uint64_t frame, const Scene& scene) {
    if (frame >= frames_in_flight_) {
        context_.frame_completed(frame - frames_in_flight_);
    }
    while (!pending_.empty() && context_.is_ready(pending_.front().ticket)) {
        take_over(pending_.front());
        pending_.pop_front();
    }
    const std::array<Pose, 2> poses = scene.poses();
    ContactQuery query;
    query.a = {shapes_[0], poses[0]};
    query.b = {shapes_[1], poses[1]};
    query.tolerance = tolerance;
    query.contact_distance = contact_distance;
    query.technique = Technique::compute;
    batch_.clear();
    const QueryHandle<ContactQuery> handle = batch_.add(query);
    Recording recording;
    recording.commands = commands;
    recording.frame = frame;
    pending_.push_back(
        {value_of(context_.record(batch_, recording)), handle, {scene.version(), poses, {}}});
    last_frame_ = frame;
}

void LiveContacts::take_over(const Pending& pending) {
    require_ok(context_.collect(pending.ticket, results_));
    const ContactResult& result = results_[pending.query];
    require_ok(result.status);
    snapshot_ = pending.asked;
    snapshot_.contacts = result.points;
}

}  // namespace nearfield::examples
