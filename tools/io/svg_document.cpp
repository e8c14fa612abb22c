#include <tools/io/input_error.hpp>
#include <tools/io/svg_document.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <system_error>

namespace nearfield::tools {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 22U;  // of all replaced: they can multiply
constexpr int deepest_reference = 16;

bool is_in_name(char c) {
    return is_letter(c) || is_digit(c) || c == '-' || c == '_' || c == '.' || c == ':' ||
           static_cast<unsigned char>(c) >= 0x80;
}

std::size_t skip_space(std::string_view text, std::size_t at) {
    while (at < text.size() && is_space(text[at])) {
        ++at;
    }
    return at;
}

std::string_view name_at(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && is_in_name(text[end])) {
        ++end;
    }
    return text.substr(at, end - at);
}

/// Where what holds no references ends, if it begins here: a comment or a CDATA section.
std::optional<std::size_t> end_of_verbatim(std::string_view text, std::size_t at) {
    for (const auto& [begin, end] :
         {std::pair<std::string_view, std::string_view>{"<!--", "-->"}, {"<![CDATA[", "]]>"}}) {
        if (text.substr(at, begin.size()) == begin) {
            const std::size_t found = text.find(end, at + begin.size());
            return found == std::string_view::npos ? text.size() : found + end.size();
        }
    }
    return std::nullopt;
}

/// The internal part of the document type, between its brackets; empty where there is none.
std::string_view internal_subset(std::string_view text) {
    const std::size_t type = text.find("<!DOCTYPE");
    if (type == std::string_view::npos) {
        return {};
    }
    const std::size_t open = text.find_first_of("[>", type);
    if (open == std::string_view::npos || text[open] == '>') {
        return {};
    }
    char quote = '\0';
    for (std::size_t at = open + 1; at < text.size(); ++at) {
        if (quote != '\0') {
            quote = text[at] == quote ? '\0' : quote;
        } else if (const auto end = end_of_verbatim(text, at)) {
            at = *end - 1;
        } else if (text[at] == '"' || text[at] == '\'') {
            quote = text[at];
        } else if (text[at] == ']') {
            return text.substr(open + 1, at - open - 1);
        }
    }
    return {};
}

using Entities = std::map<std::string_view, std::string_view>;

/// The entities with a text of their own; others stand in other files.
Entities entities_of(std::string_view subset) {
    constexpr std::string_view begin = "<!ENTITY";
    Entities entities;
    for (std::size_t at = subset.find(begin); at != std::string_view::npos;
         at = subset.find(begin, at + begin.size())) {
        const std::size_t start = skip_space(subset, at + begin.size());
        const std::string_view name = name_at(subset, start);
        const std::size_t quote = skip_space(subset, start + name.size());
        if (name.empty() || quote >= subset.size() ||
            (subset[quote] != '"' && subset[quote] != '\'')) {
            continue;
        }
        const std::size_t end = subset.find(subset[quote], quote + 1);
        if (end != std::string_view::npos) {
            entities.try_emplace(name, subset.substr(quote + 1, end - quote - 1));
        }
    }
    return entities;
}

class Expander {
public:
    Expander(const Entities& entities, std::string_view document, const std::string& file)
        : entities_(entities), document_(document), file_(file) {}

    /// The text of the reference that begins at a byte of a text, and how long the reference is;
    /// nothing if it is none to an entity that is declared.
    [[nodiscard]] const std::string_view* find(std::string_view text, std::size_t at,
                                               std::size_t& length) const {
        const std::string_view name = name_at(text, at + 1);
        const std::size_t end = at + 1 + name.size();
        const auto found = entities_.find(name);
        if (found == entities_.end() || end >= text.size() || text[end] != ';') {
            return nullptr;
        }
        length = name.size() + 2;
        return &found->second;
    }

    /// Appends a text with all references in it replaced. `offset`: in the file, for errors.
    void append(std::string_view text, int depth, std::size_t offset, std::string& to) {
        replaced_ += text.size();
        if (depth > deepest_reference || replaced_ > most_bytes) {
            throw InputError(text_position(file_, document_, offset) +
                             ": entities refer to each other too often");
        }
        for (std::size_t at = 0; at < text.size();) {
            std::size_t length = 0;
            const std::string_view* const entity =
                text[at] == '&' ? find(text, at, length) : nullptr;
            if (entity != nullptr) {
                append(*entity, depth + 1, offset, to);
                at += length;
            } else {
                to += text[at++];
            }
        }
    }

private:
    const Entities& entities_;
    std::string_view document_;
    const std::string& file_;
    std::size_t replaced_ = 0;  // bytes
};

}  // namespace

