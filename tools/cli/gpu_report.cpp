#include <tools/cli/gpu_report.hpp>
#include <tools/io/json_writer.hpp>
#include <tools/io/query_json.hpp>

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>

namespace nearfield::tools {
namespace {

std::string significant(double number) {
    char text[32];
    std::snprintf(text, sizeof text, number < 1000.0 ? "%.3g" : "%.0f", number);
    return text;
}

std::string cell(const GpuTime& time) {
    if (time.frames == 0) {
        return time.refusal.empty() ? "-" : "refused";
    }
    return significant(time.frame) + "; " + significant(time.cpu) + "; " +
           (time.device ? significant(*time.device) : "-");
}

void write_table(std::ostream& stream, std::span<const GpuRow> rows, bool of_pairs) {
    const auto of_kind = [of_pairs](const GpuRow& row) { return row.has_pairs == of_pairs; };
    const auto first = std::find_if(rows.begin(), rows.end(), of_kind);
    if (first == rows.end()) {
        return;
    }
    stream << (of_pairs ? "\n| row | ordered pairs | points" : "\n| row | cells");
    std::string rule = of_pairs ? "\n|---|---|---|" : "\n|---|---|";
    for (const GpuTime& time : first->times) {
        stream << " | " << time.way;
        rule += "---|";
    }
    stream << " |" << rule << '\n';
    for (const GpuRow& row : rows) {
        if (!of_kind(row)) {
            continue;
        }
        // Of a row that was answered in no way nothing was counted.
        stream << "| " << row.name << " | " << (row.size > 0 ? std::to_string(row.size) : "-");
        if (of_pairs) {
            stream << " | " << (row.size > 0 ? std::to_string(row.found) : "-");
        }
        for (const GpuTime& time : row.times) {
            stream << " | " << cell(time);
        }
        stream << " |\n";
    }
}

bool is_measured(std::span<const GpuRow> rows, bool of_pairs, std::size_t way) {
    return std::any_of(rows.begin(), rows.end(), [&](const GpuRow& row) {
        return row.has_pairs == of_pairs && row.times[way].frames > 0;
    });
}

/// The first row from which on a way takes less time than `cpu` in each; null if it does in none.
const GpuRow* crossover(std::span<const GpuRow> rows, bool of_pairs, std::size_t way) {
    const GpuRow* from = nullptr;
    for (const GpuRow& row : rows) {
        if (row.has_pairs != of_pairs || row.times[way].frames == 0) {
            continue;
        }
        const bool is_faster = row.times[way].frame < row.times.front().frame;
        from = is_faster ? (from != nullptr ? from : &row) : nullptr;
    }
    return from;
}

void write_crossovers(std::ostream& stream, std::span<const GpuRow> rows, bool of_pairs) {
    const auto first = std::find_if(rows.begin(), rows.end(), [of_pairs](const GpuRow& row) {
        return row.has_pairs == of_pairs;
    });
    if (first == rows.end()) {
        return;
    }
    stream << '\n';
    for (std::size_t way = 1; way < first->times.size(); ++way) {
        if (!is_measured(rows, of_pairs, way)) {
            continue;
        }
        const GpuRow* const from = crossover(rows, of_pairs, way);
        stream << "* " << first->times[way].way << ": "
               << (from != nullptr ? "faster than cpu from " + from->name + " on"
                                   : "not faster than cpu in the largest row measured")
               << '\n';
    }
}

void write_refusals(std::ostream& stream, std::span<const GpuRow> rows) {
    for (const GpuRow& row : rows) {
        for (const GpuTime& time : row.times) {
            if (!time.refusal.empty()) {
                stream << "* " << row.name << " by " << time.way << ": " << time.refusal << '\n';
            }
        }
    }
}

void write_time(JsonWriter& json, const GpuTime& time) {
    json.key(time.way);
    if (!time.refusal.empty()) {
        json.begin_object().member("refused", time.refusal).end_object();
        return;
    }
    if (time.frames == 0) {
        json.null();
        return;
    }
    json.begin_object();
    json.member("frames", time.frames);
    json.member("median_ms", time.frame);
    json.member("cpu_ms", time.cpu);
    json.member("device_ms", time.device);
    write_passes(json, "passes_ms", time.passes);
    json.end_object();
}

}  // namespace

void write_gpu_tables(std::ostream& stream, std::span<const GpuRow> rows,
                      const Surroundings& surroundings) {
    write_surroundings(stream, surroundings);
    stream << "\n\n"
           << "Medians, milliseconds: a whole frame; of it processor time of the calling thread; "
              "passes on the device, by timestamps of other frames.\n"
           << "Crowds: penetration of boundary samples, summaries, all objects move. `device "
              "pairs`: the rows stay unread; `read`: each is read; `resident`: they stay on the "
              "device with their records, and poses come from a buffer there.\n"
           << "Fields: values at the cells around a coast line of 8,000 vertices, read back; "
              "`resident`: in an image on the device. `-`: left out, since a smaller row took more "
              "than two seconds.\n";
    for (const bool of_pairs : {true, false}) {
        write_table(stream, rows, of_pairs);
        write_crossovers(stream, rows, of_pairs);
    }
    write_refusals(stream, rows);
}

void write_gpu_json(std::ostream& stream, std::span<const GpuRow> rows,
                    const Surroundings& surroundings) {
    JsonWriter json(stream);
    json.begin_object(JsonWriter::Layout::lines);
    write_surroundings(json, surroundings);
    json.list("rows", rows, [&json](const GpuRow& row) {
        json.begin_object(JsonWriter::Layout::lines);
        json.member("name", row.name);
        json.member(row.has_pairs ? "pairs" : "cells", row.size);
        if (row.has_pairs) {
            json.member("points", row.found);
        }
        json.key("times").begin_object(JsonWriter::Layout::lines);
        for (const GpuTime& time : row.times) {
            write_time(json, time);
        }
        json.end_object();
        json.end_object();
    });
    json.end_object();
    stream << '\n';
}

}  // namespace nearfield::tools
