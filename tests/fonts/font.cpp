#include "font.hpp"

// clang-format off
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
// clang-format on

#include <stdexcept>
#include <utility>

namespace nearfield::test {
namespace {

void require(FT_Error error, const std::string& what) {
    if (error != 0) {
        throw std::runtime_error(what + ": FreeType's error " + std::to_string(error));
    }
}

/// Writes what FreeType decomposes an outline into. Units of fonts are whole numbers.
struct PathWriter {
    std::string text = {};
    FT_Pos advance = 0;

    void add(char command, std::initializer_list<const FT_Vector*> points) {
        text += command;
        for (const FT_Vector* point : points) {
            text += std::to_string(point->x + advance) + ' ' + std::to_string(-point->y) + ' ';
        }
    }

    static PathWriter& of(void* user) { return *static_cast<PathWriter*>(user); }
};

}  // namespace

Font::Font(const std::filesystem::path& file) {
    FT_Library library = nullptr;
    require(FT_Init_FreeType(&library), "FT_Init_FreeType");
    library_ = {library, [](FT_Library done) { FT_Done_FreeType(done); }};
    FT_Face face = nullptr;
    require(FT_New_Face(library, file.c_str(), 0, &face), file.string());
    face_ = {face, [](FT_Face done) { FT_Done_Face(done); }};
}

std::vector<unsigned long> Font::characters() const {
    std::vector<unsigned long> found;
    FT_UInt glyph = 0;
    for (FT_ULong character = FT_Get_First_Char(face_.get(), &glyph); glyph != 0;
         character = FT_Get_Next_Char(face_.get(), character, &glyph)) {
        found.push_back(character);
    }
    return found;
}

std::string Font::path(const std::vector<unsigned long>& text) const {
    FT_Outline_Funcs parts{};
    parts.move_to = [](const FT_Vector* to, void* user) {
        PathWriter::of(user).add('M', {to});
        return 0;
    };
    parts.line_to = [](const FT_Vector* to, void* user) {
        PathWriter::of(user).add('L', {to});
        return 0;
    };
    parts.conic_to = [](const FT_Vector* control, const FT_Vector* to, void* user) {
        PathWriter::of(user).add('Q', {control, to});
        return 0;
    };
    parts.cubic_to = [](const FT_Vector* first, const FT_Vector* second, const FT_Vector* to,
                        void* user) {
        PathWriter::of(user).add('C', {first, second, to});
        return 0;
    };
    PathWriter writer;
    for (const unsigned long character : text) {
        require(FT_Load_Char(face_.get(), character, FT_LOAD_NO_SCALE), "FT_Load_Char");
        FT_GlyphSlot glyph = face_->glyph;
        require(FT_Outline_Decompose(&glyph->outline, &parts, &writer), "FT_Outline_Decompose");
        writer.advance += glyph->advance.x;
    }
    return std::move(writer.text);
}

double Font::em() const {
    return face_->units_per_EM;
}

}  // namespace nearfield::test
