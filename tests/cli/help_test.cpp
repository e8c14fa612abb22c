#include "cli_test.hpp"

#include <cstddef>
#include <map>
#include <set>
#include <sstream>

namespace nearfield::test {
namespace {

using Names = std::set<std::string>;

Names both(Names names, const Names& more) {
    names.insert(more.begin(), more.end());
    return names;
}

/// The options of each kind, without the options common to all kinds.
const std::map<std::string, Names>& own_options() {
    static const Names sampled{"--boxes", "--height", "--memory-limit", "--tiles"};
    static const std::map<std::string, Names> options{
        {"penetration", both(sampled, Names{"--points"})},
        {"contacts", both(sampled, Names{"--contact-distance", "--normals"})},
        {"intersection", both(sampled, Names{"--kind", "--strategy"})},
        {"separation", sampled},
        {"closest-point", sampled},
        {"distance-field", both(sampled, Names{"--rect", "--gradient", "--at", "--sign", "--show",
                                               "--field", "--gradient-field", "--features"})},
        {"intersection-test", {}},
        {"containment", {}},
        {"time-of-impact",
         {"--end-pose-a", "--end-pose-b", "--contact-distance", "--time-bound", "--most-steps"}},
        {"separation-vector", {"--most-work"}}};
    return options;
}

const Names common_options{"-h",          "--help",        "-d",        "--deviation", "--pose-a",
                           "--pose-b",    "--technique",   "--threads", "--json",      "--image",
                           "--fill-rule", "--clean-width", "--strict",  "--units",     "--offset"};

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

/// The text with white space collapsed, so that phrases are found across lines.
std::string unwrapped(const std::string& text) {
    std::istringstream stream(text);
    std::string line;
    for (std::string word; stream >> word;) {
        line += (line.empty() ? "" : " ") + word;
    }
    return line;
}

/// The options in a help text: the first words of lines that begin with a dash.
Names listed_options(const std::string& help) {
    Names names;
    for (const std::string& line : lines_of(help)) {
        if (line.starts_with("  -")) {
            std::istringstream list(line.substr(2, line.find(' ', 2) - 2));
            for (std::string name; std::getline(list, name, ',');) {
                names.insert(name);
            }
        }
    }
    return names;
}

class Help : public CliTest {
protected:
    static std::string help(const Arguments& command) {
        const Arguments arguments = command + Arguments{"--help"};
        const Outcome outcome = run_program(arguments);
        EXPECT_EQ(outcome.status, 0) << command_line(arguments) << '\n' << outcome.err;
        EXPECT_EQ(outcome.err, "");
        for (const std::string& line : lines_of(outcome.out)) {
            EXPECT_LE(line.size(), 80U) << command_line(arguments) << '\n' << line;
        }
        EXPECT_NE(
            outcome.out.find("0 done, 2 bad input or usage, 3 no usable device, 1 anything else,\n"
                             "130 stopped by Ctrl-C."),
            std::string::npos)
            << outcome.out;
        return outcome.out;
    }

    static void expect_names(const Arguments& command, const std::vector<std::string>& parts) {
        const std::string text = unwrapped(help(command));
        for (const std::string& part : parts) {
            EXPECT_NE(text.find(part), std::string::npos)
                << command_line(command) << " does not say " << part << '\n'
                << text;
        }
    }

