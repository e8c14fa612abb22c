#include <tools/cli/table_report.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/json_writer.hpp>
#include <tools/io/query_json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>

namespace nearfield::tools {
namespace {

/// Milliseconds with three significant digits: the spread is seldom below one percent.
std::string three_digits(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", number);
    // 1.23e+03 is harder to read than 1230.
    if (number >= 1000.0) {
        std::snprintf(text, sizeof text, "%.0f", number);
    }
    return text;
}

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(text.size(), width), ' ');
    return text;
}

constexpr std::size_t name_width = 40;
constexpr std::size_t work_width = 34;
constexpr std::size_t cell_width = 38;

std::string work_text(const FrameWork& work) {
    return std::to_string(work.queries) + ", " + std::to_string(work.vertices) + ", " +
           std::to_string(work.cells) + " -> " + std::to_string(work.found);
}

/// The work of a row, from the technique that reports most: only some techniques draw grids.
FrameWork work_of_row(const RowTimes& row) {
    FrameWork most;
    for (const TechniqueTime& time : row.techniques) {
        if (time.refusal.empty() && (most.queries == 0 || time.work.cells > most.cells)) {
            most = time.work;
        }
    }
    return most;
}

void write_work(JsonWriter& json, const FrameWork& work) {
    json.member("queries", work.queries);
    json.member("vertices", work.vertices);
    json.member("cells", work.cells);
    json.member("found", work.found);
}

void write_technique(JsonWriter& json, const TechniqueTime& time) {
    json.key(time.technique);
    if (!time.refusal.empty()) {
        json.begin_object().member("refused", time.refusal).end_object();
        return;
    }
    json.begin_object(JsonWriter::Layout::lines);
    json.member("technique", time.answered_by);
    json.member("frames", time.frame_ms.count);
    json.member("median_ms", time.frame_ms.median);
    json.member("min_ms", time.frame_ms.least);
    json.member("quartiles_ms",
                std::array{time.frame_ms.lower_quartile, time.frame_ms.upper_quartile});
    json.member("gpu_ms", time.device_ms());
    write_work(json, time.work);
    write_timings(json, time.timings);
    json.end_object();
}

}  // namespace

void write_surroundings(std::ostream& stream, const Surroundings& surroundings) {
    const benchmark::Machine& machine = surroundings.machine;
    stream << machine.date << ", nearfield " << machine.commit << "; " << machine.processor << ", "
           << machine.cores << " cores; " << device_text(surroundings.device) << " ("
           << surroundings.driver << ')';
}

void write_surroundings(JsonWriter& json, const Surroundings& surroundings) {
    json.member("commit", surroundings.machine.commit);
    json.member("date", surroundings.machine.date);
    json.member("processor", surroundings.machine.processor);
    json.member("cores", surroundings.machine.cores);
    json.member("device", surroundings.device, !surroundings.device.empty());
    json.member("driver", surroundings.driver);
}

TextTable::TextTable(std::ostream& stream, const Surroundings& surroundings) : stream_(stream) {
    write_surroundings(stream_, surroundings);
    stream_
        << "\n\n"
        << "Milliseconds of a whole frame, everything handed over anew: median (least; lower "
           "quartile - upper quartile);\n"
        << "gpu: of it on the device, by timestamps. Work: queries, vertices, grid cells -> "
           "found. The last column is the\n"
        << "median of automatic over that of the quickest other (and the same of the least).\n\n"
        << "| " << padded("row", name_width) << " | " << padded("work", work_width);
    for (const char* technique : {"raster", "compute", "cpu", "automatic"}) {
        stream_ << " | " << padded(technique, cell_width);
    }
    stream_ << " | chose | to best |\n|---|---|---|---|---|---|---|---|\n" << std::flush;
}

std::string TextTable::cell(const TechniqueTime& time) {
    if (!time.refusal.empty()) {
        auto place = std::find(refusals_.begin(), refusals_.end(), time.refusal);
        if (place == refusals_.end()) {
            place = refusals_.insert(refusals_.end(), time.refusal);
        }
        return "refused [" + std::to_string(place - refusals_.begin() + 1) + "]";
    }
    const benchmark::Spread& spread = time.frame_ms;
    const std::optional<double> device = time.device_ms();
    return three_digits(spread.median) + " (" + three_digits(spread.least) + "; " +
           three_digits(spread.lower_quartile) + " - " + three_digits(spread.upper_quartile) + ")" +
           (device ? " gpu " + three_digits(*device) : "");
}

void TextTable::add(const RowTimes& row) {
    stream_ << "| " << padded(row.name, name_width) << " | "
            << padded(work_text(work_of_row(row)), work_width);
    for (const TechniqueTime& time : row.techniques) {
        stream_ << " | " << padded(cell(time), cell_width);
    }
    const TechniqueTime* const automatic = row.find("automatic");
    const std::optional<double> ratio = row.automatic_to_best();
    const std::optional<double> least = row.automatic_to_best(&benchmark::Spread::least);
    stream_ << " | " << (automatic != nullptr ? automatic->answered_by : "") << " | "
            << (ratio && least ? three_digits(*ratio) + " (" + three_digits(*least) + ")" : "")
            << " |\n"
            << std::flush;
}

void TextTable::finish() {
    if (!refusals_.empty()) {
        stream_ << '\n';
    }
    for (std::size_t index = 0; index < refusals_.size(); ++index) {
        stream_ << '[' << index + 1 << "] " << refusals_[index] << '\n';
    }
}

void write_table_json(std::ostream& stream, std::span<const RowTimes> table,
                      const Surroundings& surroundings) {
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    write_surroundings(json, surroundings);
    json.list("rows", table, [&json](const RowTimes& row) {
        json.begin_object(JsonWriter::Layout::lines);
        json.member("name", row.name);
        write_work(json, work_of_row(row));
        json.key("techniques").begin_object(JsonWriter::Layout::lines);
        for (const TechniqueTime& time : row.techniques) {
            write_technique(json, time);
        }
        json.end_object();
        json.member("automatic_to_best", row.automatic_to_best());
        json.member("automatic_to_best_least", row.automatic_to_best(&benchmark::Spread::least));
        json.end_object();
    });
    json.end_object();
    stream << '\n';
}

}  // namespace nearfield::tools
