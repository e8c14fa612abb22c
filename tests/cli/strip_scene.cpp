#include "strip_scene.hpp"

#include <fstream>

namespace nearfield::test {

std::string StripScene::strip_file() {
    return NEARFIELD_TEST_DATA "/scenes/strip.json";
}

Json StripScene::strip() {
    std::ifstream stream(strip_file());
    return Json::parse(stream);
}

std::string StripScene::scene(const std::string& queries) const {
    Json scene = strip();
    scene["queries"] = Json::parse("[" + queries + "]");
    return folder_.write("scene.json", scene.dump());
}

Json StripScene::results_of(const std::string& queries) const {
    const Json json = answer({"scene", scene(queries)});
    return json.is_object() ? json.at("results") : Json::array();
}

Json StripScene::records_of(const std::string& query) const {
    return results_of(query).at(0).at("records");
}

}  // namespace nearfield::test
