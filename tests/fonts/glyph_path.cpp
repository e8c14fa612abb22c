// Prints the outlines of a text's glyphs as SVG path data: what docs/images/glyphs.png shows.
//
//     glyph_path FONT U+0041 U+0042 ... > glyphs.path

#include "font.hpp"

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: glyph_path FONT U+CODE...\n");
        return 2;
    }
    try {
        std::vector<unsigned long> text;
        for (int i = 2; i < argc; ++i) {
            const std::string code = argv[i];
            text.push_back(std::stoul(code.substr(code.starts_with("U+") ? 2 : 0), nullptr, 16));
        }
        std::printf("%s\n", nearfield::test::Font(argv[1]).path(text).c_str());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "glyph_path: %s\n", error.what());
        return 1;
    }
    return 0;
}
