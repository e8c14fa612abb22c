#pragma once

#include <CLI/CLI.hpp>
#include <tools/io/values.hpp>

#include <string>
#include <utility>

namespace nearfield::tools {

/// True if help is requested for a command or for one of its parents.
inline bool is_help_asked(const CLI::App& command) {
    for (const CLI::App* app = &command; app != nullptr; app = app->get_parent()) {
        if (app->get_help_ptr()->count() > 0) {
            return true;
        }
    }
    return false;
}

/// Adds an option whose text `parse(text, name)` converts into the value of `target`, which must
/// outlive the command. Exceptions from `parse` propagate out of CLI::App::parse, unless help is
/// requested.
template <class Target, class Parse>
CLI::Option* add_parsed_option(CLI::App& command, const std::string& name, Target& target,
                               Parse parse, const std::string& description) {
    return command.add_option_function<std::string>(
        name,
        [&command, &target, parse = std::move(parse), name](const std::string& text) {
            if (!is_help_asked(command)) {
                target = parse(text, name);
            }
        },
        description);
}

/// Adds an option for an integer within a range, which the help states.
template <class Target>
CLI::Option* add_count_option(CLI::App& command, const std::string& name, Target& target,
                              CountRange range, const std::string& description) {
    return add_parsed_option(
        command, name, target,
        [range](const std::string& text, const std::string& option) {
            return parse_count(text, option, range);
        },
        description + "; " + std::to_string(range.min) + " to " + std::to_string(range.max));
}

}  // namespace nearfield::tools
