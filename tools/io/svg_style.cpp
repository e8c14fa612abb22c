#include <tools/io/svg_style.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>

namespace nearfield::tools {
namespace {

/// The properties that can change an outline, or where it is.
constexpr std::array<std::string_view, 24> geometry_properties{"fill-rule",
                                                               "display",
                                                               "visibility",
                                                               "transform",
                                                               "transform-origin",
                                                               "transform-box",
                                                               "clip-path",
                                                               "mask",
                                                               "d",
                                                               "x",
                                                               "y",
                                                               "cx",
                                                               "cy",
                                                               "r",
                                                               "rx",
                                                               "ry",
                                                               "width",
                                                               "height",
                                                               "translate",
                                                               "rotate",
                                                               "scale",
                                                               "zoom",
                                                               "offset-path",
                                                               "content-visibility"};

/// Those that are lengths.
constexpr std::array<std::string_view, 9> lengths{"x",  "y",  "cx",    "cy",    "r",
                                                  "rx", "ry", "width", "height"};

/// True of a number without a unit that is not 0, which in CSS is no length.
bool lacks_unit(std::string_view value) {
    value.remove_prefix(value.starts_with('+') ? 1 : 0);
    double number = 0.0;
    const char* const end = value.data() + value.size();
    const auto [read, error] = std::from_chars(value.data(), end, number);
    return error == std::errc() && read == end && number != 0.0;
}

/// True of a declaration that counts: an invalid one leaves those before it as they are.
bool is_read(const SvgDeclaration& declaration) {
    const auto is_among = [&](const auto& names) {
        return std::find(names.begin(), names.end(), declaration.name) != names.end();
    };
    return is_among(geometry_properties) && !(is_among(lengths) && lacks_unit(declaration.value));
}

std::string lower_case(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return result;
}

bool is_name_character(char c) {
    return is_letter(c) || is_digit(c) || c == '-' || c == '_' ||
           static_cast<unsigned char>(c) >= 0x80;
}

/// The position of the first of some characters that is neither in quotes nor in parentheses, or
/// the size of the text.
std::size_t find_outside(std::string_view text, std::string_view set, std::size_t from = 0) {
    char quote = '\0';
    std::size_t open = 0;
    for (std::size_t i = from; i < text.size(); ++i) {
        const char c = text[i];
        if (quote != '\0') {
            quote = c == quote ? '\0' : quote;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '(') {
            ++open;
        } else if (c == ')' && open > 0) {
            --open;
        } else if (open == 0 && set.find(c) != std::string_view::npos) {
            return i;
        }
    }
    return text.size();
}

/// The position of the brace that closes the block that begins at a position, or the size.
std::size_t end_of_block(std::string_view text, std::size_t begin) {
    std::size_t depth = 1;
    for (std::size_t i = begin; i < text.size(); ++i) {
        i = find_outside(text, "{}", i);
        if (i == text.size()) {
            break;
        }
        depth = text[i] == '{' ? depth + 1 : depth - 1;
        if (depth == 0) {
            return i;
        }
    }
    return text.size();
}

}  // namespace

void blank_css_comments(char* text, std::size_t size) {
    const std::string_view all(text, size);
    for (std::size_t begin = all.find("/*"); begin != std::string_view::npos;
         begin = all.find("/*", begin)) {
        const std::size_t close = all.find("*/", begin + 2);
        const std::size_t end = close == std::string_view::npos ? size : close + 2;
        std::fill(text + begin, text + end, ' ');
    }
}

std::vector<SvgDeclaration> parse_svg_declarations(std::string_view text) {
    std::vector<SvgDeclaration> declarations;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = find_outside(text, ";", begin);
        const std::string_view one = text.substr(begin, end - begin);
        begin = end + 1;
        const std::size_t colon = one.find(':');
        if (colon == std::string_view::npos) {
            continue;
        }
        SvgDeclaration declaration{.name = lower_case(without_spaces(one.substr(0, colon))),
                                   .value = without_spaces(one.substr(colon + 1))};
        if (const std::size_t mark = declaration.value.rfind('!');
            mark != std::string_view::npos &&
            lower_case(without_spaces(declaration.value.substr(mark + 1))) == "important") {
            declaration.value = without_spaces(declaration.value.substr(0, mark));
            declaration.important = true;
        }
        if (is_read(declaration)) {
            declarations.push_back(std::move(declaration));
        }
    }
    return declarations;
}

bool SvgStyleSheet::Selector::matches(const SvgElementNames& element) const {
    if ((!type.empty() && type != element.type) || (!id.empty() && id != element.id)) {
        return false;
    }
    return std::all_of(classes.begin(), classes.end(), [&](std::string_view name) {
        for (std::size_t at = element.classes.find(name); at != std::string_view::npos;
             at = element.classes.find(name, at + 1)) {
            const std::size_t end = at + name.size();
            if ((at == 0 || is_space(element.classes[at - 1])) &&
                (end == element.classes.size() || is_space(element.classes[end]))) {
                return true;
            }
        }
        return false;
    });
}

