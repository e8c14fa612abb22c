#include <tests/query/query_test.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

/// A structure from a host compiled with newer headers: it has more members at the end.
template <class Structure>
struct Newer {
    Structure known;
    std::uint64_t unknown = 0;
};

class HostStructures : public QueryTest {
protected:
    static Status create(const HostDevice& host, const Settings& settings = on_demand()) {
        return Context::create(host, settings).error();
    }
    static void expect_refused(const Status& status, const std::string& name) {
        EXPECT_EQ(status.code(), StatusCode::invalid_settings) << status.text();
        EXPECT_NE(status.message().find(name + "::structure_size"), std::string::npos)
            << status.message();
    }
};

TEST_F(HostStructures, OfAnOlderHostAreTakenAsFarAsTheyGo) {
    HostDevice old = host_device();
    old.structure_size = offsetof(HostDevice, allocator);
    // Beyond its end there is no allocator, no cache and no log, whatever the bytes there.
    std::memset(static_cast<void*>(&old.allocator), 0xAB, sizeof(HostDevice) - old.structure_size);
    EXPECT_TRUE(create(old).ok()) << create(old).text();
    // Nor are there an allocator of device memory, and families that read.
    old = host_device();
    old.structure_size = offsetof(HostDevice, memory);
    std::memset(static_cast<void*>(&old.memory), 0xAB, sizeof(HostDevice) - old.structure_size);
    EXPECT_TRUE(create(old).ok()) << create(old).text();
    old = host_device();
    old.structure_size = offsetof(HostDevice, debug_utils);
    EXPECT_TRUE(create(old).ok()) << create(old).text();

    // The structure ends after the number of frames: a limit of one byte is beyond the end, so the
    // default applies.
    Settings settings;
    settings.structure_size = offsetof(Settings, memory_limit);
    settings.batches_in_flight = 1;
    settings.memory_limit = 1;
    Expected<Context> made = Context::create(host_device(), settings);
    ASSERT_TRUE(made.has_value()) << made.error().text();
    const Expected<ShapeHandle> shape = made->add_shape(rectangle({0, 0}, {1, 1}));
    ASSERT_TRUE(shape.has_value());
    Batch batch;
    batch.add(IntersectionQuery{{*shape, {}}, {*shape, {}}, 0.1});
    const Expected<Ticket> ticket = made->submit(batch);
    EXPECT_TRUE(ticket.has_value()) << ticket.error().text();
    EXPECT_EQ(made->submit(batch).error().code(), StatusCode::ring_full);
}

TEST_F(HostStructures, OfANewerHostAreTakenWhereItAsksForNothingNew) {
    Newer<HostDevice> host{host_device()};
    host.known.structure_size = sizeof(host);
    EXPECT_TRUE(create(host.known).ok()) << create(host.known).text();
    host.unknown = 1;
    expect_refused(create(host.known), "HostDevice");

    Newer<Settings> settings{on_demand()};
    settings.known.structure_size = sizeof(settings);
    EXPECT_TRUE(create(host_device(), settings.known).ok());
    settings.unknown = 1;
    expect_refused(create(host_device(), settings.known), "Settings");
}

TEST_F(HostStructures, OfNoKnownSizeAreRefusedByName) {
    for (const std::uint32_t size :
         {0U, 8U, static_cast<std::uint32_t>(sizeof(HostDevice)) - 1U,
          static_cast<std::uint32_t>(sizeof(HostDevice)) + 4U, 5000U, 0xFFFFFFF8U}) {
        SCOPED_TRACE(size);
        HostDevice host = host_device();
        host.structure_size = size;
        expect_refused(create(host), "HostDevice");
    }
    Settings settings = on_demand();
    settings.structure_size = 0;
    expect_refused(create(host_device(), settings), "Settings");
    HeadlessOptions options;
    options.structure_size = 0;
    expect_refused(Context::create_headless(options).error(), "HeadlessOptions");
    PhysicalDevice device;
    device.structure_size = 0;
    expect_refused(requirements(device).error(), "PhysicalDevice");
    Submission submission;
    submission.structure_size = 0;
    expect_refused(context().submit({}, submission).error(), "Submission");
    Recording recording;
    recording.structure_size = 0;
    expect_refused(context().record({}, recording).error(), "Recording");
}

// Structures that the library fills in.

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
