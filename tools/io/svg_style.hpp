#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

/// \file
/// The part of CSS that decides about geometry in SVG files.

namespace nearfield::tools {

/// A declaration of a property that matters to geometry: "fill-rule: evenodd".
struct SvgDeclaration {
    std::string name;        ///< in lower case
    std::string_view value;  ///< trimmed, without "!important"; a part of the text that was parsed
    bool important = false;
};

/// The declarations of a style attribute or of a rule, in order, but those of colours, strokes,
/// fonts and so on. Comments have to be blanked before.
[[nodiscard]] std::vector<SvgDeclaration> parse_svg_declarations(std::string_view text);

/// Replaces the comments in a text by spaces.
void blank_css_comments(char* text, std::size_t size);

/// What a selector sees of an element.
struct SvgElementNames {
    std::string_view type;
    std::string_view id;
    std::string_view classes;  ///< separated by spaces
};

/// The rules of all style sheets of a file, as far as they matter to geometry.
class SvgStyleSheet {
public:
    /// What is not read: a selector other than types, classes, ids and lists of them, or a
    /// condition, of a rule that matters to geometry.
    struct Unread {
        std::string_view selector;  ///< a part of the text
    };

    /// Adds the rules of a style element, whose text must outlive this. Returns the first selector
    /// that is not read.
    [[nodiscard]] std::optional<Unread> add(std::string_view text);

    /// The declaration of a property that counts for an element; null if there is none.
    [[nodiscard]] const SvgDeclaration* find(const SvgElementNames& element,
                                             std::string_view property) const;

private:
    /// One alternative of a selector list: "path.bin#b1".
    struct Selector {
        std::string_view type;  ///< empty: any
        std::string_view id;    ///< empty: any
        std::vector<std::string_view> classes;
        int specificity = 0;
        std::size_t rule = 0;

        [[nodiscard]] bool matches(const SvgElementNames& element) const;
    };

    [[nodiscard]] std::optional<Unread> add_rules(std::string_view text, int conditions);
    [[nodiscard]] bool add_selectors(std::string_view list);
    [[nodiscard]] static std::optional<Selector> parse_selector(std::string_view text);

    std::vector<std::vector<SvgDeclaration>> rules_;
    /// By id, by a class or by type, whichever there is first; those of any element by "*".
    std::unordered_map<std::string_view, std::vector<Selector>> selectors_;
};

}  // namespace nearfield::tools