std::optional<SvgStyleSheet::Selector> SvgStyleSheet::parse_selector(std::string_view text) {
    Selector selector;
    std::size_t at = 0;
    const auto name = [&] {
        const std::size_t begin = at;
        while (at < text.size() && is_name_character(text[at])) {
            ++at;
        }
        return text.substr(begin, at - begin);
    };
    if (text.starts_with('*')) {
        ++at;
    } else {
        selector.type = name();
        selector.specificity = selector.type.empty() ? 0 : 1;
    }
    while (at < text.size()) {
        const char mark = text[at++];
        const std::string_view named = name();
        if (named.empty() || (mark != '.' && mark != '#') ||
            (mark == '#' && !selector.id.empty())) {
            return std::nullopt;
        }
        if (mark == '.') {
            selector.classes.push_back(named);
            selector.specificity += 100;
        } else {
            selector.id = named;
            selector.specificity += 10000;
        }
    }
    return text.empty() ? std::nullopt : std::optional(std::move(selector));
}

bool SvgStyleSheet::add_selectors(std::string_view list) {
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        std::optional<Selector> selector =
            parse_selector(without_spaces(list.substr(begin, end - begin)));
        if (!selector) {
            return false;
        }
        selector->rule = rules_.size();
        std::string_view key = "*";
        if (!selector->id.empty()) {
            key = selector->id;
        } else if (!selector->classes.empty()) {
            key = selector->classes.front();
        } else if (!selector->type.empty()) {
            key = selector->type;
        }
        selectors_[key].push_back(std::move(*selector));
        begin = end + 1;
    }
    return true;
}

std::optional<SvgStyleSheet::Unread> SvgStyleSheet::add_rules(std::string_view text,
                                                              int conditions) {
    constexpr int most_conditions = 16;  // untrusted input must not exhaust the stack
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t open = find_outside(text, "{;", begin);
        std::string_view head = without_spaces(text.substr(begin, open - begin));
        for (const std::string_view mark : {"<!--", "-->"}) {  // allowed around a style sheet
            if (head.starts_with(mark)) {
                head = without_spaces(head.substr(mark.size()));
            }
        }
        if (open == text.size() || text[open] == ';') {
            begin = open + 1;
            continue;
        }
        const std::size_t end = end_of_block(text, open + 1);
        const std::string_view block = text.substr(open + 1, end - open - 1);
        begin = end + 1;
        if (head.starts_with('@')) {
            const bool has_rules = head.starts_with("@media") || head.starts_with("@supports") ||
                                   head.starts_with("@layer") || head.starts_with("@container");
            if (!has_rules) {
                continue;
            }
            if (conditions == most_conditions) {
                return Unread{head};
            }
            if (const std::optional<Unread> unread = add_rules(block, conditions + 1)) {
                return unread;
            }
            continue;
        }
        std::vector<SvgDeclaration> declarations = parse_svg_declarations(block);
        if (declarations.empty()) {
            continue;
        }
        if (conditions > 0 || !add_selectors(head)) {
            return Unread{head};
        }
        rules_.push_back(std::move(declarations));
    }
    return std::nullopt;
}

std::optional<SvgStyleSheet::Unread> SvgStyleSheet::add(std::string_view text) {
    return add_rules(text, 0);
}

const SvgDeclaration* SvgStyleSheet::find(const SvgElementNames& element,
                                          std::string_view property) const {
    const SvgDeclaration* best = nullptr;
    std::pair<int, std::size_t> best_rank;
    const auto look_up = [&](std::string_view key) {
        const auto found = selectors_.find(key);
        if (found == selectors_.end()) {
            return;
        }
        for (const Selector& selector : found->second) {
            if (!selector.matches(element)) {
                continue;
            }
            for (const SvgDeclaration& declaration : rules_[selector.rule]) {
                const std::pair rank{selector.specificity + (declaration.important ? 1 << 30 : 0),
                                     selector.rule};
                if (declaration.name == property && (best == nullptr || rank >= best_rank)) {
                    best = &declaration;
                    best_rank = rank;
                }
            }
        }
    };
    if (selectors_.empty()) {
        return nullptr;
    }
    look_up("*");
    look_up(element.type);
    look_up(element.id);
    for (std::size_t begin = 0; begin < element.classes.size();) {
        const std::size_t end =
            std::min(element.classes.find_first_of(" \t\r\n", begin), element.classes.size());
        look_up(element.classes.substr(begin, end - begin));
        begin = end + 1;
    }
    return best;
}

}  // namespace nearfield::tools
