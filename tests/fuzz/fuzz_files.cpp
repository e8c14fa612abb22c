// Reads mutated files of every format as the command line does, up to the rings of shapes and the
// rows of tables, and prints a table. Any file has to be read or refused with a message that begins
// with its name; another exception, or more than two seconds of processor time, ends the run, and
// the file is written to the current folder.
//
//     fuzz_files COUNT [SEED [FILE...]]      FILE: f.svg, f.wkt, ... instead of all formats

#include "mutation.hpp"
#include "seeds.hpp"

#include <tools/io/input_error.hpp>
#include <tools/io/number_table.hpp>
#include <tools/io/outline.hpp>
#include <tools/io/scene.hpp>
#include <tools/io/shape_rings.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace {

using nearfield::tools::InputFile;

/// Reads a file in one of the ways that there are.
void read(const InputFile& file, unsigned way) {
    namespace tools = nearfield::tools;
    if (file.name == "f.json") {
        const auto bad = way % 2 == 0 ? tools::BadEntries::recorded : tools::BadEntries::refused;
        static_cast<void>(tools::read_scene(file, bad));
        return;
    }
    if (file.name == "f.csv" || file.name == "f.npy") {
        const unsigned columns = way % 4 == 3 ? 4 : 3;  // of sweeps' segments, of poses
        static_cast<void>(tools::read_number_table(file, columns, "numbers"));
        return;
    }
    tools::OutlineTreatment treatment;
    if (way % 3 == 1) {
        treatment.fill_rule = nearfield::FillRule::nonzero;
    }
    if (way % 7 == 1) {
        treatment.offset = 0.25;
    }
    const auto unit = way % 5 == 1 ? tools::LengthUnit::mm : tools::LengthUnit::user;
    if (file.name == "f.svg" && way % 2 == 0) {
        static_cast<void>(
            tools::read_layout({file}, {.treatment = treatment, .unit = unit, .deviation = 0.5}));
        return;
    }
    const tools::Outline outline = tools::parse_outline(file, unit);
    static_cast<void>(tools::make_shape_rings(outline, 0.5, treatment));
}

struct Counts {
    unsigned read = 0;
    unsigned refused = 0;
    std::set<std::string> reasons;  ///< without numbers
    double slowest = 0.0;           ///< seconds
};

std::string without_digits(std::string text) {
    std::erase_if(text, [](char c) { return c >= '0' && c <= '9'; });
    return text.substr(0, 60);
}

[[noreturn]] void give_up(const InputFile& file, const std::string& why) {
    std::ofstream("fuzz_failure_" + file.name, std::ios::binary) << file.bytes;
    std::fprintf(stderr, "fuzz_failure_%s: %s\n", file.name.c_str(), why.c_str());
    std::exit(1);
}

void try_file(const InputFile& file, unsigned way, Counts& counts) {
    const std::clock_t start = std::clock();
    try {
        read(file, way);
        ++counts.read;
    } catch (const nearfield::tools::InputError& error) {
        const std::string_view message = error.what();
        if (!message.starts_with(file.name + ":") || message.size() < file.name.size() + 8) {
            give_up(file, "refused as: " + std::string(message));
        }
        ++counts.refused;
        counts.reasons.insert(without_digits(std::string(message)));
    } catch (const std::exception& error) {
        give_up(file, std::string("another exception: ") + error.what());
    }
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    counts.slowest = std::max(counts.slowest, seconds);
    if (seconds > 2.0) {
        give_up(file, "took " + std::to_string(seconds) + " s");
    }
}

}  // namespace

int main(int argc, char** argv) {
    const unsigned count = argc > 1 ? static_cast<unsigned>(std::atol(argv[1])) : 10'000;
    const unsigned seed = argc > 2 ? static_cast<unsigned>(std::atol(argv[2])) : 1;
    const std::vector<std::string> asked(argv + std::min(argc, 3), argv + argc);
    std::printf("| file | mutated | read | refused | kinds of reasons | slowest ms |\n");
    std::printf("|---|---|---|---|---|---|\n");
    for (const nearfield::test::FuzzFormat& format : nearfield::test::fuzz_formats()) {
        if (!asked.empty() && std::find(asked.begin(), asked.end(), format.name) == asked.end()) {
            continue;
        }
        nearfield::test::Mutation mutation(seed, format.words);
        Counts counts;
        for (const std::string& file : format.files) {
            try_file({format.name, file}, 0, counts);
        }
        if (counts.refused > 0) {
            give_up({format.name, ""}, "a file is refused as it is: " + *counts.reasons.begin());
        }
        for (unsigned i = 0; i < count; ++i) {
            const std::string& file = format.files[i % format.files.size()];
            const std::string& other = format.files[(i / 7) % format.files.size()];
            try_file({format.name, mutation.mutate(file, other)}, i / 3, counts);
        }
        std::printf("| %s | %u | %u | %u | %zu | %.1f |\n", format.name.c_str(), count, counts.read,
                    counts.refused, counts.reasons.size(), 1e3 * counts.slowest);
        std::fflush(stdout);
    }
    return 0;
}
