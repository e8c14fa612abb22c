#include <tools/io/cost_model.hpp>
#include <tools/io/json_document.hpp>
#include <tools/io/json_writer.hpp>
#include <tools/io/text_file.hpp>

#include <array>

namespace nearfield::tools {
namespace {

/// A member of a structure and its name in JSON.
template <class Structure, class Member>
struct NamedMember {
    const char* name;
    Member Structure::*member;
};

constexpr std::array<NamedMember<CostModel, TechniqueCost>, 3> technique_members{{
    {"raster", &CostModel::raster},
    {"compute", &CostModel::compute},
    {"cpu", &CostModel::cpu},
}};

constexpr std::array<NamedMember<TechniqueCost, WorkCost>, 5> kind_members{{
    {"points", &TechniqueCost::points},
    {"closest", &TechniqueCost::closest},
    {"intersection", &TechniqueCost::intersection},
    {"field", &TechniqueCost::field},
    {"features", &TechniqueCost::features},
}};

constexpr std::array<NamedMember<WorkCost, double>, 3> part_members{{
    {"query", &WorkCost::query},
    {"edge", &WorkCost::edge},
    {"sample", &WorkCost::sample},
}};

double read_time(const JsonPlace& place) {
    const double microseconds = place.number();
    if (microseconds < 0.0) {
        place.fail("expected microseconds, a number of at least 0");
    }
    return microseconds;
}

TechniqueCost read_technique(const JsonPlace& place) {
    TechniqueCost technique;
    technique.submission = read_time(place.member("submission"));
    for (const auto& kind : kind_members) {
        const JsonPlace kind_place = place.member(kind.name);
        for (const auto& part : part_members) {
            technique.*kind.member.*part.member = read_time(kind_place.member(part.name));
        }
    }
    return technique;
}

}  // namespace

CostModel read_cost_model(const std::string& file) {
    const nlohmann::json document = parse_json(read_text(file), file);
    const JsonPlace place = JsonPlace(document, file).member("microseconds");
    CostModel costs;
    for (const auto& technique : technique_members) {
        costs.*technique.member = read_technique(place.member(technique.name));
    }
    return costs;
}

void write_cost_model(std::ostream& stream, const CostModel& costs, std::string_view device) {
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    json.key("device").value(device);
    json.key("microseconds").begin_object(JsonWriter::Layout::lines);
    for (const auto& technique : technique_members) {
        const TechniqueCost& cost = costs.*technique.member;
        json.key(technique.name).begin_object(JsonWriter::Layout::lines);
        json.key("submission").value(cost.submission);
        for (const auto& kind : kind_members) {
            json.key(kind.name).begin_object();
            for (const auto& part : part_members) {
                json.key(part.name).value(cost.*kind.member.*part.member);
            }
            json.end_object();
        }
        json.end_object();
    }
    json.end_object();
    json.end_object();
    stream << '\n';
}

}  // namespace nearfield::tools
