#include <tools/cli/help_formatter.hpp>

#include <cstddef>
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

}  // namespace nearfield::tools
