#include <engine/base/status_exception.hpp>
#include <engine/context/check_structures.hpp>
#include <nearfield/host.hpp>

#include <string>

namespace nearfield {
namespace {

[[noreturn]] void refuse_setting(const std::string& message) {
    throw StatusException({StatusCode::invalid_settings, message});
}

void check_jobs(const JobSystem& jobs) {
    const std::string count = "Settings::jobs.count is " + std::to_string(jobs.count);
    if (jobs.run == nullptr && jobs.count > 0) {
        refuse_setting(count + ", and run is null");
    }
    if (jobs.run != nullptr && (jobs.count < 1 || jobs.count > max_jobs)) {
        refuse_setting(count + "; it must be at least 1 and at most " + std::to_string(max_jobs));
    }
}

/// Two functions of a host that belong together.
void check_both(const char* member, bool first, const char* first_name, bool second,
                const char* second_name) {
    if (first != second) {
        refuse_setting(std::string("HostDevice::") + member + "." +
                       (first ? second_name : first_name) + " is null, and " +
                       (first ? first_name : second_name) + " is set; give both or neither");
    }
}

}  // namespace

void check_structure(const HostDevice& host) {
    const QueueAccess& access = host.queue_access;
    check_both("queue_access", access.lock != nullptr, "lock", access.unlock != nullptr, "unlock");
    const MemoryFunctions& memory = host.memory;
    check_both("memory", memory.allocate != nullptr, "allocate", memory.free != nullptr, "free");
    if (host.reader_families == nullptr && host.reader_family_count > 0) {
        refuse_setting("HostDevice::reader_family_count is " +
                       std::to_string(host.reader_family_count) + ", and reader_families is null");
    }
    if (host.completion_by_timeline && !host.timeline_semaphore) {
        refuse_setting(
            "HostDevice::completion_by_timeline is set, and timeline_semaphore is not: the host "
            "has to enable the feature");
    }
}

void check_structure(const Settings& settings) {
    if (settings.batches_in_flight < 1 || settings.batches_in_flight > max_batches_in_flight) {
        refuse_setting("batches_in_flight is " + std::to_string(settings.batches_in_flight) +
                       "; it must be at least 1 and at most " +
                       std::to_string(max_batches_in_flight));
    }
    if (settings.bounding_volume != BoundingVolume::axis_aligned &&
        settings.bounding_volume != BoundingVolume::oriented) {
        refuse_setting("Settings::bounding_volume is no enumerator: " +
                       std::to_string(static_cast<int>(settings.bounding_volume)));
    }
    check_jobs(settings.jobs);
}

}  // namespace nearfield
