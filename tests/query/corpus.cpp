#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <tests/query/corpus.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace nearfield::test {
namespace {

using Json = nlohmann::json;

Json to_json(const NamedRings& shape, const Pose& pose) {
    Json rings = Json::array();
    for (const Ring& ring : shape.rings) {
        Json line = Json::array();
        for (const Vector2& v : ring) {
            line.push_back({v.x, v.y});
        }
        rings.push_back(std::move(line));
    }
    return {{"name", shape.name},
            {"rings", std::move(rings)},
            {"pose", {pose.translation.x, pose.translation.y, pose.angle}}};
}

void read_shape(const Json& json, NamedRings& shape, Pose& pose) {
    shape.name = json.at("name").get<std::string>();
    for (const Json& line : json.at("rings")) {
        Ring& ring = shape.rings.emplace_back();
        for (const Json& v : line) {
            ring.push_back({v.at(0).get<double>(), v.at(1).get<double>()});
        }
    }
    const Json& numbers = json.at("pose");
    pose = {{numbers.at(0).get<double>(), numbers.at(1).get<double>()},
            numbers.at(2).get<double>()};
}

CorpusCase read_case(const std::filesystem::path& file) {
    std::ifstream stream(file);
    try {
        const Json json = Json::parse(stream);
        CorpusCase result;
        result.name = file.stem().string();
        read_shape(json.at("a"), result.pair.a, result.pair.pose_a);
        read_shape(json.at("b"), result.pair.b, result.pair.pose_b);
        result.pair.tolerance = json.at("tolerance").get<double>();
        result.contact_distance = json.at("contact_distance").get<double>();
        return result;
    } catch (const Json::exception& error) {
        throw std::runtime_error(file.string() + ": " + error.what());
    }
}

int failures_so_far() {
    const testing::TestResult* const result =
        testing::UnitTest::GetInstance()->current_test_info()->result();
    return result->total_part_count();
}

}  // namespace

std::vector<CorpusCase> read_corpus(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".json") {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    std::vector<CorpusCase> cases;
    for (const std::filesystem::path& file : files) {
        cases.push_back(read_case(file));
    }
    return cases;
}

CorpusKeeper::CorpusKeeper(const Pair& pair, double contact_distance)
    : pair_(pair), contact_distance_(contact_distance), failures_before_(failures_so_far()) {}

CorpusKeeper::~CorpusKeeper() {
    const char* const folder = std::getenv("NEARFIELD_CORPUS");
    if (folder == nullptr || failures_so_far() == failures_before_) {
        return;
    }
    const testing::TestInfo* const test = testing::UnitTest::GetInstance()->current_test_info();
    const Json json{{"a", to_json(pair_.a, pair_.pose_a)},
                    {"b", to_json(pair_.b, pair_.pose_b)},
                    {"tolerance", pair_.tolerance},
                    {"contact_distance", contact_distance_}};
    const std::string name = std::string(test->test_suite_name()) + "_" +
                             std::to_string(std::hash<std::string>{}(json.dump()) % 1000000);
    std::ofstream(std::filesystem::path(folder) / (name + ".json")) << json.dump() << '\n';
}

}  // namespace nearfield::test
