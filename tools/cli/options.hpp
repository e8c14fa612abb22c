#pragma once

#include <nearfield/context.hpp>
#include <nearfield/jobs.hpp>

#include <CLI/CLI.hpp>
#include <tools/io/query_request.hpp>
#include <tools/io/scene.hpp>

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace nearfield::tools {

/// Settings that differ between the help texts of commands.
struct HelpStyle {
    std::size_t first_column = 28;          ///< width of the name column; descriptions take the
                                            ///< rest
    std::string subcommand = "COMMAND";     ///< placeholder for a subcommand in the usage line
    std::string positionals = "Arguments";  ///< heading of the positional arguments
};

/// Help in two columns with a total width of 80 characters. Descriptions are wrapped between words.
class HelpFormatter : public CLI::Formatter {
public:
    explicit HelpFormatter(const HelpStyle& style);

    std::string make_help(const CLI::App* app, std::string name,
                          CLI::AppFormatMode mode) const override;
    std::string make_description(const CLI::App* app) const override;
    std::string make_subcommand(const CLI::App* app) const override;
    std::string make_option_desc(const CLI::Option* option) const override;
};

/// A thread pool for the jobs of a context, including the calling thread; it plays the role of a
/// host's job system. Serves one context at a time.
class ThreadTeam {
public:
    /// `count`: the total number of threads, at least 1; all but the caller's are started here.
    explicit ThreadTeam(std::uint32_t count);
    /// Precondition: no jobs are running.
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    /// For Settings::jobs. The team must outlive the context.
    [[nodiscard]] JobSystem jobs();

private:
    using Job = void (*)(void* data, std::uint32_t number);

    void run(std::uint32_t jobs, Job job, void* data);
    void work();
    /// Runs jobs until none is left.
    void take_jobs();

    std::vector<std::thread> threads_;  // all but the calling thread
    std::mutex mutex_;
    std::condition_variable begun_;
    std::condition_variable ended_;
    std::uint64_t round_ = 0;  // how many times jobs were started
    std::uint32_t working_ = 0;
    bool over_ = false;
    // The current set of jobs; read by the threads that run them.
    Job job_ = nullptr;
    void* data_ = nullptr;
    std::uint32_t count_ = 0;
    std::atomic<std::uint32_t> next_ = 0;
};

/// The context settings on the command line.
struct SettingsArguments {
    std::optional<std::string> boxes;
    std::optional<std::uint32_t> height;
    std::optional<std::uint32_t> memory_limit;  ///< MiB
    std::shared_ptr<ThreadTeam> threads;        // null for one
};

/// Adds the options --boxes, --height, --memory-limit and --threads; parsing fills
/// `arguments`, which must outlive it.
void add_settings_options(CLI::App& command, SettingsArguments& arguments);

/// Converts the arguments into context settings, which use the threads of `arguments`. Throws
/// InputError.
[[nodiscard]] Settings parse_settings(const SettingsArguments& arguments);

/// What to say after an error: which option raises the limit that it names; empty for others.
[[nodiscard]] std::string memory_hint(const std::string& error);

/// The techniques that the queries of a command request.
class AskedTechniques {
public:
    void add(Technique technique) { bits_ |= bit(technique); }
    /// Queries that only the CPU answers need no device, whatever technique they request.
    void add(const QueryRequest& request) {
        add(is_sampled(request.type) ? technique_of(request) : Technique::cpu);
    }
    [[nodiscard]] bool has(Technique technique) const { return (bits_ & bit(technique)) != 0; }

private:
    [[nodiscard]] static unsigned bit(Technique technique) {
        return 1U << static_cast<unsigned>(technique);
    }

    unsigned bits_ = 0;
};

[[nodiscard]] AskedTechniques techniques_of(const Scene& scene);

/// Creates a context with pipelines for the requested techniques, and without a device if none is
/// needed. If only Technique::automatic requests a device and none is usable, it prints a notice to
/// standard error and runs everything on the CPU. Throws LibraryError.
[[nodiscard]] Context open_context(Settings settings, const AskedTechniques& asked);

}  // namespace nearfield::tools
