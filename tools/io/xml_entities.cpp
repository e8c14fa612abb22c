#include <tools/io/input_error.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/values.hpp>
#include <tools/io/xml_entities.hpp>

#include <algorithm>
#include <map>
#include <optional>

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

}  // namespace nearfield::tools