    /// The words of the example in a help text, with existing files and files of this test
    /// substituted.
    [[nodiscard]] Arguments example(const std::string& text) const {
        const std::string lead = "Example:\n  nearfield ";
        const std::size_t start = text.find(lead);
        EXPECT_NE(start, std::string::npos) << text;
        const std::size_t first = start + lead.size();
        std::istringstream line(text.substr(first, text.find('\n', first) - first));
        Arguments words;
        for (std::string word; line >> word;) {
            if (word.starts_with("A.")) {
                word = a_;
            } else if (word.starts_with("B.")) {
                word = b_;
            } else if (word.ends_with(".png") || word.ends_with(".npy")) {
                word = folder_.path(word);
            }
            words.push_back(word);
        }
        return words;
    }
};

TEST_F(Help, NamesCommandsAndTheirOptions) {
    expect_names({}, {"query", "scene", "bench", "simulate", "hash", "info", "--version"});
    expect_names({"scene"},
                 {"groups", "nearest", "--technique", "--memory-limit", "--threads", "--json"});
    expect_names({"bench"},
                 {"--scene", "--technique", "--frames", "--warmup", "--keep", "--gpu", "--json"});
    expect_names({"simulate"},
                 {"nest", "robots", "--response", "--frames", "--bodies", "--every", "--video"});
    expect_names({"info"}, {"devices"});
    EXPECT_EQ(run_program({"--version"}).out.rfind("nearfield ", 0), 0U);
}

TEST_F(Help, OfQueryListsTheKindsInALineEachAndAnExample) {
    const std::string text = help({"query"});
    EXPECT_EQ(listed_options(text), (Names{"-h", "--help"}));
    EXPECT_NE(text.find("Usage: nearfield query [OPTIONS] KIND\n"), std::string::npos) << text;
    for (const auto& [kind, options] : own_options()) {
        const std::size_t line = text.find("\n  " + kind + ' ');
        ASSERT_NE(line, std::string::npos) << kind << '\n' << text;
        EXPECT_TRUE(text.compare(text.find('\n', line + 1) + 1, 2, "  ") != 0 ||
                    text[text.find('\n', line + 1) + 3] != ' ')
            << kind << " takes more than a line\n"
            << text;
    }
    EXPECT_EQ(run_program(example(text)).status, 0);
}

TEST_F(Help, OfAKindListsItsOptionsAndNoOthers) {
    for (const auto& [kind, options] : own_options()) {
        const std::string text = help({"query", kind});
        EXPECT_EQ(listed_options(text), both(common_options, options)) << kind;
        EXPECT_NE(text.find("Usage: nearfield query " + kind + " [OPTIONS] A B\n"),
                  std::string::npos)
            << text;
        EXPECT_TRUE(text.find("\nInput:\n") < text.find("\nTechnique:\n") &&
                    text.find("\nTechnique:\n") < text.find("\nOutput:\n"))
            << text;
        // The description in the list of kinds is repeated here.
        EXPECT_NE(help({"query"}).find(lines_of(text).front()), std::string::npos) << text;
    }
}

TEST_F(Help, ExamplesAreAnswered) {
    for (const auto& [kind, options] : own_options()) {
        const Arguments words = example(help({"query", kind}));
        EXPECT_EQ(words.at(1), kind);
        const Outcome outcome = run_program(words);
        EXPECT_EQ(outcome.status, 0) << command_line(words) << '\n' << outcome.err;
    }
}

TEST_F(Help, StatesUnitsDefaultsAndForms) {
    expect_names(
        {"query", "penetration"},
        {"GeoJSON", "WKT", "SVG", "world units", "X,Y,DEGREES", "default 0,0,0", "default boundary",
         "default automatic", "1 to 256", "WKB", "standard input", "MiB; default 1024"});
    expect_names({"query", "separation"}, {"default a thousandth"});
    expect_names({"query", "distance-field"}, {"X0,Y0,X1,Y1", "float32", "1600 x 1200"});
}

TEST_F(Help, IsShownWhateverElseIsWrong) {
    const std::string text = help({"query", "penetration"});
    for (const Arguments& words :
         {Arguments{"query", "penetration", "-d", "x", "--threads", "x"},
          Arguments{"query", "--height", "x", "penetration", a_, b_},
          Arguments{"query", "penetration", "none.wkt", "--json", "no/such.json"}}) {
        EXPECT_EQ(help(words), text);
    }
    EXPECT_EQ(run_program({"--help", "query", "penetration", "-d", "x"}).out, text);
    EXPECT_EQ(help({"query", "frobnication"}), help({"query"}));
}

}  // namespace
}  // namespace nearfield::test
