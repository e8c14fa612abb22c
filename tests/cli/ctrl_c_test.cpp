#include "cli_test.hpp"

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace nearfield::test {
namespace {

/// The program on a terminal of its own, which shows its standard output and error.
class OnTerminal {
public:
    explicit OnTerminal(const Arguments& arguments) {
        std::vector<std::string> texts{NEARFIELD_PROGRAM};
        texts.insert(texts.end(), arguments.begin(), arguments.end());
        std::vector<char*> words;
        for (std::string& text : texts) {
            words.push_back(text.data());
        }
        words.push_back(nullptr);
        child_ = forkpty(&terminal_, nullptr, nullptr, nullptr);
        if (child_ < 0) {
            throw std::runtime_error("no terminal");
        }
        if (child_ == 0) {
            alarm(120);  // survives exec
            execv(words.front(), words.data());
            _exit(127);
        }
    }
    ~OnTerminal() {
        if (child_ > 0) {
            kill(child_, SIGKILL);
            waitpid(child_, nullptr, 0);
        }
        close(terminal_);
    }
    OnTerminal(const OnTerminal&) = delete;
    OnTerminal& operator=(const OnTerminal&) = delete;

    /// Reads until the terminal has shown a text; false if the program ends before.
    [[nodiscard]] bool wait_for(const std::string& text) {
        while (shown_.find(text) == std::string::npos) {
            if (!read_some()) {
                return false;
            }
        }
        return true;
    }
    /// As from the keyboard: to all programs of the terminal.
    void press_ctrl_c() const { EXPECT_EQ(write(terminal_, "\x03", 1), 1); }

    /// Waits for the end of the program; its exit status, or -1 if a signal ended it.
    [[nodiscard]] int end() {
        while (read_some()) {
        }
        int status = 0;
        waitpid(child_, &status, 0);
        child_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    [[nodiscard]] const std::string& shown() const { return shown_; }

private:
    bool read_some() {
        std::array<char, 4096> block{};
        const ssize_t count = read(terminal_, block.data(), block.size());
        if (count > 0) {
            shown_.append(block.data(), static_cast<std::size_t>(count));
        }
        return count > 0;
    }

    int terminal_ = -1;
    pid_t child_ = 0;
    std::string shown_;
};

class CtrlCTest : public CliTest {
protected:
    [[nodiscard]] Json read_json(const std::string& name) const {
        return Json::parse(folder_.read(name));
    }
    /// Nested pentagons: contacts with gradient normals take many seconds.
    [[nodiscard]] std::string nested() const {
        return folder_.write("nested.wkt", wkt(1000, [](int ring) {
                                 std::vector<std::pair<double, double>> pentagon;
                                 for (int i = 0; i < 5; ++i) {
                                     const double angle = 0.4 * std::numbers::pi * i;
                                     const double radius = 1.0 - 0.999 * ring / 1000;
                                     pentagon.emplace_back(radius * std::cos(angle),
                                                           radius * std::sin(angle));
                                 }
                                 return pentagon;
                             }));
    }
    /// Many spikes of different lengths: the shortest of the vectors that separate two of these is
    /// searched for many seconds.
    [[nodiscard]] std::string spikes(const std::string& name, int seed) const {
        return folder_.write(
            name, wkt(1, [seed](int) {
                constexpr int count = 4000;
                std::vector<std::pair<double, double>> star;
                for (int i = 0; i < 2 * count; ++i) {
                    const double angle = std::numbers::pi * i / count;
                    const double radius = i % 2 == 1 ? 0.5 : 1.0 - 0.002 * ((i * seed) % 101);
                    star.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
                }
                return star;
            }));
    }

private:
    template <class RingOf>
    [[nodiscard]] static std::string wkt(int rings, const RingOf& ring_of) {
        std::ostringstream text;
        text.precision(17);
        for (int ring = 0; ring < rings; ++ring) {
            auto points = ring_of(ring);
            points.push_back(points.front());
            text << (ring == 0 ? "POLYGON ((" : ", (");
            for (std::size_t i = 0; i < points.size(); ++i) {
                text << (i == 0 ? "" : ", ") << points[i].first << ' ' << points[i].second;
            }
            text << ')';
        }
        text << ")\n";
        return text.str();
    }
};

TEST_F(CtrlCTest, EndsAQueryWithoutAFile) {
    const std::string outline = nested();
    const auto before = folder_.contents();
    OnTerminal program({"query", "contacts", outline, outline, "-d", "0.002", "--contact-distance",
                        "0.01", "--pose-b", "0.05,0.02,5", "--normals", "gradient", "--technique",
                        "cpu", "--json", folder_.path("out.json")});
    ASSERT_TRUE(program.wait_for(" queries answered, ")) << program.shown();
    program.press_ctrl_c();
    EXPECT_EQ(program.end(), 130);
    EXPECT_NE(program.shown().find("nearfield: stopped by Ctrl-C"), std::string::npos)
        << program.shown();
    EXPECT_EQ(folder_.contents(), before);
}

TEST_F(CtrlCTest, LeavesASceneWithWhatIsDone) {
    const std::string scene = folder_.write("scene.json", R"({
        "shapes": {"square": {"rings": [[[0, 0], [1, 0], [1, 1], [0, 1]]]}},
        "instances": {"a": {"shape": "square"}, "b": {"shape": "square", "pose": [0.2, 0.1, 10]}},
        "queries": [
            {"query": "intersection-test", "a": "a", "b": "b"},
            {"query": "intersection", "a": "a", "b": "b", "tolerance": 1e-6, "records": false},
            {"query": "separation", "a": "a", "b": "b", "tolerance": 0.1},
            {"query": "overlap", "points": [[0.5, 0.5]]}
        ]})");
    const std::string out = folder_.path("out.json");
    OnTerminal program({"scene", scene, "--technique", "cpu", "--json", out});
    ASSERT_TRUE(program.wait_for("1 of 3 queries answered, ")) << program.shown();
    program.press_ctrl_c();
    EXPECT_EQ(program.end(), 130);
    EXPECT_NE(program.shown().find("stopped by Ctrl-C: not answered: 3 queries"), std::string::npos)
        << program.shown();
    const Json results = read_json("out.json").at("results");
    ASSERT_EQ(results.size(), 4U);
    EXPECT_EQ(results[0].at("status"), "ok");
    EXPECT_EQ(results[0].at("intersects"), true);
    for (const std::size_t i : {1U, 2U, 3U}) {
        EXPECT_EQ(results[i].at("status"), "cancelled");
        EXPECT_FALSE(results[i].contains("intersects"));
        EXPECT_FALSE(results[i].contains("area"));
    }
}

/// The vector found so far separates the shapes, and is written.
TEST_F(CtrlCTest, LeavesASeparationVectorWithItsBound) {
    const std::string out = folder_.path("out.json");
    OnTerminal program({"query", "separation-vector", spikes("a.wkt", 7), spikes("b.wkt", 11), "-d",
                        "1e-8", "--most-work", "1000000000", "--json", out});
    ASSERT_TRUE(program.wait_for("0 of 1 queries answered, ")) << program.shown();
    program.press_ctrl_c();
    EXPECT_EQ(program.end(), 130);
    const Json answer = read_json("out.json");
    EXPECT_GT(answer.at("length"), 0.0);
    EXPECT_LT(answer.at("lower_bound"), answer.at("length"));
}

TEST_F(CtrlCTest, LeavesASimulationWithTheFramesThatAreDone) {
    const std::string out = folder_.path("out.json");
    OnTerminal program(
        {"simulate", "gears", "--technique", "cpu", "--frames", "10000000", "--json", out});
    ASSERT_TRUE(program.wait_for("frame 3 of ")) << program.shown();
    program.press_ctrl_c();
    EXPECT_EQ(program.end(), 130);
    const Json frames = read_json("out.json").at("frames");
    EXPECT_GE(frames.size(), 2U);
    EXPECT_LT(frames.size(), 10000000U);
}

TEST_F(CtrlCTest, EndsAMeasurementWithoutAFile) {
    const auto before = folder_.contents();
    OnTerminal program({"bench", "--json", folder_.path("out.json")});
    ASSERT_TRUE(program.wait_for("row 1 of ")) << program.shown();
    program.press_ctrl_c();
    EXPECT_EQ(program.end(), 130);
    EXPECT_EQ(folder_.contents(), before);
}

}  // namespace
}  // namespace nearfield::test
