#include <tools/cli/settings_options.hpp>
#include <tools/common/parsed_option.hpp>
#include <tools/io/input_error.hpp>

namespace nearfield::tools {

void add_settings_options(CLI::App& command, SettingsArguments& arguments) {
    command
        .add_option("--boxes", arguments.boxes,
                    "Bounding boxes that localise: axis-aligned or oriented; default axis-aligned")
        ->type_name("NAME");
    add_count_option(command, "--height", arguments.height, {0, 32},
                     "Maximum height of their hierarchies: more is more work on the CPU and less "
                     "on the device; default 12")
        ->type_name("LEVELS");
    add_count_option(command, "--memory-limit", arguments.memory_limit, {1, 1U << 20U},
                     "Limit for the images and results of a batch, host and device together, "
                     "MiB; default 1024")
        ->type_name("MIB");
    add_parsed_option(
        command, "--threads", arguments.threads,
        [](const std::string& text, const std::string& option) {
            return std::make_shared<ThreadTeam>(parse_count(text, option, {1, max_jobs}));
        },
        "Threads for what the CPU answers; default 1; 1 to " + std::to_string(max_jobs))
        ->type_name("COUNT");
}

Settings parse_settings(const SettingsArguments& arguments) {
    Settings settings;
    settings.timestamps = true;  // reports say what each pass takes
    if (arguments.boxes == "oriented") {
        settings.bounding_volume = BoundingVolume::oriented;
    } else if (arguments.boxes && arguments.boxes != "axis-aligned") {
        throw InputError("--boxes: \"" + *arguments.boxes + "\" is none of axis-aligned, oriented");
    }
    settings.hierarchy_height = arguments.height.value_or(settings.hierarchy_height);
    if (arguments.memory_limit) {
        settings.memory_limit = std::uint64_t{*arguments.memory_limit} << 20U;
    }
    if (arguments.threads) {
        settings.jobs = arguments.threads->jobs();
    }
    return settings;
}

std::string memory_hint(const std::string& error) {
    return error.find(", more than the limit of ") == std::string::npos
               ? std::string()
               : "; --memory-limit sets the limit";
}

}  // namespace nearfield::tools
