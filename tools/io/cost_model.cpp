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

constexpr std::array<NamedMember<CostModel, DeviceCosts>, 2> device_members{{
    {"raster", &CostModel::raster},
    {"compute", &CostModel::compute},
}};

constexpr std::array<NamedMember<DeviceCosts, double>, 2> once_members{{
    {"submission", &DeviceCosts::submission},
    {"latency", &DeviceCosts::latency},
}};

constexpr std::array<NamedMember<DeviceCosts, QueryCosts>, 3> stage_members{{
    {"plan", &DeviceCosts::plan},
    {"device", &DeviceCosts::device},
    {"read", &DeviceCosts::read},
}};

constexpr std::array<NamedMember<CpuCosts, QueryCosts>, 2> cpu_members{{
    {"plan", &CpuCosts::plan},
    {"answer", &CpuCosts::answer},
}};

constexpr std::array<NamedMember<QueryCosts, WorkCost>, 5> kind_members{{
    {"points", &QueryCosts::points},
    {"closest", &QueryCosts::closest},
    {"intersection", &QueryCosts::intersection},
    {"field", &QueryCosts::field},
    {"features", &QueryCosts::features},
}};

constexpr std::array<NamedMember<WorkCost, double>, 5> part_members{{
    {"query", &WorkCost::query},
    {"edge", &WorkCost::edge},
    {"sample", &WorkCost::sample},
    {"search", &WorkCost::search},
    {"shape", &WorkCost::shape},
}};

double read_time(const JsonPlace& place) {
    const double microseconds = place.number();
    if (microseconds < 0.0) {
        place.fail("expected microseconds, a number of at least 0");
    }
    return microseconds;
}

QueryCosts read_queries(const JsonPlace& place) {
    QueryCosts costs;
    for (const auto& kind : kind_members) {
        const JsonPlace kind_place = place.member(kind.name);
        for (const auto& part : part_members) {
            costs.*kind.member.*part.member = read_time(kind_place.member(part.name));
        }
    }
    return costs;
}

DeviceCosts read_device(const JsonPlace& place) {
    DeviceCosts costs;
    for (const auto& once : once_members) {
        costs.*once.member = read_time(place.member(once.name));
    }
    for (const auto& stage : stage_members) {
        costs.*stage.member = read_queries(place.member(stage.name));
    }
    return costs;
}

double read_overlap(const JsonPlace& place) {
    const double overlap = place.number();
    if (!(overlap >= 0.0 && overlap <= 1.0)) {
        place.fail("expected a number of at least 0 and at most 1");
    }
    return overlap;
}

void write_queries(JsonWriter& json, const QueryCosts& costs) {
    json.begin_object(JsonWriter::Layout::lines);
    for (const auto& kind : kind_members) {
        json.key(kind.name).begin_object();
        for (const auto& part : part_members) {
            json.key(part.name).value(costs.*kind.member.*part.member);
        }
        json.end_object();
    }
    json.end_object();
}

void write_device(JsonWriter& json, const DeviceCosts& costs) {
    json.begin_object(JsonWriter::Layout::lines);
    for (const auto& once : once_members) {
        json.key(once.name).value(costs.*once.member);
    }
    for (const auto& stage : stage_members) {
        write_queries(json.key(stage.name), costs.*stage.member);
    }
    json.end_object();
}

}  // namespace

CostModel read_cost_model(const std::string& file) {
    const nlohmann::json document = parse_json(read_text(file), file);
    const JsonPlace whole(document, file);
    const JsonPlace place = whole.member("microseconds");
    CostModel costs;
    for (const auto& technique : device_members) {
        costs.*technique.member = read_device(place.member(technique.name));
    }
    const JsonPlace cpu = place.member("cpu");
    for (const auto& stage : cpu_members) {
        costs.cpu.*stage.member = read_queries(cpu.member(stage.name));
    }
    costs.overlap = read_overlap(whole.member("overlap"));
    return costs;
}

void write_cost_model(std::ostream& stream, const CostModel& costs, std::string_view device) {
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    json.key("device").value(device);
    json.key("overlap").value(costs.overlap);
    json.key("microseconds").begin_object(JsonWriter::Layout::lines);
    for (const auto& technique : device_members) {
        write_device(json.key(technique.name), costs.*technique.member);
    }
    json.key("cpu").begin_object(JsonWriter::Layout::lines);
    for (const auto& stage : cpu_members) {
        write_queries(json.key(stage.name), costs.cpu.*stage.member);
    }
    json.end_object();
    json.end_object();
    json.end_object();
    stream << '\n';
}

}  // namespace nearfield::tools