ExpandedXml::ExpandedXml(std::string_view text, const std::string& file) {
    copies_.emplace_back(0, 0);
    const std::string_view subset = internal_subset(text);
    const Entities entities = entities_of(subset);
    if (entities.empty()) {
        text_ = text;
        return;
    }
    Expander expander(entities, text, file);
    const auto begin = static_cast<std::size_t>(subset.data() - text.data()) + subset.size();
    text_ = text.substr(0, begin);
    for (std::size_t at = begin; at < text.size();) {
        if (const auto end = end_of_verbatim(text, at)) {
            text_ += text.substr(at, *end - at);
            at = *end;
            continue;
        }
        std::size_t length = 0;
        const std::string_view* const entity =
            text[at] == '&' ? expander.find(text, at, length) : nullptr;
        if (entity == nullptr) {
            text_ += text[at++];
            continue;
        }
        copies_.emplace_back(text_.size(), at);
        expander.append(*entity, 1, at, text_);
        at += length;
        copies_.emplace_back(text_.size(), at);
    }
}

std::size_t ExpandedXml::offset_in_file(std::size_t offset) const {
    const auto after =
        std::upper_bound(copies_.begin(), copies_.end(), offset,
                         [](std::size_t value, const auto& copy) { return value < copy.first; });
    const auto index = static_cast<std::size_t>(after - copies_.begin()) - 1;
    const auto& [in_text, in_file] = copies_[index];
    // Every second one is a reference, all of whose text stands where it does.
    return index % 2 == 1 ? in_file : in_file + (offset - in_text);
}

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

void SvgText::fail(std::size_t position, const std::string& reason) const {
    throw InputError(text_position(*file_, document_, offset_ + position) + ": " + reason);
}

void SvgText::skip_space() {
    while (is_space(peek())) {
        advance();
    }
}

void SvgText::skip_separator() {
    skip_space();
    if (peek() == ',') {
        advance();
        skip_space();
    }
}

bool SvgText::number_follows() const noexcept {
    return is_digit(peek()) || peek() == '.' || peek() == '-' || peek() == '+';
}

std::string SvgText::word() {
    std::string letters;
    while (is_letter(peek())) {
        letters += peek();
        advance();
    }
    return letters;
}

void SvgText::expect(char expected) {
    skip_space();
    if (peek() != expected) {
        fail(std::string("expected '") + expected + "'" +
             (position_ < value_.size() ? "" : " before the end"));
    }
    advance();
}

double SvgText::number() {
    std::size_t first = position_;
    if (peek() == '+') {
        ++first;  // allowed by SVG, not by from_chars
    }
    // The forms that from_chars accepts beyond the grammar (inf, nan, a sign after the plus) begin
    // differently.
    const std::size_t digits = peek() == '-' ? first + 1 : first;
    const std::size_t fraction =
        digits < value_.size() && value_[digits] == '.' ? digits + 1 : digits;
    if (fraction >= value_.size() || !is_digit(value_[fraction])) {
        fail(position_ < value_.size() ? "expected a number"
                                       : "the value ends where a number is expected");
    }
    double number = 0.0;
    const auto [rest, error] =
        std::from_chars(value_.data() + first, value_.data() + value_.size(), number);
    if (error != std::errc{} || !std::isfinite(number)) {
        fail("a number too large or too small for double precision");
    }
    position_ = static_cast<std::size_t>(rest - value_.data());
    return number;
}

bool SvgText::flag() {
    const char c = peek();
    if (c != '0' && c != '1') {
        fail("expected a flag, 0 or 1");
    }
    advance();
    return c == '1';
}

constexpr std::string_view svg_namespace = "http://www.w3.org/2000/svg";

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

namespace {

/// The namespace of a prefix, which may be empty, at an element; nothing where none is declared.
std::optional<std::string_view> namespace_of(const pugi::xml_node& node, std::string_view prefix) {
    const std::string name = prefix.empty() ? "xmlns" : "xmlns:" + std::string(prefix);
    for (pugi::xml_node around = node; around; around = around.parent()) {
        if (const pugi::xml_attribute declared = around.attribute(name.c_str())) {
            return without_spaces(declared.value());
        }
    }
    return std::nullopt;
}

/// "a b" of "a%20b". A percent sign without two hexadecimal digits stays.
std::string percent_decoded(std::string_view text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        const char* const digits = text.data() + i + 1;
        if (text[i] == '%' && i + 2 < text.size() &&
            std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2) {
            decoded += static_cast<char>(value);
            i += 2;
        } else {
            decoded += text[i];
        }
    }
    return decoded;
}

}  // namespace

std::string_view local_name(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    const std::size_t colon = name.find(':');
    const std::string_view prefix = name.substr(0, colon == std::string_view::npos ? 0 : colon);
    const std::string_view space =
        namespace_of(node, prefix).value_or(is_one_of(prefix, {"", "svg"}) ? svg_namespace : "");
    if (space == svg_namespace) {
        return prefix.empty() ? name : name.substr(colon + 1);
    }
    return prefix.empty() ? ":" : name;
}

