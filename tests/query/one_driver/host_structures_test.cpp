#include <tests/query/query_test.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

using HostStructures = QueryTest;

struct Heard {
    std::vector<std::pair<LogLevel, std::string>> lines;

    [[nodiscard]] Log log() {
        Log log;
        log.user = this;
        log.write = [](void* user, LogLevel level, const char* message) {
            static_cast<Heard*>(user)->lines.emplace_back(level, message);
        };
        return log;
    }
    [[nodiscard]] std::ptrdiff_t count(LogLevel level, const std::string& part) const {
        return std::count_if(lines.begin(), lines.end(), [&](const auto& line) {
            return line.first == level && line.second.find(part) != std::string::npos;
        });
    }
};

TEST_F(HostStructures, LogTellsWhatIsMadeWhatGrowsAndWhatGoes) {
    Heard heard;
    HostDevice host = host_device();
    host.log = heard.log();
    {
        Expected<Context> made = Context::create(host);
        ASSERT_TRUE(made.has_value()) << made.error().text();
        EXPECT_EQ(heard.count(LogLevel::information, "context on '" + made->device_name()), 1);
        EXPECT_GT(heard.count(LogLevel::information, "pipeline '"), 10);
        EXPECT_GT(heard.count(LogLevel::information, " ms"), 10);
        EXPECT_EQ(heard.count(LogLevel::warning, ""), 0);
        heard.lines.clear();
        const Expected<ShapeHandle> shape = made->add_shape(rectangle({0, 0}, {1, 1}));
        ASSERT_TRUE(shape.has_value());
        const auto ask = [&](double tolerance) {
            Batch batch;
            batch.add(drawn(IntersectionQuery{{*shape, {}}, {*shape, {}}, tolerance}));
            Results results;
            EXPECT_TRUE(made->run(batch, results).ok());
        };
        ask(0.1);
        EXPECT_EQ(heard.count(LogLevel::warning, ""), 0) << heard.lines.front().second;
        ask(0.001);
        EXPECT_GT(heard.count(LogLevel::warning, "images grow to"), 0);
        EXPECT_GT(heard.count(LogLevel::warning, "buffer 'nearfield read-back' grows from"), 0);
        heard.lines.clear();
        ask(0.001);
        EXPECT_TRUE(heard.lines.empty()) << heard.lines.front().second;
    }
    EXPECT_EQ(heard.count(LogLevel::information, "goes"), 1);
    for (const auto& [level, line] : heard.lines) {
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
    Heard headless;
    HeadlessOptions options;
    options.log = headless.log();
    ASSERT_TRUE(Context::create_headless(options).has_value());
    EXPECT_EQ(headless.count(LogLevel::information, "goes"), 1);
}

}  // namespace
}  // namespace nearfield::test
