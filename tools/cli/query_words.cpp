#include <tools/cli/query_words.hpp>
#include <tools/io/input_error.hpp>

#include <algorithm>
#include <cstddef>

namespace nearfield::tools {
namespace {

std::vector<const CLI::App*> kinds_of(const CLI::App& query) {
    return query.get_subcommands([](const CLI::App*) { return true; });
}

bool is_kind(const CLI::App& query, const std::string& word) {
    const std::vector<const CLI::App*> kinds = kinds_of(query);
    return std::any_of(kinds.begin(), kinds.end(),
                       [&](const CLI::App* kind) { return kind->get_name() == word; });
}

bool is_option(const std::string& word) {
    return word.size() > 1 && word.front() == '-';
}

/// The option name in a word that begins with an option: "--json=FILE", "-d0.5".
std::string option_name(const std::string& word) {
    return word.starts_with("--") ? word.substr(0, word.find('=')) : word.substr(0, 2);
}

/// Finds an option of any kind; null if no kind has it.
const CLI::Option* find_option(const CLI::App& query, const std::string& name) {
    for (const CLI::App* const kind : kinds_of(query)) {
        if (const CLI::Option* const option = kind->get_option_no_throw(name)) {
            return option;
        }
    }
    return nullptr;
}

/// The number of words from `position` on that form an option and its values, as CLI11 counts them.
std::size_t option_length(const CLI::App& query, const std::vector<std::string>& words,
                          std::size_t position) {
    const std::string& word = words[position];
    const std::string name = option_name(word);
    const CLI::Option* const option = find_option(query, name);
    if (option == nullptr || option->get_items_expected_min() == 0) {
        return 1;
    }
    const std::size_t value = name.size() + (word.starts_with("--") ? 1 : 0);  // after the =
    std::size_t length = word.size() > value ? 1 : 2;
    while (option->get_allow_extra_args() && position + length < words.size() &&
           !is_option(words[position + length]) && !is_kind(query, words[position + length])) {
        ++length;
    }
    return length;
}

/// The position of the first word from `position` on that is neither an option nor an option's
/// value.
std::size_t find_argument(const CLI::App& query, const std::vector<std::string>& words,
                          std::size_t position) {
    while (position < words.size() && is_option(words[position])) {
        if (words[position] == "--") {
            return position + 1;
        }
        position += option_length(query, words, position);
    }
    return position;
}

std::string join(const std::vector<const CLI::App*>& kinds, const std::string& separator) {
    std::string names;
    for (const CLI::App* const kind : kinds) {
        names += (names.empty() ? "" : separator) + kind->get_name();
    }
    return names;
}

/// Rejects a word that is an option of other kinds only.
void refuse_foreign_option(const CLI::App& query, const CLI::App& kind, const std::string& word) {
    const std::string name = option_name(word);
    std::vector<const CLI::App*> owners = kinds_of(query);
    std::erase_if(owners, [&](const CLI::App* other) { return !other->get_option_no_throw(name); });
    if (!owners.empty() && !kind.get_option_no_throw(name)) {
        throw InputError(name + ": belongs to " + join(owners, " and ") + ", not to " +
                         kind.get_name());
    }
}

}  // namespace

std::vector<std::string> with_kind_first(const CLI::App& query, std::vector<std::string> words) {
    const auto command = std::find_if_not(words.begin(), words.end(), is_option);
    if (command == words.end() || *command != query.get_name()) {
        return words;
    }
    const auto first = static_cast<std::size_t>(command - words.begin()) + 1;
    const std::size_t kind = find_argument(query, words, first);
    if (kind < words.size()) {
        const auto place = [&](std::size_t index) {
            return words.begin() + static_cast<std::ptrdiff_t>(index);
        };
        std::rotate(place(first), place(kind), place(kind + 1));
    }
    return words;
}

void explain_refusal(const CLI::App& query) {
    // The words in place of the kind: a valid kind, and everything after it, would not remain here.
    const std::vector<std::string> rest = query.remaining();
    if (!rest.empty() && !is_option(rest.front())) {
        throw InputError("query: \"" + rest.front() + "\" is none of the kinds " +
                         join(kinds_of(query), ", "));
    }
    const std::vector<CLI::App*> chosen = query.get_subcommands();
    if (chosen.empty()) {
        throw InputError("query: a kind is required: one of " + join(kinds_of(query), ", "));
    }
    for (const std::string& word : chosen.front()->remaining()) {
        if (is_option(word)) {
            refuse_foreign_option(query, *chosen.front(), word);
        }
    }
}

}  // namespace nearfield::tools
