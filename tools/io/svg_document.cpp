#include <tools/io/input_error.hpp>
#include <tools/io/svg_document.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>

namespace nearfield::tools {

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
