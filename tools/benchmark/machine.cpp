#include <nearfield/diagnostics.hpp>

#include <embedded/commit.hpp>
#include <sched.h>
#include <tools/benchmark/machine.hpp>
#include <tools/common/library_error.hpp>

#include <ctime>
#include <fstream>

namespace nearfield::benchmark {
namespace {

std::string processor_name() {
    std::ifstream stream("/proc/cpuinfo");
    for (std::string line; std::getline(stream, line);) {
        const std::size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return "unknown";
}

unsigned usable_cores() {
    cpu_set_t cores;
    CPU_ZERO(&cores);
    return sched_getaffinity(0, sizeof cores, &cores) == 0
               ? static_cast<unsigned>(CPU_COUNT(&cores))
               : 0;
}

std::string date_of_today() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    char text[16];
    gmtime_r(&now, &parts);
    return {text, std::strftime(text, sizeof text, "%Y-%m-%d", &parts)};
}

}  // namespace

Machine this_machine() {
    return {embedded::commit, processor_name(), usable_cores(), date_of_today()};
}

std::string driver_of(const std::string& device) {
    if (device.empty()) {
        return {};
    }
    for (const DeviceReport& report : tools::take(list_devices())) {
        if (report.name == device) {
            return report.driver;
        }
    }
    return {};
}

}  // namespace nearfield::benchmark