SvgDocument::SvgDocument(const std::string& text, const std::string& file)
    // Parses in place, so that every name and value has its offset in the buffer, up to the
    // references to characters before it in the same value.
    : text_(text), file_(file), expanded_(text, file), buffer_(expanded_.take_text()) {
    const pugi::xml_parse_result result = document_.load_buffer_inplace(
        buffer_.data(), buffer_.size(),
        pugi::parse_minimal | pugi::parse_cdata | pugi::parse_escapes);
    if (!result) {
        fail(expanded_.offset_in_file(static_cast<std::size_t>(result.offset)),
             std::string("not XML: ") + result.description());
    }
    if (local_name(root()) != "svg") {
        const std::string_view name = root().name();
        fail(offset_of(root().name()),
             name == "svg" ? "the outermost element, svg, is not in the namespace of SVG"
                           : "the outermost element is \"" + std::string(name) + "\", not svg");
    }
    const pugi::xml_node second = root().next_sibling();
    if (second) {
        fail(offset_of(second.name()), "not XML: a second outermost element");
    }
    index();
}

void SvgDocument::fail(std::size_t offset, const std::string& reason) const {
    throw InputError(text_position(file_, text_, offset) + ": " + reason);
}

void SvgDocument::fail(const pugi::xml_node& node, const std::string& reason) const {
    fail(offset_of(node.name()), std::string(node.name()) + ": " + reason);
}

std::size_t SvgDocument::offset_of(const char* in_buffer) const {
    return expanded_.offset_in_file(static_cast<std::size_t>(in_buffer - buffer_.data()));
}

SvgText SvgDocument::text_at(std::string_view in_buffer) const {
    return {in_buffer, offset_of(in_buffer.data()), text_, file_};
}

void SvgDocument::blank_comments(const char* in_buffer) {
    if (std::strstr(in_buffer, "/*") != nullptr) {
        blank_css_comments(buffer_.data() + (in_buffer - buffer_.data()), std::strlen(in_buffer));
    }
}

void SvgDocument::index() {
    for (pugi::xml_node node = root(); node;) {
        if (const pugi::xml_attribute id = node.attribute("id")) {
            ids_.try_emplace(id.value(), node);
        }
        if (const pugi::xml_attribute style = node.attribute("style")) {
            blank_comments(style.value());
        }
        if (local_name(node) == "style") {
            add_style_sheet(node);
        }
        if (node.first_child()) {
            node = node.first_child();
            continue;
        }
        while (node && node != root() && !node.next_sibling()) {
            node = node.parent();
        }
        node = node == root() ? pugi::xml_node() : node.next_sibling();
    }
}

void SvgDocument::add_style_sheet(const pugi::xml_node& style) {
    for (const pugi::xml_node& part : style.children()) {
        if (part.type() != pugi::node_pcdata && part.type() != pugi::node_cdata) {
            continue;
        }
        blank_comments(part.value());
        if (const auto unread = sheet_.add(part.value())) {
            fail(offset_of(unread->selector.data()),
                 "the rule \"" + std::string(unread->selector) +
                     "\" matters to geometry; only those of elements, classes and ids are read");
        }
    }
}

pugi::xml_node SvgDocument::find(std::string_view id) const {
    const auto found = ids_.find(id);
    return found == ids_.end() ? pugi::xml_node() : found->second;
}

pugi::xml_node SvgDocument::find_reference(std::string_view fragment) const {
    if (const pugi::xml_node found = find(fragment)) {
        return found;
    }
    return find(percent_decoded(fragment));
}

std::optional<SvgText> SvgDocument::attribute(const pugi::xml_node& node, const char* name) const {
    const pugi::xml_attribute found = node.attribute(name);
    if (!found) {
        return std::nullopt;
    }
    const std::string_view value = found.value();
    // An empty value may be outside the buffer.
    return value.empty() ? SvgText(value, offset_of(found.name()), text_, file_) : text_at(value);
}

std::optional<std::string_view> SvgDocument::styled(const pugi::xml_node& node,
                                                    const char* name) const {
    const SvgDeclaration* found = sheet_.find(
        {local_name(node), node.attribute("id").value(), node.attribute("class").value()}, name);
    if (node != styled_node_) {
        styled_node_ = node;
        styles_ = parse_svg_declarations(node.attribute("style").value());
    }
    const SvgDeclaration* own = nullptr;
    for (const SvgDeclaration& declaration : styles_) {
        if (declaration.name == name &&
            (own == nullptr || declaration.important >= own->important)) {
            own = &declaration;
        }
    }
    if (own != nullptr && (found == nullptr || own->important >= found->important)) {
        return own->value;
    }
    return found != nullptr ? std::optional(found->value) : std::nullopt;
}

std::optional<SvgText> SvgDocument::property(const pugi::xml_node& node, const char* name) const {
    const std::optional<std::string_view> value = styled(node, name);
    if (!value) {
        return attribute(node, name);
    }
    return value->empty() ? SvgText(*value, offset_of(node.name()), text_, file_) : text_at(*value);
}

std::string_view SvgDocument::word(const pugi::xml_node& node, const char* name) const {
    const std::optional<std::string_view> value = styled(node, name);
    return without_spaces(value ? *value : std::string_view(node.attribute(name).value()));
}

}  // namespace nearfield::tools
