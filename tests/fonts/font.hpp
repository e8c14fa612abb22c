#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

struct FT_FaceRec_;
struct FT_LibraryRec_;

namespace nearfield::test {

/// The outlines of a font's glyphs, read by FreeType.
class Font {
public:
    /// Throws std::runtime_error if FreeType does not read the file.
    explicit Font(const std::filesystem::path& file);

    /// Code points with a glyph, in ascending order.
    [[nodiscard]] std::vector<unsigned long> characters() const;

    /// The contours of the characters' glyphs beside each other as SVG path data (y down), in units
    /// of the font, as they are: contours may overlap. Empty for spaces.
    [[nodiscard]] std::string path(const std::vector<unsigned long>& text) const;

    /// The units of the font's em square.
    [[nodiscard]] double em() const;

private:
    std::shared_ptr<FT_LibraryRec_> library_;
    std::shared_ptr<FT_FaceRec_> face_;
};

}  // namespace nearfield::test
