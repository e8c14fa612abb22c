#pragma once

#include <CLI/CLI.hpp>

#include <cstddef>
#include <string>

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

}  // namespace nearfield::tools
