#include <tools/cli/options.hpp>
#include <tools/common/device_pair_runner.hpp>
#include <tools/common/library.hpp>
#include <tools/common/parsed_option.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/world_request.hpp>

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <sstream>
#include <utility>

namespace nearfield::tools {
namespace {

constexpr std::size_t page_width = 80;

std::string wrap(const std::string& text, std::size_t width) {
    std::istringstream words(text);
    std::string wrapped;
    std::size_t line = 0;
    for (std::string word; words >> word; line += word.size()) {
        if (line > 0 && line + 1 + word.size() > width) {
            wrapped += '\n';
            line = 0;
        } else if (line > 0) {
            wrapped += ' ';
            ++line;
        }
        wrapped += word;
    }
    return wrapped;
}

}  // namespace

HelpFormatter::HelpFormatter(const HelpStyle& style) {
    column_width(style.first_column);
    label("SUBCOMMAND", style.subcommand);
    label("Positionals", style.positionals);
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode mode) const {
    // CLI11 puts two empty lines between groups of options.
    return CLI::detail::find_and_replace(Formatter::make_help(app, std::move(name), mode), "\n\n\n",
                                         "\n\n");
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
    return wrap(app->get_description(), page_width) + '\n';
}

std::string HelpFormatter::make_subcommand(const CLI::App* app) const {
    std::ostringstream line;
    CLI::detail::format_help(line, app->get_name(),
                             wrap(app->get_description(), page_width - column_width_),
                             column_width_);
    return line.str();
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
    return wrap(option->get_description(), page_width - column_width_);
}

ThreadTeam::ThreadTeam(std::uint32_t count) {
    for (std::uint32_t i = 1; i < count; ++i) {
        threads_.emplace_back([this] { work(); });
    }
}

ThreadTeam::~ThreadTeam() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    begun_.notify_all();
    for (std::thread& thread : threads_) {
        thread.join();
    }
}

JobSystem ThreadTeam::jobs() {
    const auto threads = static_cast<std::uint32_t>(threads_.size()) + 1;
    // Twice as many jobs as threads even out queries of different cost.
    return {this, std::min(2 * threads, max_jobs),
            [](void* user, std::uint32_t jobs, Job job, void* data) {
                static_cast<ThreadTeam*>(user)->run(jobs, job, data);
            }};
}

void ThreadTeam::run(std::uint32_t jobs, Job job, void* data) {
    {
        const std::lock_guard lock(mutex_);
        job_ = job;
        data_ = data;
        count_ = jobs;
        next_ = 0;
        working_ = static_cast<std::uint32_t>(threads_.size());
        ++round_;
    }
    begun_.notify_all();
    take_jobs();
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [this] { return working_ == 0; });
}

void ThreadTeam::take_jobs() {
    for (std::uint32_t number = next_++; number < count_; number = next_++) {
        job_(data_, number);
    }
}

void ThreadTeam::work() {
    std::uint64_t done = 0;
    std::unique_lock lock(mutex_);
    for (;;) {
        begun_.wait(lock, [&] { return over_ || round_ != done; });
        if (over_) {
            return;
        }
        done = round_;
        lock.unlock();
        take_jobs();
        lock.lock();
        if (--working_ == 0) {
            ended_.notify_one();
        }
    }
}

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

AskedTechniques techniques_of(const Scene& scene) {
    AskedTechniques asked;
    for (const SceneQuery& query : scene.queries) {
        if (!query.problem.empty()) {
            continue;
        }
        if (is_for_device_pairs(query)) {
            asked.add(Technique::compute);
        } else if (!query.world) {
            asked.add(query.request);
        } else if (technique_problem(*query.world).empty()) {
            asked.add(answering_technique(*query.world));
        }
    }
    return asked;
}

Context open_context(Settings settings, const AskedTechniques& asked) {
    const bool automatic = asked.has(Technique::automatic);
    const bool raster = asked.has(Technique::raster);
    const bool compute = asked.has(Technique::compute);
    if (!automatic && !raster && !compute) {
        return take(Context::create_cpu(settings));
    }
    settings.techniques = {.raster = automatic || raster, .compute = automatic || compute};
    settings.pipelines_on_demand = true;
    Expected<Context> context = Context::create_headless({}, settings);
    const StatusCode code = context.error().code();
    if ((code == StatusCode::no_device || code == StatusCode::unsupported_device) && !raster &&
        !compute) {
        std::cerr << "nearfield: without a device, by the CPU alone: " << context.error().text()
                  << '\n';
        return take(Context::create_cpu(settings));
    }
    return take(std::move(context));
}

}  // namespace nearfield::tools
