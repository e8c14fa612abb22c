#pragma once

#include <pugixml.hpp>

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace nearfield::tools {

/// The text of an XML file in which references to the entities that its document type declares
/// (<!ENTITY name "text">) are replaced by their texts. References to characters, and to what is
/// not declared there, stay.
class ExpandedXml {
public:
    /// Throws InputError where the texts refer to each other in a circle, or are too long together.
    ExpandedXml(std::string_view text, const std::string& file);

    /// The text; it leaves this object, which still knows its places.
    [[nodiscard]] std::string take_text() noexcept { return std::move(text_); }
    /// The offset in the file of a byte of the text: of the reference, where it comes from one.
    [[nodiscard]] std::size_t offset_in_file(std::size_t offset) const;

private:
    std::string text_;
    /// Offsets in the text and in the file of what is copied and of what a reference stands for, by
    /// turns; the former comes first.
    std::vector<std::pair<std::size_t, std::size_t>> copies_;
};

}  // namespace nearfield::tools

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

/// Reads a value of an SVG file (path data, a list of transforms, a number) from front to back, and
/// reports positions in the file.
class SvgText {
public:
    /// `value` begins at byte `offset` of `document`; both, and `file`, must outlive this.
    SvgText(std::string_view value, std::size_t offset, std::string_view document,
            const std::string& file)
        : value_(value), offset_(offset), document_(document), file_(&file) {}

    /// Throws InputError with file, line and column of a byte of the value.
    [[noreturn]] void fail(std::size_t position, const std::string& reason) const;
    [[noreturn]] void fail(const std::string& reason) const { fail(position_, reason); }

    [[nodiscard]] std::size_t position() const noexcept { return position_; }

    /// The next character, 0 at the end.
    [[nodiscard]] char peek() const noexcept {
        return position_ < value_.size() ? value_[position_] : '\0';
    }
    void advance() noexcept { ++position_; }

    void skip_space();
    /// Space with at most one comma in it.
    void skip_separator();
    /// True if a number could begin next.
    [[nodiscard]] bool number_follows() const noexcept;
    /// Reads letters up to the first other character.
    [[nodiscard]] std::string word();
    void expect(char expected);

    /// Reads a finite number. It ends where the grammar ends it: ".5.5" and "1-2" are two.
    [[nodiscard]] double number();
    /// Reads a single digit 0 or 1: "11" are two flags.
    [[nodiscard]] bool flag();
    /// Reads a separator and a number.
    [[nodiscard]] double next_number() {
        skip_separator();
        return number();
    }

private:
    std::string_view value_;
    std::size_t offset_;
    std::string_view document_;
    const std::string* file_;
    std::size_t position_ = 0;
};

/// True of a name that a list holds.
[[nodiscard]] bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names);

/// The name of an element without its prefix; of one that is not in the namespace of SVG a name
/// with a colon. An element without a prefix in a file that declares no namespace is of SVG.
[[nodiscard]] std::string_view local_name(const pugi::xml_node& node);

/// A parsed SVG file: elements, their ids and their properties by attributes and CSS. Every value
/// knows its place in the file. Not thread-safe.
class SvgDocument {
public:
    /// Both must outlive this. Throws InputError where the text is not XML, not SVG, or has a style
    /// sheet that matters to geometry and is not read.
    SvgDocument(const std::string& text, const std::string& file);
    SvgDocument(const SvgDocument&) = delete;
    SvgDocument& operator=(const SvgDocument&) = delete;

    /// The outermost svg element.
    [[nodiscard]] pugi::xml_node root() const { return document_.document_element(); }
    /// The first element with an id; a null node if there is none.
    [[nodiscard]] pugi::xml_node find(std::string_view id) const;
    /// The element that the fragment of a reference names: as it stands, or percent-decoded.
    [[nodiscard]] pugi::xml_node find_reference(std::string_view fragment) const;

    /// Throws InputError with the place and the name of an element.
    [[noreturn]] void fail(const pugi::xml_node& node, const std::string& reason) const;

    /// An attribute; nothing if it is not there.
    [[nodiscard]] std::optional<SvgText> attribute(const pugi::xml_node& node,
                                                   const char* name) const;
    /// A property by the element's style, by a style sheet or as an attribute; nothing where it is
    /// not set.
    [[nodiscard]] std::optional<SvgText> property(const pugi::xml_node& node,
                                                  const char* name) const;
    /// Likewise, by the element's style or a style sheet alone.
    [[nodiscard]] std::optional<std::string_view> styled(const pugi::xml_node& node,
                                                         const char* name) const;
    /// The text of a property, trimmed; empty where it is not set.
    [[nodiscard]] std::string_view word(const pugi::xml_node& node, const char* name) const;

private:
    [[noreturn]] void fail(std::size_t offset, const std::string& reason) const;
    [[nodiscard]] std::size_t offset_of(const char* in_buffer) const;
    [[nodiscard]] SvgText text_at(std::string_view in_buffer) const;
    void blank_comments(const char* in_buffer);
    void index();
    void add_style_sheet(const pugi::xml_node& style);

    const std::string& text_;
    const std::string& file_;
    ExpandedXml expanded_;
    std::string buffer_;
    pugi::xml_document document_;
    std::unordered_map<std::string_view, pugi::xml_node> ids_;
    SvgStyleSheet sheet_;
    // Several properties of one element are asked for in a row.
    mutable pugi::xml_node styled_node_;
    mutable std::vector<SvgDeclaration> styles_;
};

}  // namespace nearfield::tools
