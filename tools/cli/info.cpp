#include <nearfield/diagnostics.hpp>
#include <nearfield/version.hpp>

#include <tools/cli/info.hpp>
#include <tools/common/library.hpp>
#include <tools/io/query_request.hpp>

#include <iostream>
#include <vector>

namespace nearfield::tools {

CLI::App* add_info_command(CLI::App& program) {
    return program.add_subcommand(
        "info",
        "Print the version and the devices: usable or not, the intersection strategies each "
        "has, and what it lacks");
}

int run_info() {
    std::cout << "nearfield " << version().text << '\n';
    const std::vector<DeviceReport> devices = take(list_devices());
    bool any_usable = false;
    for (const DeviceReport& device : devices) {
        std::cout << device.name << "\n  driver: " << device.driver << "\n  "
                  << (device.usable ? "usable" : "not usable") << '\n';
        for (const std::string& reason : device.missing) {
            std::cout << "  missing: " << reason << '\n';
        }
        for (const OptionalPart& part : device.optional) {
            std::cout << "  optional " << part.name << ": "
                      << (part.available ? "available" : "not available") << "; unlocks "
                      << part.unlocks << '\n';
            for (const std::string& reason : part.missing) {
                std::cout << "    missing: " << reason << '\n';
            }
        }
        for (const StrategyReport& report : device.strategies) {
            std::cout << "  strategy " << name_of(report.strategy) << ": "
                      << (report.missing.empty() ? "available" : "not available") << '\n';
            for (const std::string& reason : report.missing) {
                std::cout << "    missing: " << reason << '\n';
            }
        }
        any_usable = any_usable || device.usable;
    }
    if (!any_usable) {
        std::cerr << "nearfield: "
                  << (devices.empty() ? "there is no Vulkan device\n"
                                      : "none of the devices can be used\n");
    }
    return any_usable ? exit_status::done : exit_status::no_device;
}

}  // namespace nearfield::tools
