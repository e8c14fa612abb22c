#pragma once

#include <CLI/CLI.hpp>

#include <cstddef>
#include <string>

namespace nearfield::tools {

/// What differs between the help of commands.
struct HelpStyle {
    std::size_t first_column = 28;          ///< characters for names; descriptions have the rest
    std::string subcommand = "COMMAND";     ///< stands for a subcommand's name in the usage line
    std::string positionals = "Arguments";  ///< heads the arguments that have no name
};

/// Help in two columns that are 80 characters wide together; descriptions are wrapped between
/// words.
class HelpFormatter : public CLI::Formatter {
public:
    explicit HelpFormatter(const HelpStyle& style);

    std::string make_help(const CLI::App* app, std::string name,
                          CLI::AppFormatMode mode) const override;
    std::string make_description(const CLI::App* app) const override;
    std::string make_subcommand(const CLI::App* app) const override;
    std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace nearfield::tools
