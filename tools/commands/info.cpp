#include <nearfield/context.hpp>

#include <tools/commands/info.hpp>
#include <tools/commands/library_error.hpp>

#include <iostream>
#include <vector>

namespace nearfield::tools {

CLI::App* add_info_command(CLI::App& program) {
    return program.add_subcommand(
        "info", "Print the version and the devices: usable, or what each of them lacks");
}

int run_info() {
    std::cout << "nearfield " NEARFIELD_VERSION "\n";
    const std::vector<DeviceReport> devices = take(list_devices());
    bool any_usable = false;
    for (const DeviceReport& device : devices) {
        std::cout << device.name << "\n  driver: " << device.driver << "\n  "
                  << (device.usable ? "usable" : "not usable") << '\n';
        for (const std::string& reason : device.missing) {
            std::cout << "  missing: " << reason << '\n';
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
